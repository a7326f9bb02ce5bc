#!/usr/bin/env bash
# Installs the SDK to a fresh prefix, writes a new planner outside of the repository with new_planner.sh, builds it against
# the installed package alone and lets the conformance suite judge it.
#   installed_sdk_test.sh SOURCE_FOLDER BUILD_FOLDER CXX_COMPILER CONFORMANCE_PROGRAM
set -euo pipefail
source_folder=$1 build_folder=$2 compiler=$3 conformance=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build_folder" --prefix "$work/prefix" --component sdk >/dev/null
for header in planner.h planner.hpp planner_eigen.hpp portable_math.hpp; do
  [ -f "$work/prefix/include/avoidbench/$header" ] || { echo "$header is not installed"; exit 1; }
done

"$source_folder/scripts/new_planner.sh" drift "$work/drift" >/dev/null
if "$source_folder/scripts/new_planner.sh" drift "$work/drift" 2>/dev/null; then
  echo "new_planner.sh overwrote a folder"
  exit 1
fi
for bad in Drift 2drift 'a b' ../x '' support; do
  if "$source_folder/scripts/new_planner.sh" "$bad" "$work/bad" >/dev/null 2>&1; then
    echo "new_planner.sh took the name '$bad'"
    exit 1
  fi
done
[ ! -e "$work/bad" ] || { echo "new_planner.sh wrote in spite of a bad name"; exit 1; }

cmake -S "$work/drift" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Werror" >/dev/null
cmake --build "$work/build" >/dev/null
"$conformance" "$work/build/planners/drift.so"
