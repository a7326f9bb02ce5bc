#!/usr/bin/env bash
# make_wheel.sh [FOLDER]: makes a wheel in FOLDER (build/wheels) for the Python of build/venv and no other (PYTHON=PROGRAM
# chooses it, see python_venv.sh). It contains the program, its planners, its data, the extension and every library that
# they link to, except the C and C++ libraries: it runs where these are no older than here. Prints the wheel's path last.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=${1:-build/wheels}
scripts/install_packages.sh python
scripts/python_venv.sh
export CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=$PWD CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
export PATH=$PWD/build/venv/bin:$PATH
python=build/venv/bin/python
mkdir -p "$folder"
work=$(mktemp -d "$folder/work.XXXXXX")
trap 'rm -rf "$work"' EXIT

echo "building" >&2
"$python" -m pip wheel . --quiet --disable-pip-version-check --no-deps --no-build-isolation --wheel-dir "$work/plain"

echo "adding the libraries" >&2
# The C library that it was linked to is the oldest that works.
glibc=$(getconf GNU_LIBC_VERSION | grep -oE '[0-9]+[.][0-9]+')
"$python" scripts/repair_wheel.py repair --plat "manylinux_${glibc/./_}_$(uname -m)" --only-plat --wheel-dir "$work/repaired" "$work"/plain/*.whl >&2
mv "$work"/repaired/*.whl "$folder/"
ls -t "$folder"/*.whl | head -n 1
