#!/usr/bin/env bash
# Installs what is missing, builds the release, flies a small sweep and prints its report. May be run again: it goes on where it was.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh build
echo "building build/release" >&2
cmake --preset release -DAVOIDBENCH_TESTS=OFF -DAVOIDBENCH_BENCH=OFF -DAVOIDBENCH_WERROR=OFF >/dev/null
cmake --build build/release --parallel "$(nproc)"
build/release/avoidbench run configs/sweeps/quick.yaml
build/release/avoidbench report results/quick.db
echo
echo "The program is build/release/avoidbench; results are in results/quick.db." >&2
