#!/usr/bin/env bash
# changed_files.sh: the files that differ from the main branch, or on the main branch itself those of its last thirty
# commits, with what is not committed yet. One path per line, the latest changed first. A file that only moved has not
# changed; one that moved later is called as it is now.
set -euo pipefail
cd "$(dirname "$0")/.."

commits=(-n 30)
if fork=$(git merge-base HEAD origin/main 2>/dev/null) && [ "$fork" != "$(git rev-parse HEAD)" ]; then
  commits=("$fork..HEAD")
fi
{
  git diff --name-status -M HEAD
  git ls-files --others --exclude-standard | sed 's/^/A\t/'
  git log --name-status -M --format= "${commits[@]}"
} | awk -F'\t' '{ name = $NF in now ? now[$NF] : $NF }
  $1 ~ /^R/ { now[$2] = name }
  $1 != "" && $1 != "R100" && !seen[name]++ { print name }' | while read -r file; do
  [ ! -f "$file" ] || echo "$file"
done
