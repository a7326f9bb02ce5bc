#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests except slow ones. The last lines are the test runner's
# summary.
#   --all    also runs the tests labelled slow and builds the benchmarks
# AVOIDBENCH_COMPARE_WITH=FILE: a program built by another compiler (scripts/check_all.sh), whose results must have the
# same bits.
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-}" in
  '') exclude=(-LE slow) bench=OFF packages=test ;;
  --all) exclude=() bench=ON packages=slow ;;
  *) echo "usage: $0 [--all]" >&2; exit 2 ;;
esac

scripts/install_packages.sh "$packages"
scripts/python_venv.sh
jobs=$(nproc)
stage() { printf '== %s  (after %d:%02d)\n' "$1" $((SECONDS / 60)) $((SECONDS % 60)); }
# ccache also finds files compiled in another checkout.
export CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=$PWD
# More tests than processors, because many wait for hanging planners and time limits.
export CTEST_PARALLEL_LEVEL=$((jobs + 2))

stage "build with g++ (build/release)"
cmake --preset release -DAVOIDBENCH_TESTS=ON -DAVOIDBENCH_BENCH=$bench -DAVOIDBENCH_WERROR=ON -DAVOIDBENCH_UNITY=ON \
  -DAVOIDBENCH_PYTHON=ON "-DPython_EXECUTABLE=$PWD/build/venv/bin/python" "-DAVOIDBENCH_COMPARE_WITH=${AVOIDBENCH_COMPARE_WITH:-}" >/dev/null
cmake --build build/release --parallel "$jobs"
stage "tests"
ctest --test-dir build/release --output-on-failure "${exclude[@]}"
