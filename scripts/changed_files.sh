#!/usr/bin/env bash
# changed_files.sh: the files that differ from the main branch, or on the main branch itself those of its last thirty
# commits, with what is not committed yet. One path per line, the latest changed first.
set -euo pipefail
cd "$(dirname "$0")/.."

commits=(-n 30)
if fork=$(git merge-base HEAD origin/main 2>/dev/null) && [ "$fork" != "$(git rev-parse HEAD)" ]; then
  commits=("$fork..HEAD")
fi
{
  git diff --name-only HEAD
  git ls-files --others --exclude-standard
  git log --name-only --format= "${commits[@]}"
} | awk '!seen[$0]++' | while read -r file; do
  [ ! -f "$file" ] || echo "$file"
done
