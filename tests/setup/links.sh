#!/usr/bin/env bash
# links.sh SOURCE_FOLDER BUILD_FOLDER: no link of the pages is dead, in the repository, in an installed copy, and on the site where its
# tools are (scripts/python_venv.sh).
set -euo pipefail
cd "$1"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 tests/setup/check_links.py .
cmake --install "$2" --prefix "$folder/prefix" --component programs >/dev/null
python3 tests/setup/check_links.py "$folder/prefix/share/avoidbench"
if [ -x build/venv/bin/mkdocs ]; then AVOIDBENCH_PROGRAM=$2/avoidbench scripts/site.sh "$folder/site"; fi
