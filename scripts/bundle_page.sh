#!/usr/bin/env bash
# bundle_page.sh [FILE]: bundles apps/page/src into apps/page/page_program.cpp (or FILE), with the packages pinned in
# apps/page/package-lock.json, which npm fetches into build/page. The same lock file gives the same bytes.
#   --packages   only fetch the packages, for tests and lint
set -euo pipefail
cd "$(dirname "$0")/.."

page=build/page
mkdir -p "$page"
lock=$(sha256sum apps/page/package-lock.json)
if [ "$(cat "$page/installed" 2>/dev/null)" != "$lock" ]; then
  echo "npm ci in $page" >&2
  cp apps/page/package.json apps/page/package-lock.json "$page/"
  (cd "$page" && npm ci --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=1 --fetch-timeout=60000 >&2)
  echo "$lock" >"$page/installed"
fi
for linked in src build.mjs tsconfig.json; do ln -sfn "../../apps/page/$linked" "$page/$linked"; done
[ "${1:-}" != --packages ] || exit 0
out=$(realpath "${1:-apps/page/page_program.cpp}")
(cd "$page" && node --preserve-symlinks --preserve-symlinks-main build.mjs "$out")
