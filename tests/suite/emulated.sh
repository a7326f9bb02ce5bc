#!/usr/bin/env bash
# emulated.sh PROGRAM SOURCE_FOLDER PRELOAD RESULT…: flies one in a hundred of published flights on other processors, emulated by
# QEMU: one of 2008, without AVX, and one with AVX2 and fused multiply-add. Its arithmetic and its approximate reciprocals are
# neither AMD's nor Intel's.
set -euo pipefail
program=$1 source=$2 preload=$3
shift 3
qemu=$(command -v qemu-x86_64) || { echo "no qemu-x86_64 (package qemu-user)"; exit 77; }
for processor in Nehalem Haswell-noTSX; do
  export EMULATOR="$qemu -cpu $processor -E LD_PRELOAD=$preload"
  for result in "$@"; do
    echo "$processor, $result"
    # shellcheck disable=SC2086  # words
    $EMULATOR "$program" suite verify "$source/results/suites/$result" --sample 1% --quiet --no-sandbox --jobs 1 \
      --plan-timeout 3600 --trial-timeout 36000
  done
done
