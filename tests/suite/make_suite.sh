#!/usr/bin/env bash
# make_suite.sh FOLDER: a suite of one track, one cell and two sweeps of tiny maps, frozen by this program (`avoidbench` on
# the PATH), as docs/suite.md says how to make one. Its sealed key is 64 times the digit a.
set -euo pipefail
folder=$1
mkdir -p "$folder/depth"
for sweep in hall poles; do
  cat >"$folder/depth/$sweep.yaml" <<END
sweep: $sweep
maps: {generator: $sweep, area_m: [12, 14], poisson_radius_m: 3.5, seeds: [101, 102]}
seed: 2
trials: 10
sensor: {width_px: 48, height_px: 36}
mission: {time_limit_s: 15}
planners: [straight_line]
END
done
write() {  # the suite with these digests of maps and missions, 8 of them
  {
    echo "suite: tiny-1"
    echo "tracks: {depth: A tiny suite}"
    echo "splits:"
    echo "  dev: {seed: 1, first_map_seed: 1, missions: 1}"
    echo "  public: {seed: 2, first_map_seed: 101, missions: 10}"
    echo "  sealed: {key_sha256: $(printf 'a%.0s' {1..64} | sha256sum | cut -c 1-64), missions: 1}"
    echo "cells:"
    echo "  - cell: small"
    echo "    sweeps:"
    for sweep in hall poles; do
      echo "      - {sweep: $sweep, maps: 2, file_sha256: {depth: $(sha256sum "$folder/depth/$sweep.yaml" | cut -c 1-64)},"
      echo "         dev: {maps_sha256: $1, missions_sha256: $2}, public: {maps_sha256: $3, missions_sha256: $4}}"
      shift 4
    done
  } >"$folder/suite.yaml"
}
zeros=$(printf '0%.0s' {1..64})
write $zeros $zeros $zeros $zeros $zeros $zeros $zeros $zeros
found=$({ avoidbench suite check "$folder/depth" || true; } | grep -o 'SHA-256 [0-9a-f]*, expected' | cut -d ' ' -f 2 | tr -d ,)
# shellcheck disable=SC2086
write $found
