#!/usr/bin/env bash
# fuzz.sh [SECONDS [TARGET…]]: builds the fuzz targets (point_cloud, mesh, sweep, log, database, database_edits) with
# address and undefined-behaviour sanitizers (build/fuzz) and runs each for SECONDS (default 60), one after the other.
# Interesting inputs stay in build/fuzz/corpus, failures in build/fuzz/findings.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
shift || true
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(point_cloud mesh sweep log database database_edits)
cmake --preset fuzz -DAVOIDBENCH_UNITY=ON -DAVOIDBENCH_TESTS=ON -DAVOIDBENCH_BENCH=OFF >/dev/null
cmake --build build/fuzz --parallel "${JOBS:-$(nproc)}" --target fuzz_seeds "${targets[@]/%/_fuzz}"
build/fuzz/tests/fuzz/fuzz_seeds build/fuzz/corpus
mkdir -p build/fuzz/findings
for target in "${targets[@]}"; do
  echo "== $target"
  "build/fuzz/tests/fuzz/${target}_fuzz" -max_total_time="$seconds" -max_len=98304 -timeout=20 -rss_limit_mb=4096 \
    -print_final_stats=1 -artifact_prefix="build/fuzz/findings/${target}_" "build/fuzz/corpus/$target"
done
