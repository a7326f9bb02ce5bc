#!/usr/bin/env bash
# Installs what is missing, builds everything with both compilers and runs all tests. The last lines are the test runner's summary.
# A room's sources are compiled together, with precompiled headers. clang-tidy and the sanitizers look at what changed (scripts/changed_files.sh) and at a rotating
# eighth of the rest.
#   --all    each source is compiled by itself with clang and finds its own headers, benchmarks are built, the tests labelled slow run too, clang-tidy and the sanitizers look at
#            everything, and the fuzz targets run for a minute each: for every night
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-}" in
  '') exclude=(-LE slow) all=() unity=ON bench=OFF packages=test ;;
  --all) exclude=() all=(--all) unity=OFF bench=ON packages=slow ;;
  *) echo "usage: $0 [--all]" >&2; exit 2 ;;
esac

scripts/install_packages.sh "$packages"
scripts/python_venv.sh
jobs=$(nproc)
stage() { printf '== %s  (after %d:%02d)\n' "$1" $((SECONDS / 60)) $((SECONDS % 60)); }
# Compiled files are found again from a checkout elsewhere.
export CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=$PWD
# More tests than there are processors: many wait, for planners that hang and for time limits.
export CTEST_PARALLEL_LEVEL=$((jobs + 2))

stage "format"
scripts/lint.sh --format-only
stage "build with g++ (build/release)"
cmake --preset release -DAVOIDBENCH_TESTS=ON -DAVOIDBENCH_BENCH=$bench -DAVOIDBENCH_WERROR=ON -DAVOIDBENCH_UNITY=ON \
  -DAVOIDBENCH_PYTHON=ON "-DPython_EXECUTABLE=$PWD/build/venv/bin/python" "-DAVOIDBENCH_COMPARE_WITH=$PWD/build/clang/avoidbench" >/dev/null
cmake --build build/release --parallel "$jobs"
stage "build the program and planners with clang (build/clang), for its warnings and to compare bits"
cmake --preset clang "-DAVOIDBENCH_UNITY=$unity" "-DAVOIDBENCH_PRECOMPILED=$unity" >/dev/null
cmake --build build/clang --parallel "$jobs" --target program
stage "clang-tidy"
scripts/lint.sh "${all[@]}"
stage "sanitizers"
scripts/sanitize.sh "${all[@]}"
if [ ${#all[@]} -gt 0 ]; then
  stage "fuzz targets"
  scripts/fuzz.sh 60
fi
stage "tests"
ctest --test-dir build/release --output-on-failure "${exclude[@]}"
