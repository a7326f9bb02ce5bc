#!/usr/bin/env bash
# check_bundle.sh FILE: the committed bundle of the page is what its sources give.
set -euo pipefail
cd "$(dirname "$0")/../.."
scripts/bundle_page.sh "$1"
cmp "$1" apps/page/page_program.cpp || { echo "run scripts/bundle_page.sh and commit apps/page/page_program.cpp" >&2; exit 1; }
