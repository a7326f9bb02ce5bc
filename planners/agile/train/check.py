#!/usr/bin/env python3
"""check.py WEIGHTS JSON: writes what the network says to a made-up image and inputs, for the test of the engine in C++.

The image (64 × 96, row by row) is (37 i + 11) mod 256, the inputs are sin(0.7 i + 0.3) rounded to float32. The outputs
are computed in float64 from the file's half floats."""

from __future__ import annotations

import hashlib
import json
import sys
from pathlib import Path

import numpy
import torch
from network import COLUMNS, INPUTS, ROWS, read_weights


@torch.no_grad()
def vector(weights: Path) -> dict[str, object]:
    network, _ = read_weights(weights)
    image = (torch.arange(ROWS * COLUMNS) * 37 + 11) % 256
    inputs = numpy.sin(0.7 * numpy.arange(INPUTS) + 0.3).astype(numpy.float32)
    output = network.double()(
        image.double().view(1, 1, ROWS, COLUMNS) / 255.0, torch.from_numpy(inputs).double().unsqueeze(0)
    )
    return {
        "weights": weights.name,
        "sha256": hashlib.sha256(weights.read_bytes()).hexdigest(),
        "image": "(i*37+11) % 256",
        "inputs": [float(x) for x in inputs],
        "outputs": output.flatten().tolist(),
    }


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    Path(sys.argv[2]).write_text(json.dumps(vector(Path(sys.argv[1])), indent=1) + "\n")


if __name__ == "__main__":
    main()
