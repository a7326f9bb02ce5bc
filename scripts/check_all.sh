#!/usr/bin/env bash
# Checks what tests do not: format, warnings of another compiler (build/clang, with which scripts/test.sh can compare bits), clang-tidy and
# sanitizers. The last two check what changed (scripts/changed_files.sh) and a rotating sixteenth of the rest.
#   --all    for nightly runs: clang compiles each source separately, which finds missing includes; clang-tidy and the sanitizers check
#            everything; and each fuzz target runs for a minute
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-}" in
  '') all=() unity=ON ;;
  --all) all=(--all) unity=OFF ;;
  *) echo "usage: $0 [--all]" >&2; exit 2 ;;
esac

scripts/install_packages.sh test
scripts/python_venv.sh
stage() { printf '== %s  (after %d:%02d)\n' "$1" $((SECONDS / 60)) $((SECONDS % 60)); }
export CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=$PWD

stage "format"
scripts/lint.sh --format-only
stage "build the program and planners with clang (build/clang)"
cmake --preset clang "-DAVOIDBENCH_UNITY=$unity" "-DAVOIDBENCH_PRECOMPILED=$unity" >/dev/null
cmake --build build/clang --parallel "$(nproc)" --target program
stage "clang-tidy"
scripts/lint.sh "${all[@]}"
stage "sanitizers"
scripts/sanitize.sh "${all[@]}"
if [ ${#all[@]} -gt 0 ]; then
  stage "fuzz targets"
  scripts/fuzz.sh 60
fi
stage "end"
