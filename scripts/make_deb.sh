#!/usr/bin/env bash
# make_deb.sh [FOLDER]: makes a Debian package in FOLDER (build/packages) with the program, its planners, data and SDK. The
# package depends on the libraries it was built with: make it on the Debian release that it is for. Prints its path last.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=${1:-build/packages}
scripts/install_packages.sh deb >&2
export CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=$PWD
cmake --preset release -B build/deb -DAVOIDBENCH_TESTS=OFF -DAVOIDBENCH_BENCH=OFF -DAVOIDBENCH_WERROR=OFF -DAVOIDBENCH_UNITY=ON >/dev/null
cmake --build build/deb --parallel "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" >&2
mkdir -p "$folder"
folder=$(realpath "$folder")
(cd build/deb && cpack -B "$folder/work" >&2)
mv "$folder"/work/*.deb "$folder/"
rm -rf "$folder/work"
ls -t "$folder"/*.deb | head -n 1
