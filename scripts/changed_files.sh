#!/usr/bin/env bash
# changed_files.sh: the files that differ from the main branch, or on the main branch itself from the commit before, with
# what is not committed yet. One path a line.
set -euo pipefail
cd "$(dirname "$0")/.."

base=HEAD
if fork=$(git merge-base HEAD origin/main 2>/dev/null) && [ "$fork" != "$(git rev-parse HEAD)" ]; then
  base=$fork
elif git rev-parse --verify -q HEAD~1 >/dev/null; then
  base=HEAD~1
fi
git diff --name-only --diff-filter=d "$base"
git ls-files --others --exclude-standard
