"""The same sweep, seed and actions give the same bits, for any number of threads and in another process."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import Any

from flights import SMALL, changed, digest_of_random_flights

SWEEP: dict[str, Any] = changed(
    SMALL, maps={"seeds": [1, 2, 3, 4]}, mission={"time_limit_s": 10}, sensor={"width_px": 8, "height_px": 8}
)
OPTIONS: dict[str, Any] = {"observe": ["depth", "state", "goal", "pose", "imu"]}
SCRIPT = """
import json, sys
from flights import digest_of_random_flights
sweep, slots, steps, options = json.loads(sys.argv[1])
print(digest_of_random_flights(sweep, slots, 2, steps, **options))
"""


def test_random_flights_have_the_same_bits(is_long: bool) -> None:
    slots, steps = (64, 3000) if is_long else (16, 150)
    other = subprocess.Popen(
        [sys.executable, "-c", SCRIPT, json.dumps([SWEEP, slots, steps, OPTIONS])],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    one = digest_of_random_flights(SWEEP, slots, 1, steps, **OPTIONS)
    two = digest_of_random_flights(SWEEP, slots, 2, steps, **OPTIONS)
    output, _ = other.communicate()
    assert one == two == output.strip() and len(one) == 64


def test_the_digest_sees_other_flights() -> None:
    digests = {
        digest_of_random_flights(changed(SWEEP, **change), 4, 2, 20, **OPTIONS)
        for change in ({}, {"seed": 7}, {"sensor": {"fov_x_deg": 91}}, {"imu": {"rate_hz": 100}})
    }
    assert len(digests) == 4


def test_with_noise_and_wind_too() -> None:
    sweep = changed(
        SWEEP, sensor={"preset": "depth_noisy", "width_px": 32, "height_px": 24}, wind={"mean_world_mps": [2, 1, 0]}
    )
    assert (
        len({digest_of_random_flights(sweep, 6, threads, 60, autoreset_mode="SameStep") for threads in (1, 2, 5)}) == 1
    )
