#!/usr/bin/env bash
# looked_at.sh SOURCE_FOLDER: which files changed_files.sh and rotating_part.sh choose, in a repository of forty
# commits.
set -euo pipefail

source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b
expect() {  # expect WHAT WANTED GIVEN
  [ "$2" = "$3" ] || { printf '%s: expected\n%s\ngot\n%s\n' "$1" "$2" "$3"; exit 1; }
}

upstream=$folder/upstream
mkdir -p "$upstream/scripts" && cd "$upstream"
git init --quiet --initial-branch main
cp "$source"/scripts/{changed_files,rotating_part}.sh scripts/
for i in $(seq 40); do
  echo "$i" >"file_$i"
  git add . && git commit --quiet --message "$i"
done
git rm --quiet file_39 && git commit --quiet --message "without 39"

git clone --quiet "$upstream" "$folder/clone" && cd "$folder/clone"
expect "a fresh clone: the last thirty commits, the latest first" \
  "$(for i in 40 $(seq 38 -1 12); do echo "file_$i"; done)" "$(scripts/changed_files.sh)"

git checkout --quiet -b branch
echo more >>file_3 && git commit --quiet --all --message "on a branch"
echo more >>file_2 && touch file_new
expect "a branch: what it changes, with what is not committed" $'file_2\nfile_new\nfile_3' "$(scripts/changed_files.sh)"

git checkout --quiet --force main && git clean --quiet --force && git checkout --quiet -b moves
git mv file_38 moved && git commit --quiet --message "a move alone"
expect "a file that only moved" "" "$(scripts/changed_files.sh)"
echo more >>moved && git commit --quiet --all --message "a change" && git mv moved again && git commit --quiet --message "a move"
expect "a file that moved after its change" "again" "$(scripts/changed_files.sh)"

seen=
for commit in $(git log --format=%h -n 16 main); do
  git checkout --quiet --force "$commit"
  seen+=$(seq 30 | scripts/rotating_part.sh 2>/dev/null)$'\n'
done
expect "sixteen commits see every line once" "$(seq 30)" "$(grep . <<<"$seen" | sort -n)"

git clone --quiet --depth 1 "file://$upstream" "$folder/shallow" && cd "$folder/shallow"
turn=$(seq 16 | scripts/rotating_part.sh 2>/dev/null)
expect "a shallow clone: one line, the same each time" "1 $turn" "$(wc -w <<<"$turn") $(seq 16 | scripts/rotating_part.sh 2>/dev/null)"
