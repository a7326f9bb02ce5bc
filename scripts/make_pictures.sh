#!/usr/bin/env bash
# make_pictures.sh: redraws the pictures of README.md, docs/maps.md and docs/sensors.md with build/release/avoidbench.
# AVOIDBENCH_PYTHON: a Python with matplotlib and pandas (default: python3).
set -euo pipefail
cd "$(dirname "$0")/.."
program=build/release/avoidbench out=docs/images

show() {  # FILE WIDTH HEIGHT VIEW MAP [option…]
  local file=$1 width=$2 height=$3 view=$4
  shift 4
  "$program" maps show "$@" --view "$view" --width "$width" --height "$height" --samples 3 --png "$out/$file.png"
}

show forest 800 500 first_person forest
show hall 800 500 first_person hall
show depth 800 500 depth forest
show map_forest 480 360 bird forest
show map_forest_top 480 360 top forest
show map_hall 480 360 first_person hall --set crates_ratio=0.3 --set shelf_ratio=0.3 --set pillar_ratio=0.2
show map_avoidbench_forest 480 360 bird avoidbench_forest
show map_avoidbench_indoor 480 360 first_person avoidbench_indoor
show map_maze 480 360 bird maze
show map_maze_top 480 360 top maze
show map_gap_walls 480 360 bird gap_walls
show map_gates 480 360 first_person gap_walls --set gap_height_m=1.4 --set gaps_per_wall=3
show map_dead_ends 480 360 bird dead_ends
show map_poles 480 360 first_person poles
show map_overhangs 480 360 bird overhangs
for opacity in 0 0.25 0.5 0.75 1; do
  show "opacity_$opacity" 240 240 first_person hall --set "texture_opacity=$opacity"
done
show own_map 720 480 bird configs/sweeps/own_map.yaml
show own_cloud 720 480 bird configs/sweeps/own_cloud.yaml

for sensor in depth_ideal depth_noisy stereo_sgm stereo_sgbm stereo_original d435_like oak_d_like surround; do
  "$program" sensors show "$sensor" --map forest --view depth --png "$out/sensor_$sensor.png"
done
"$program" sensors show stereo_sgm --map hall --png "$out/sensor_sheet_hall.png"
"$program" sensors show stereo_sgm --map forest --png "$out/sensor_sheet_forest.png"
errors=$(mktemp)
trap 'rm -f "$errors"' EXIT
"$program" sensors measure stereo_sgm stereo_sgbm depth_noisy stereo_original --map hall --of cylinder --missions 10 --bin 15 \
  --over maps.texture_opacity=1,0.8,0.6,0.4,0.2,0.1,0 --format csv --output "$errors"
"${AVOIDBENCH_PYTHON:-python3}" scripts/plot/sensor_errors.py "$errors" "$out/sensor_opacity.png"
