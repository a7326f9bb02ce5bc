#!/usr/bin/env bash
# A user's first week, typed as the user would, with an installed copy in a folder of its own: a first sweep, a planner
# of one's own, its crash, a map of one's own, a comparison, results for a colleague.
#   first_week.sh BUILD_FOLDER CXX_COMPILER
set -euo pipefail
build=$1 compiler=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >/dev/null
cd "$work" && mkdir user && cd user
export PATH=$work/prefix/bin:$PATH CXX=$compiler HOME=$work/user
unset AVOIDBENCH_PLANNER_PATH

step() { echo "== $*"; }
fail() { echo "first_week: $*" >&2; exit 1; }
expect() { grep -qE -- "$1" "$2" || { cat "$2" >&2; fail "expected '$1' in $2"; }; }

step "Monday: a first sweep"
few=(quick --set trials=1 --set 'planners=[reactive, mbplanner]' --quiet)
avoidbench run "${few[@]}" 2>run.txt
expect 'results are in results/quick.db' run.txt
avoidbench report >report.txt
expect 'mbplanner' report.txt
avoidbench run "${few[@]}" 2>again.txt
expect 'are already in the database' again.txt

step "Tuesday: a planner of one's own, by what \`planners new\` says"
avoidbench planners new swift >next.txt
grep '^  ' next.txt | while read -r line; do
  case $line in *run*) line="$line --set trials=1 --quiet" ;; esac
  sh -c "$line" >>typed.txt 2>&1 || { cat typed.txt >&2; fail "$line"; }
done
expect 'it can be benchmarked' typed.txt
avoidbench report results/swift.db >swift.txt
expect '^swift ' swift.txt

step "Wednesday: it crashes in one mission of several"
sed -i 's|const ab_state& state = \*seen.state;|&\n    if (state.position_world_m[1] > 20.0) __builtin_trap();|' swift/swift.cpp
cmake --build swift/build >/dev/null
avoidbench run swift/sweep.yaml --set trials=1 --quiet 2>crash.txt
avoidbench report results/swift.db --tables outcomes >crashed.txt
expect '^swift ' crashed.txt
avoidbench replay results/swift.db --list --outcome planner_crashed >list.txt
expect 'swift' list.txt

step "Thursday: a map of one's own"
avoidbench maps export own_map mine.glb >exported.txt
cat >mine.yaml <<'END'
sweep: mine
maps: {generator: mesh, file: mine.glb, up_axis: y}
trials: 2
planners: [reactive]
END
avoidbench maps info mine.yaml >info.txt
expect '^triangle_count +3632' info.txt
avoidbench run mine.yaml --quiet
avoidbench maps show mine.yaml --png mine.png

step "Friday: compare, and share"
avoidbench compare results/quick.db results/quick.db --exact >/dev/null
avoidbench export trials results/quick.db --output trials.csv
expect '^sweep,' trials.csv
avoidbench report results/quick.db --metrics-from "$work/prefix/share/avoidbench/configs/metrics/example.sql" >own.txt
expect 'detour' own.txt
mkdir ../colleague && cp results/quick.db ../colleague/ && cd ../colleague
avoidbench replay quick.db --verify >verified.txt 2>&1 || { cat verified.txt >&2; fail "a colleague can't fly it again"; }

step "what is left: nothing of the build folder"
! grep -rIl --include='*.cmake' --include='*.yaml' --include='*.md' -- "$build" "$work/prefix" || fail "the installed copy names the build folder"
echo "first week: done"
