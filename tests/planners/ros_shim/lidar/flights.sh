#!/usr/bin/env bash
# flights.sh PROGRAM PLANNER: a node that hears the points of a lidar flies in easy halls by a lidar alone, and by a
# raw one in a rig: its clouds agree, rows are the same with two workers, stored trials fly again bit for bit. A sensor
# without a lidar is refused.
set -euo pipefail
program=$1 planner=$2
# shellcheck source-path=SCRIPTDIR source=../../support/same_rows.sh
source "$(dirname "$0")/../../support/same_rows.sh"
cat > hall.yaml <<YAML
sweep: ros_lidar
seed: 1
maps: {generator: hall, area_m: [12, 18], poisson_radius_m: [5], seeds: [1]}
trials: 2
planners:
  - $planner
vehicle: hummingbird
sensor: mid360_like
latency: {mode: fixed, ms: 33}
mission: {time_limit_s: 60}
YAML
"$program" planners describe "$planner" | grep -q points || { echo "it does not declare points" >&2; exit 1; }
same_rows "$program" hall.yaml
reached=$(sqlite3 one.db "SELECT count(*) FROM trials WHERE finished = 1")
[ "$reached" -eq 2 ] || { sqlite3 one.db "SELECT outcome, reason FROM trials" >&2; exit 1; }
# Points of a lidar that does not de-skew are placed as if it had stood still: the node flies by them all the same.
rig='sensor={preset: depth_ideal, width_px: 16, height_px: 12, lidars: [{preset: mid360_like, deskewed: false}]}'
"$program" run hall.yaml --set "$rig" --db raw.db --quiet
failed=$(sqlite3 raw.db "SELECT count(*) FROM trials WHERE outcome NOT IN ('reached_goal', 'collided')")
[ "$failed" -eq 0 ] || { sqlite3 raw.db "SELECT outcome, reason FROM trials" >&2; exit 1; }
if "$program" run hall.yaml --set sensor=depth_ideal --db none.db --quiet 2> said.txt; then
  echo "a sensor without a lidar was flown" >&2
  exit 1
fi
grep -q "it has no lidar" said.txt || { cat said.txt >&2; exit 1; }
