#!/usr/bin/env bash
# The commands of docs/submit.md, typed as a newcomer would, with an installed copy, on the tiny suite in place of avoidbench-1.
#   tutorial.sh BUILD_FOLDER SOURCE_FOLDER CXX_COMPILER
set -euo pipefail
build=$1 source=$2 compiler=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >/dev/null
mkdir "$work/user" && cd "$work/user"
export PATH=$work/prefix/bin:$PATH CXX=$compiler HOME=$work/user
unset AVOIDBENCH_PLANNER_PATH
"$source/tests/suite/make_suite.sh" tiny-1

# The file that the page shows, and then its commands in their order.
sed -n '/^```yaml$/,/^```$/p' "$source/docs/submit.md" | sed '1d;$d' >planner.yaml
count=0
while IFS= read -r line; do
  line=${line//avoidbench-1/tiny-1}
  # A suite of one's own is named by its folder where results are read.
  case $line in *"suite verify"* | *"suite board"*) line="$line --suite tiny-1/depth" ;; esac
  echo "== $line"
  sh -c "$line" >out.txt 2>&1 || { cat out.txt >&2; echo "tutorial: failed: $line" >&2; exit 1; }
  count=$((count + 1))
done < <(sed -n 's/^    //p' "$source/docs/submit.md")
[ "$count" -ge 9 ] || { echo "tutorial: $count commands only" >&2; exit 1; }
# The result's digest draws the sample, and this planner's file differs from run to run: 1 % of 40 flights is mostly one, at times more.
grep -Eq '^verified: ([1-9][0-9]*) of \1 flights? (is|are) the same, bit for bit' out.txt || { cat out.txt >&2; exit 1; }
grep -q '"label":"swift"' board.html
echo "tutorial: $count commands"
