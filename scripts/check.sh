#!/usr/bin/env bash
# check.sh [ROOM…]: checks your work in minutes: the format of changed files, the order of the rooms, and the tests of these rooms, except
# slow ones. Default: the rooms that differ from the main branch (on the main branch: uncommitted changes).
set -euo pipefail
cd "$(dirname "$0")/.."

base=$(git merge-base HEAD origin/main 2>/dev/null || git rev-parse HEAD)
mapfile -t changed < <({ git diff --name-only "$base"; git ls-files --others --exclude-standard; } | sort -u)
mapfile -t sources < <(printf '%s\n' "${changed[@]}" | grep -E '^(apps|lib|planners|python|tests)/.*\.(cpp|hpp|h|c)$' | grep -v page_program.cpp | xargs -r ls 2>/dev/null || true)
[ ${#sources[@]} -eq 0 ] || scripts/lint.sh --format-only "${sources[@]}"
python3 scripts/check_layers.py

# ctest labels: a room's name, or the folder in tests/.
rooms=("$@")
if [ ${#rooms[@]} -eq 0 ]; then
  mapfile -t rooms < <(printf '%s\n' "${changed[@]}" | sed -nE 's,^lib/[^/]+/([^/]+)/.*,\1,p; s,^tests/([^/]+)/.*,\1,p; s,^(planners|python)/.*,\1,p; s,^apps/avoidbench/.*,cli,p' | sort -u)
fi
[ ${#rooms[@]} -gt 0 ] || { echo "nothing changed"; exit 0; }
echo "tests of: ${rooms[*]}"
export CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=$PWD
cmake --preset release -DAVOIDBENCH_TESTS=ON -DAVOIDBENCH_WERROR=ON -DAVOIDBENCH_UNITY=ON >/dev/null
cmake --build build/release --parallel "$(nproc)"
CTEST_PARALLEL_LEVEL=$(nproc) ctest --test-dir build/release --output-on-failure -LE slow -L "^($(IFS='|'; echo "${rooms[*]}"))\$"
