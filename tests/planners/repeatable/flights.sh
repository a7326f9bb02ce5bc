#!/usr/bin/env bash
# flights.sh PROGRAM PLANNER: a planner that samples until its clock says stop gives the same rows with one and two
# workers on a busy machine, and others where computing costs more.
set -euo pipefail
program=$1 planner=$2
# shellcheck source-path=SCRIPTDIR source=../support/same_rows.sh
source "$(dirname "$0")/../support/same_rows.sh"
cat > hall.yaml <<YAML
sweep: anytime
seed: 1
maps: {generator: hall, area_m: [12, 18], poisson_radius_m: [5], seeds: [1]}
trials: 4
planners:
  - {plugin: $planner, label: anytime}
sensor: depth_ideal
latency: {mode: fixed, ms: 33}
mission: {time_limit_s: 60}
YAML
same_rows_under_load "$program" hall.yaml
sed 's/label: anytime/&, parameters: {compute_clock_us: 4}/' hall.yaml > dear.yaml
"$program" run dear.yaml --db dear.db --quiet
digests() { sqlite3 "$1" "SELECT flight_digest FROM trials ORDER BY mission_index"; }
if [ "$(digests one.db)" = "$(digests dear.db)" ]; then
  echo "what computing costs changes nothing" >&2
  exit 1
fi
"$program" planners check "$planner" > said.txt || { cat said.txt >&2; exit 1; }
if grep -E 'steady_clock|random_device|usleep' said.txt >&2; then
  echo "a clock or chance of others is asked" >&2
  exit 1
fi
