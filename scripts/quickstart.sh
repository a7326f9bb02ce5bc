#!/usr/bin/env bash
# Installs what is missing, builds the release, flies a small sweep and prints its report. Run again, it resumes where it
# stopped.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh build
echo "building build/release" >&2
# A build from scratch compiles a room's sources together, in half of the time; an existing build stays as it is.
unity=()
[ -f build/release/CMakeCache.txt ] || unity=(-DAVOIDBENCH_UNITY=ON)
cmake --preset release -DAVOIDBENCH_TESTS=OFF -DAVOIDBENCH_BENCH=OFF -DAVOIDBENCH_WERROR=OFF "${unity[@]}" >/dev/null
cmake --build build/release --parallel "$(nproc)"
build/release/avoidbench run configs/sweeps/quick.yaml
build/release/avoidbench report results/quick.db --page results/quick.html
echo
echo "The program is build/release/avoidbench; results are in results/quick.db." >&2
echo "To see charts and flights, open results/quick.html in a browser." >&2
