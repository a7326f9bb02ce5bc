#!/usr/bin/env bash
# golden.sh PROGRAM SOURCE_FOLDER SHARE RESULT…: flies a sample of published results of avoidbench-1 again: the suite is frozen, so that each
# flight is the same for ever, bit for bit. A planner that was changed needs new results: `avoidbench suite run` with its planner.yaml.
set -euo pipefail
program=$1 source=$2 share=$3
shift 3
for result in "$@"; do
  "$program" suite verify "$source/results/suites/$result" --sample "$share" --quiet
done
