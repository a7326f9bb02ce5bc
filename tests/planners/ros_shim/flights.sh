#!/usr/bin/env bash
# flights.sh PROGRAM PLANNER: the example in easy halls: it reaches the goals; one and two workers and a second run give
# the same rows, and stored trials fly again bit for bit.
set -euo pipefail
program=$1 planner=$2
# shellcheck source-path=SCRIPTDIR source=../support/same_rows.sh
source "$(dirname "$0")/../support/same_rows.sh"
cat > hall.yaml <<YAML
sweep: ros_example
seed: 1
maps:
  generator: hall
  area_m: [12, 18]
  poisson_radius_m: [4, 5]
  seeds: [1]
trials: 2
planners:
  - $planner
vehicle: hummingbird
sensor: {preset: depth_ideal, width_px: 160, height_px: 120}
latency: {mode: fixed, ms: 33}
mission: {time_limit_s: 60}
YAML
same_rows "$program" hall.yaml
reached=$(sqlite3 one.db "SELECT count(*) FROM trials WHERE finished = 1")
[ "$reached" -eq 4 ] || { echo "$reached of 4 flights reached the goal" >&2; exit 1; }
