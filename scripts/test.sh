#!/usr/bin/env bash
# Installs what is missing, builds everything with both compilers and runs all tests. The last lines are the test runner's summary.
#   --slow   also the tests labelled slow
#   --tidy   also clang-tidy over everything (minutes)
set -euo pipefail
cd "$(dirname "$0")/.."

slow=0 tidy=0
for argument in "$@"; do
  case "$argument" in
    --slow) slow=1 ;;
    --tidy) tidy=1 ;;
    *) echo "usage: $0 [--slow] [--tidy]" >&2; exit 2 ;;
  esac
done

scripts/install_packages.sh test
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
[ $tidy = 1 ] && { echo "== clang-tidy"; scripts/lint.sh --all; }
echo "== tests"
exclude=(-LE slow)
[ $slow = 1 ] && exclude=()
ctest --test-dir build/release --output-on-failure "${exclude[@]}"
