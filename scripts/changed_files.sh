#!/usr/bin/env bash
# changed_files.sh: prints the files that differ from the main branch (on the main branch: those changed in its last
# thirty commits) and all uncommitted changes. One path per line, the latest change first. A file that was only moved is
# not listed; a file moved after its change is listed under its present name.
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
