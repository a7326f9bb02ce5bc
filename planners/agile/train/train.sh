#!/usr/bin/env bash
# train.sh [--steps N | --minutes M] [--seed S] [--out FOLDER] [--few]: makes samples, trains agile's net on them, lets
# it fly, and trains it on what it met. Writes agile.safetensors, curves, success during training and figures into
# FOLDER (build/agile; in the repository unless it begins with /). To fly the weights copy them to planners/agile and
# build. One that was stopped goes on with the next part.
#   --steps N      steps of the three trainings together (18000: 16 to 30 minutes on two cores). Samples and flights
#   take half as long again as they
#   --minutes M    wall time of the three trainings together, instead of steps: weights then depend on the machine's
#   speed
#   --seed S       of the trainings and of the samples' flights (1); maps and missions stay the same
#   --few          a sixteenth of the flights and of the steps: to see that all of it works
# Needs the release build (scripts/quickstart.sh or cmake) and Python 3.10 or later; PyTorch comes into an environment
# of its own.
set -euo pipefail
cd "$(dirname "$0")/../../.."

steps=18000 minutes="" seed=1 out=build/agile few=()
usage() { sed -n '2,10s/^# \{0,1\}//p' "$0" >&2; exit 2; }
while [ $# -gt 0 ]; do
  case "$1" in
    --steps) steps=${2:?}; shift 2 ;;
    --minutes) minutes=${2:?}; shift 2 ;;
    --seed) seed=${2:?}; shift 2 ;;
    --out) out=${2:?}; shift 2 ;;
    --few) few=(--set trials=1); steps=$((steps / 16)); shift ;;
    *) usage ;;
  esac
done

samples=build/release/agile_samples
[ -x "$samples" ] || { echo "train.sh: $samples is not there: build it first (cmake --build build/release)" >&2; exit 1; }
python=build/train_venv/bin/python
# Asked of Python itself: an installation that broke off goes on.
if ! "$python" -c 'import matplotlib, numpy, torch' 2>/dev/null; then
  echo "Making a Python environment with PyTorch in build/train_venv"
  python3 -m venv build/train_venv
  "$python" -m pip install --quiet --disable-pip-version-check -r planners/agile/train/requirements.txt
fi
mkdir -p "$out/done"
# What was made by other options is not gone on with.
options="seed $seed, ${minutes:+$minutes minutes}"
[ -n "$minutes" ] || options+="$steps steps"
[ ${#few[@]} -eq 0 ] || options+=", few"
if [ -e "$out/options" ] && [ "$(cat "$out/options")" != "$options" ]; then
  echo "train.sh: $out was made with $(cat "$out/options"), not $options: name another --out, or remove it" >&2
  exit 1
fi
echo "$options" > "$out/options"

# fly NAME SWEEP SENSOR FIRST_MAP_SEED COUNT [OPTION…]: samples of so many maps of each kind in a sweep, by this sensor.
fly() {
  local name=$1 sweep=$2 sensor=$3 first=$4 count=$5
  shift 5
  [ ${#few[@]} -eq 0 ] || count=1
  echo "== samples: $name"
  if [ -e "$out/done/$name" ]; then return; fi
  rm -rf "${out:?}/$name"
  "$samples" "planners/agile/train/$sweep.yaml" --out "$out/$name" --set "sensor.preset=$sensor" \
    --set "maps.seeds=[$(seq -s ', ' "$first" $((first + count - 1)))]" --seed $((seed * 10 + first)) "${few[@]}" "$@"
  touch "$out/done/$name"
}
# train NAME SHARE_OF_THE_STEPS OPTION…
train() {
  local name=$1 share=$2 length=(--steps)
  shift 2
  if [ -e "$out/done/$name" ]; then return; fi
  length+=("$(awk "BEGIN { print int($share * $steps) }")")
  if [ -n "$minutes" ]; then length=(--minutes "$(awk "BEGIN { print $share * $minutes }")"); fi
  OMP_WAIT_POLICY=passive "$python" planners/agile/train/train.py --seed "$seed" "${length[@]}" --snapshots 3 \
    --out "$out/$name.safetensors" --plot "$out/${name}_curves.png" --log "$out/$name.json" "$@"
  touch "$out/done/$name"
}

fly forest_ideal forest depth_ideal 9000001 4
fly forest_stereo forest stereo_sgm 9000011 4
fly hall_ideal hall depth_ideal 9000021 4
fly hall_stereo hall stereo_sgm 9000031 4
first=("$out"/forest_ideal "$out"/forest_stereo "$out"/hall_ideal "$out"/hall_stereo)
echo "== first training: by the expert's flights"
train first 0.35 --recipe imitation --samples "${first[@]}"

# What the net meets where it flies itself, with what the expert would do there (DAgger).
own=(--weights "$out/first.safetensors")
fly own_forest_ideal forest depth_ideal 9000041 2 "${own[@]}"
fly own_forest_stereo forest stereo_sgm 9000051 3 "${own[@]}"
fly own_hall_stereo hall stereo_sgm 9000061 2 "${own[@]}"
second=("${first[@]}" "$out"/own_*)
echo "== second training: down the cost"
train second 0.35 --recipe descent --rate 1e-3 --samples "${second[@]}" --init "$out/first.safetensors"

own=(--weights "$out/second.safetensors")
fly walls walls depth_ideal 9000071 4
fly traps traps depth_ideal 9000071 4
fly again_walls walls depth_ideal 9000081 4 "${own[@]}"
fly again_traps traps depth_ideal 9000081 4 "${own[@]}"
fly again_forest forest stereo_sgm 9000091 1 "${own[@]}"
third=("${second[@]}" "$out"/walls "$out"/traps "$out"/again_*)
echo "== third training: with what can't be passed"
train agile 0.3 --recipe descent --rate 1e-3 --samples "${third[@]}" --init "$out/second.safetensors"

# How the weights fly that were there on the way: missions of the reserved maps that no sample is from.
nets=()
for name in first second agile; do
  nets+=("$out/${name}_1of3" "$out/${name}_2of3" "$out/$name")
done
for net in "${nets[@]}"; do
  echo "== flights of $net"
  "$samples" planners/agile/train/success.yaml --weights "$net.safetensors" --outcomes "${net}_flights.json" \
    --least-speed 3 --most-speed 3 "${few[@]}"
done
"$python" planners/agile/train/success.py --plot "$out/success.png" "${nets[@]/%/_flights.json}"
echo "the weights are in $out/agile.safetensors; to fly them: cp $out/agile.safetensors planners/agile/ and build"
