#!/usr/bin/env bash
# Installs the SDK to a fresh prefix, writes a new planner outside of the repository by `planners new`, builds it
# against the installed package alone, without a warning, and lets the conformance suite judge it. Also the one for this
# repository.
#   installed_sdk_test.sh SOURCE_FOLDER BUILD_FOLDER CXX_COMPILER CONFORMANCE_PROGRAM AVOIDBENCH
set -euo pipefail
source_folder=$1 build_folder=$2 compiler=$3 conformance=$4 program=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build_folder" --prefix "$work/prefix" --component sdk >/dev/null
for header in planner.h planner.hpp canvas.hpp goals.hpp known_world.hpp planner_eigen.hpp portable_math.hpp \
    repeatable.hpp tracks.hpp views.hpp; do
  [ -f "$work/prefix/include/avoidbench/$header" ] || { echo "$header is not installed"; exit 1; }
done

# What avoidbench_ros_planner() compiles.
[ -f "$work/prefix/share/avoidbench/planners/ros_shim/make_planner.py" ] || { echo "the ROS shim is not installed"; exit 1; }

cd "$work"
"$program" planners new drift >/dev/null
mkdir -p copy/scripts copy/planners && cp "$source_folder/scripts/new_planner.sh" copy/scripts && cp -r "$source_folder/planners/template" copy/planners
copy/scripts/new_planner.sh drift >/dev/null
cmp drift/drift.cpp copy/planners/drift/drift.cpp
if copy/scripts/new_planner.sh drift 2>/dev/null; then
  echo "new_planner.sh overwrote a folder"
  exit 1
fi
for bad in Drift 2drift 'a b' ../x '' support; do
  if copy/scripts/new_planner.sh "$bad" >/dev/null 2>&1; then
    echo "new_planner.sh took the name '$bad'"
    exit 1
  fi
done
! grep -r '@NAME@\|@CLASS@\|@PLUGIN@' drift copy/planners/drift copy/tests || { echo "a name was not put in"; exit 1; }

cmake -S "$work/drift" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Werror" >/dev/null
cmake --build "$work/build" >/dev/null
"$conformance" "$work/build/planners/drift.so"

# Where it crashes, replay names the line of source.
cp -r drift crash
line=$(grep -n 'const ab_state& state = \*seen.state;' crash/drift.cpp | cut -d: -f1)
sed -i "${line}s|\$| if (state.time_s > 0.5) *static_cast<volatile int*>(nullptr) = 1;|" crash/drift.cpp
cmake -S crash -B crash/build -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" >/dev/null
cmake --build crash/build >/dev/null
cat > crash/crash.yaml <<'YAML'
sweep: crash
planners: [./build/planners/drift.so]
trials: 1
maps: {generator: hall, area_m: [10, 12], poisson_radius_m: 3}
mission: {time_limit_s: 2}
YAML
"$program" run crash/crash.yaml --db crash.db --quiet 2>/dev/null || true
"$program" replay crash.db 1 2>&1 | grep -q "drift.so  .*  drift.cpp:$line\$" || { echo "no line $line in the stack:"; "$program" replay crash.db 1; exit 1; }

# A C++ class behind an adapter.
"$program" planners new class --kind class >/dev/null
cmake -S class -B class/build -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Werror" >/dev/null
cmake --build class/build >/dev/null
"$conformance" class/build/planners/class.so

# A planner that ends by its clock and seeds from chance repeats by what the SDK compiles into it.
mkdir anytime && cp "$source_folder/tests/planners/repeatable/anytime.cpp" anytime
cat > anytime/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.22)
project(anytime CXX)
find_package(avoidbench REQUIRED)
avoidbench_planner(anytime SOURCES anytime.cpp PRIVATE avoidbench::repeatable)
CMAKE
cmake -S anytime -B anytime/build -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Werror" >/dev/null
cmake --build anytime/build >/dev/null
"$conformance" anytime/build/planners/anytime.so
