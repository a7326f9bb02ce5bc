#!/usr/bin/env bash
# training.sh SOURCE_FOLDER OUT_FOLDER: the training's own tests, and all of train.sh with few samples: its weights must
# fly and know more than at the beginning.
set -euo pipefail
cd "$1"
out=$2
rm -rf "${out:?}"  # or it would go on with what an earlier test made
planners/agile/train/train.sh --few --minutes 2 --out "$out"
(cd planners/agile/train && OMP_WAIT_POLICY=passive "$1/build/train_venv/bin/python" -B -m unittest test_training)
python3 - "$out/first.json" "$out/agile.json" <<'PYTHON'
import json
import sys

for name in sys.argv[1:]:
    costs = [row["validation"]["chosen_cost"] for row in json.load(open(name))["rows"] if "validation" in row]
    print(name, "cost on held-out maps:", " ".join(f"{cost:.2f}" for cost in costs))
    if name == sys.argv[1] and not costs[-1] < 0.6 * costs[0]:
        sys.exit("the first training taught too little")
PYTHON
