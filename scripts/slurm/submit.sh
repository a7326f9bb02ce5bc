#!/usr/bin/env bash
# Flies a sweep on a Slurm cluster: submits a job array of N shards, and a job that merges them when all are done.
set -euo pipefail

usage() {
  cat <<'END'
usage: scripts/slurm/submit.sh [OPTION…] SWEEP N [-- SBATCH OPTION…]

Submits SWEEP (a YAML file) as a job array of N shards and a job that merges them afterwards into one database. Options
after -- go to sbatch for both jobs. Prints what it submits.

  --out FILE        the merged database [results/<name of the sweep file>.db]
  --folder FOLDER   for finished shards, shared by all nodes [<FILE without .db>.shards]
  --elements LIST   submit only these elements, such as 3,7-9: those that an earlier array lost [1-N]
  --cpus COUNT      CPUs, and so worker processes, per element [1]
  --time LIMIT      time limit per element; at the limit it saves its flights and queues again [1:00:00]
  --program FILE    avoidbench [the one in PATH, else build/release/avoidbench]
  --run-options S   more options for `avoidbench run`, such as "--set trials=20 --plan-timeout 20"
  --dry-run         print, submit nothing
  --help

Example: scripts/slurm/submit.sh configs/sweeps/paper_outdoor.yaml 100 --cpus 4 -- --partition=cpu --account=mine
END
}
fail() {
  echo "submit.sh: $*" >&2
  exit 2
}

here=$(cd "$(dirname "$0")" && pwd)
out='' folder='' elements='' cpus=1 time_limit=1:00:00 program='' run_options='' dry_run='' words=()
while [ $# -gt 0 ]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --dry-run) dry_run=yes; shift ;;
    --out | --folder | --elements | --cpus | --time | --program | --run-options)
      [ $# -ge 2 ] || fail "$1 needs a value"
      case "$1" in
        --out) out=$2 ;;
        --folder) folder=$2 ;;
        --elements) elements=$2 ;;
        --cpus) cpus=$2 ;;
        --time) time_limit=$2 ;;
        --program) program=$2 ;;
        --run-options) run_options=$2 ;;
      esac
      shift 2 ;;
    --) shift; break ;;
    -*) fail "unknown option $1; see --help" ;;
    *) words+=("$1"); shift ;;
  esac
done
sbatch_options=("$@")
[ ${#words[@]} -eq 2 ] || { usage >&2; exit 2; }
sweep=${words[0]} count=${words[1]}
[ -f "$sweep" ] || fail "no file $sweep"
[[ $count =~ ^[1-9][0-9]*$ ]] || fail "N must be a number of shards, not '$count'"
[[ $cpus =~ ^[1-9][0-9]*$ ]] || fail "--cpus needs a number, not '$cpus'"
if [ -z "$program" ]; then program=$(command -v avoidbench || echo "$here/../../build/release/avoidbench"); fi
[ -x "$program" ] || fail "no program $program; give it with --program"
[ -n "$out" ] || out=results/$(basename "${sweep%.*}").db
[ -n "$folder" ] || folder=${out%.db}.shards

# Report wrong input now, not in N jobs.
"$program" config check "$sweep" >/dev/null

absolute() { realpath -m "$1"; }
AVOIDBENCH=$(absolute "$program")
AVOIDBENCH_SWEEP=$(absolute "$sweep")
AVOIDBENCH_SHARDS=$count
AVOIDBENCH_FOLDER=$(absolute "$folder")
AVOIDBENCH_OUT=$(absolute "$out")
AVOIDBENCH_OPTIONS=$run_options
export AVOIDBENCH AVOIDBENCH_SWEEP AVOIDBENCH_SHARDS AVOIDBENCH_FOLDER AVOIDBENCH_OUT AVOIDBENCH_OPTIONS
logs=$AVOIDBENCH_FOLDER/logs

array=(sbatch --parsable --export=ALL "--array=${elements:-1-$count}" "--cpus-per-task=$cpus" "--time=$time_limit"
  "--output=$logs/%x-%A_%a.log" "${sbatch_options[@]}" "$here/array.sbatch")
merge=(sbatch --parsable --export=ALL --kill-on-invalid-dep=yes "--output=$logs/%x-%j.log" "${sbatch_options[@]}" "$here/merge.sbatch")

env | grep '^AVOIDBENCH' | sort
echo "${array[*]}"
if [ -n "$dry_run" ]; then
  echo "${merge[0]} --dependency=afterok:ARRAY ${merge[*]:1}"
  exit 0
fi
mkdir -p "$logs" "$(dirname "$AVOIDBENCH_OUT")"
array_id=$("${array[@]}")
array_id=${array_id%%;*}  # a federation adds ;cluster
merge=("${merge[0]}" "--dependency=afterok:$array_id" "${merge[@]:1}")
echo "${merge[*]}"
merge_id=$("${merge[@]}")
echo "array $array_id, merge ${merge_id%%;*}; squeue -j $array_id,${merge_id%%;*} shows them; logs are in $logs"
