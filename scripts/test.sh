#!/usr/bin/env bash
# Installs what is missing, builds everything with both compilers and runs all tests. The last lines are the test runner's summary.
# clang-tidy and the sanitizers look at what changed (scripts/changed_files.sh) and at a rotating eighth of the rest.
#   --all    the tests labelled slow too, clang-tidy and the sanitizers over everything, and the fuzz targets for a minute each
#            (an hour): for every night
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-}" in
  '') exclude=(-LE slow) all=() packages=test ;;
  --all) exclude=() all=(--all) packages=slow ;;
  *) echo "usage: $0 [--all]" >&2; exit 2 ;;
esac

scripts/install_packages.sh "$packages"
jobs=$(nproc)
# Compiled files are found again from a checkout elsewhere.
export CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=$PWD CTEST_PARALLEL_LEVEL=$jobs

echo "== format"
scripts/lint.sh --all --format-only
echo "== build with g++ (build/release)"
cmake --preset release -DAVOIDBENCH_TESTS=ON -DAVOIDBENCH_BENCH=ON -DAVOIDBENCH_WERROR=ON \
  "-DAVOIDBENCH_COMPARE_WITH=$PWD/build/clang/avoidbench" >/dev/null
cmake --build build/release --parallel "$jobs"
echo "== build the program and planners with clang (build/clang), for its warnings and to compare bits"
cmake --preset clang >/dev/null
cmake --build build/clang --parallel "$jobs" --target program
echo "== clang-tidy"
scripts/lint.sh "${all[@]}"
echo "== sanitizers"
scripts/sanitize.sh "${all[@]}"
if [ ${#all[@]} -gt 0 ]; then
  echo "== fuzz targets"
  scripts/fuzz.sh 60
fi
echo "== tests"
ctest --test-dir build/release --output-on-failure "${exclude[@]}"
