#!/usr/bin/env bash
# site.sh [FOLDER]: builds the documentation's site in FOLDER (build/site): docs/, the pages linked from there, and a reference
# that the program writes (AVOIDBENCH_PROGRAM, build/release/avoidbench). Fails at a dead link. `scripts/site.sh --serve` shows
# the site at http://localhost:8000 while you edit.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/python_venv.sh
export AVOIDBENCH_PROGRAM=${AVOIDBENCH_PROGRAM:-$PWD/build/release/avoidbench} NO_MKDOCS_2_WARNING=1
[ -x "$AVOIDBENCH_PROGRAM" ] || { echo "no program at $AVOIDBENCH_PROGRAM: build it first (scripts/quickstart.sh)" >&2; exit 2; }
if [ "${1:-}" = --serve ]; then exec build/venv/bin/mkdocs serve; fi
build/venv/bin/mkdocs build --strict --quiet --site-dir "${1:-build/site}"
echo "site: ${1:-build/site}/index.html"
