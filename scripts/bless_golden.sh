#!/usr/bin/env bash
# bless_golden.sh "REASON": after an intended change of results, rewrites results/baselines/ci*.csv and adds REASON to
# CHANGELOG.md under "Results change". It first shows what changes; if nothing does, nothing is written.
# AVOIDBENCH: the program to fly with (default: build/release/avoidbench).
set -euo pipefail
cd "$(dirname "$0")/.."

reason=${1:-}
if [ $# -ne 1 ] || [ -z "${reason//[[:space:]]/}" ]; then
  echo "usage: $0 \"REASON\": why results change, one line for CHANGELOG.md" >&2
  exit 2
fi
program=${AVOIDBENCH:-build/release/avoidbench}
command -v "$program" >/dev/null || { echo "$program does not exist: build it first" >&2; exit 2; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p results/baselines
changed=0
for sweep in configs/sweeps/ci*.yaml; do
  name=$(basename "$sweep" .yaml)
  table=results/baselines/$name.csv
  "$program" run "$sweep" --db "$folder/$name.db" --quiet
  if [ -f "$table" ] && "$program" compare "$table" "$folder/$name.db" --exact; then continue; fi
  "$program" compare "$folder/$name.db" --bless "$folder/$name.csv"
  changed=1
done
if [ $changed = 0 ]; then
  echo "no changes: nothing written" >&2
  exit 0
fi
python3 - "$reason" <<'PYTHON'
import pathlib
import sys

reason = " ".join(sys.argv[1].split())
path = pathlib.Path("CHANGELOG.md")
lines = path.read_text().splitlines()
start = next((i for i, line in enumerate(lines) if line.startswith("## ")), None)
if start is None:
    sys.exit("CHANGELOG.md has no release heading (## ...)")
end = next((i for i in range(start + 1, len(lines)) if lines[i].startswith("## ")), len(lines))
heading = next((i for i in range(start, end) if lines[i] == "### Results change"), None)
if heading is None:
    heading = next((i for i in range(start, end) if lines[i] == "### Migration"), end)
    lines[heading:heading] = ["### Results change", ""]
lines.insert(heading + 1, f"- {reason}")
path.write_text("\n".join(lines) + "\n")
PYTHON
cp "$folder"/*.csv results/baselines/
echo "wrote results/baselines and a line in CHANGELOG.md under Results change" >&2
