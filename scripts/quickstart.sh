#!/usr/bin/env bash
# Installs what is missing, builds the release, flies a small sweep and prints its report. May be run again: it goes on
# where it was.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh build
echo "building build/release" >&2
# From scratch a room's sources are compiled together, in half of the time; a build that is there stays as it is.
unity=()
[ -f build/release/CMakeCache.txt ] || unity=(-DAVOIDBENCH_UNITY=ON)
cmake --preset release -DAVOIDBENCH_TESTS=OFF -DAVOIDBENCH_BENCH=OFF -DAVOIDBENCH_WERROR=OFF "${unity[@]}" >/dev/null
cmake --build build/release --parallel "$(nproc)"
build/release/avoidbench run configs/sweeps/quick.yaml
# Where npm was found, the program has the page of a sweep.
page=()
if grep -q '^AVOIDBENCH_HAS_PAGE:INTERNAL=ON' build/release/CMakeCache.txt; then page=(--page results/quick.html); fi
build/release/avoidbench report results/quick.db "${page[@]}"
echo
echo "The program is build/release/avoidbench; results are in results/quick.db." >&2
if [ ${#page[@]} -gt 0 ]; then
  echo "To look at them, open results/quick.html in a browser." >&2
else
  echo "With npm (Debian: apt install npm) the program also writes pages to look at them: avoidbench report --page." >&2
fi
