#!/usr/bin/env bash
# verify_results.sh [SHARE]: flies a share (default 1%) of the flights of every committed result again, and checks that
# they are the same to the last bit: suite results (results/suites) and tables of the paper's sweeps (results/paper).
# Flights of planners that are built elsewhere (results/published) are left out, since their programs are not here.
#   PROGRAM=avoidbench scripts/verify_results.sh     with an installed avoidbench, or one from a wheel
# Exit code 0 if everything is the same, 1 if a flight differs, 2 for bad input.
set -euo pipefail
cd "$(dirname "$0")/.."

share=${1:-1%}
percent=${share%\%}
[[ $share == *% && $percent =~ ^[0-9]+$ && $percent -ge 1 && $percent -le 100 ]] || {
  echo "usage: $0 [SHARE]: a whole percentage, such as 1%" >&2
  exit 2
}
program=${PROGRAM:-build/release/avoidbench}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=()

verified() { # NAME COMMAND…: prints the last line of its output, or all of it on failure
  local name=$1
  shift
  if "$@" >"$scratch/said" 2>&1; then
    printf '%-55s %s\n' "$name" "$(tail -n 1 "$scratch/said")"
  else
    printf '%-55s FAILED\n' "$name"
    cat "$scratch/said"
    failed+=("$name")
  fi
}

for file in results/suites/*/*/*/*/planner.yaml; do
  folder=$(dirname "$file")
  verified "${folder#results/suites/}" "$program" suite verify "$folder" --sample "$share" --quiet
done

# A table's sweep and sensor are in its name: paper_outdoor.csv, paper_outdoor_depth.csv.
part() { # TABLE: flies a shard of its sweep and compares it with the table
  local table=$1 sweep sensor=stereo_sgm missions
  sweep=$(basename "$table" .csv)
  [[ $sweep != *_depth ]] || sensor=depth_ideal
  missions=$(awk -F, '/^#/ { next } !column { for (i = 1; i <= NF; i++) if ($i == "mission_index") column = i }
                      $column ~ /^[0-9]+$/ && $column >= count { count = $column + 1 } END { print count }' "$table")
  "$program" run "${sweep%_depth}" --set "sweep=$sweep" --set "sensor=$sensor" --set "trials=$missions" \
    --shard "1/$((100 / percent))" --db "$scratch/$sweep.db" --quiet &&
    "$program" compare "$table" "$scratch/$sweep.db" --exact --sample
}
for table in results/paper/*.csv; do
  [ ! -e "$table" ] || verified "$(basename "$table")" part "$table"
done

[ ${#failed[@]} -eq 0 ] || { echo "not the same: ${failed[*]}"; exit 1; }
echo "all flights of the samples are the same, bit for bit"
