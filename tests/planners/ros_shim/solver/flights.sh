#!/usr/bin/env bash
# flights.sh PROGRAM STATIC SHARED WARN NM READELF: a node with a solver that has a time limit. Linked statically it
# flies the same in every run, on a busy machine too; of a shared one the build warns, and the check blames its clock.
set -euo pipefail
program=$1 planner=$2 shared=$3 warn=$4 nm=$5 readelf=$6
# shellcheck source-path=SCRIPTDIR source=../../support/same_rows.sh
source "$(dirname "$0")/../../support/same_rows.sh"
cat > hall.yaml <<YAML
sweep: ros_solver
seed: 1
maps: {generator: hall, area_m: [12, 18], poisson_radius_m: [5], seeds: [1]}
trials: 2
planners:
  - {plugin: $planner, label: solver}
sensor: depth_ideal
latency: {mode: fixed, ms: 33}
mission: {time_limit_s: 30}
YAML
same_rows_under_load "$program" hall.yaml
wrong=$(sqlite3 one.db "SELECT count(*) FROM trials WHERE outcome NOT IN ('reached_goal', 'collided')")
[ "$wrong" -eq 0 ] || { sqlite3 one.db "SELECT outcome, reason FROM trials" >&2; exit 1; }
sed 's/label: solver/&, parameters: {budget_us: 2000}/' hall.yaml > longer.yaml
"$program" run longer.yaml --db longer.db --quiet
digests() { sqlite3 "$1" "SELECT flight_digest FROM trials ORDER BY mission_index"; }
[ "$(digests one.db)" != "$(digests longer.db)" ] || { echo "a longer search changes nothing" >&2; exit 1; }

said() { python3 -B "$warn" --nm "$nm" --readelf "$readelf" "$1"; }
[ -z "$(said "$planner")" ] || { echo "a warning of a static library: $(said "$planner")" >&2; exit 1; }
said "$shared" | grep -q "liblimited_solver_shared.so, which .* asks for clock_gettime, gettimeofday: "
"$program" planners check "$planner" > said.txt || { cat said.txt >&2; exit 1; }
if "$program" planners check "$shared" > said.txt; then cat said.txt >&2; exit 1; fi
grep -q "✗ *repeats" said.txt || { cat said.txt >&2; exit 1; }
[ "$(grep -c "✗" said.txt)" -eq 1 ] || { echo "another rule is blamed" >&2; cat said.txt >&2; exit 1; }
grep -q "clock_gettime (liblimited_solver_shared.so)" said.txt || { cat said.txt >&2; exit 1; }
