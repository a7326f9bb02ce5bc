#!/usr/bin/env bash
# python_venv.sh [FOLDER]: makes a Python environment in FOLDER (build/venv) with the versions of
# python/requirements.lock, to build and test the Python package. Does nothing if it exists and neither the lock nor the
# system's Python has changed since. PYTHON=PROGRAM: use that Python instead of the system's.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=${1:-build/venv}
lock=python/requirements.lock
python=${PYTHON:-/usr/bin/python3}
wanted="$("$python" -c 'import sys; print(sys.version)') $(sha256sum <"$lock")"
if [ -x "$folder/bin/python" ] && [ "$(cat "$folder/made_of" 2>/dev/null)" = "$wanted" ]; then exit 0; fi

echo "making the Python environment $folder" >&2
"$python" -m venv --clear "$folder"
# Builds no wheels from sdists: the lock's packages are downloaded as they are.
"$folder/bin/python" -m pip install --quiet --disable-pip-version-check --require-hashes --only-binary :all: --requirement "$lock"
echo "$wanted" >"$folder/made_of"
