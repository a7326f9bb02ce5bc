"""make_example.py PROGRAM SOURCE: writes configs/flights/thicket/*.tum: four flights of a made reality (story.py), as
if a lidar odometry had logged them at 20 Hz with an error of 1 cm, in a frame of its own."""

import sys
from pathlib import Path

import flown
import numpy as np
import story

RATE_HZ = 20.0
ORIGIN_M, YAW_DEG = np.array([12.0, 1.5, 0.4]), 90.0  # of the log's frame in the map's


def main():
    folder = Path(sys.argv[2]) / "configs/flights/thicket"
    folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(1)
    with flown.bench(*sys.argv[1:3]) as bench:
        sweep = {"sweep": "reality", "seed": 24, "maps": bench.place, "trials": 4, "planners": ["reactive"]}
        bench.write("reality.yaml", sweep)
        bench.fly("reality.yaml", "reality", [*story.GAPS.values(), *flown.SMALLER_GOAL])
        rows = bench.rows("reality")
        for mission, path in bench.paths("reality").items():
            poses = path[:: round(100.0 / RATE_HZ)].copy()
            poses[:, 1:4] += random.normal(0.0, story.NOISE_M, poses[:, 1:4].shape)
            write(folder / f"flight{mission + 1}.tum", to_log(poses), mission)
            print(mission, flown.goal_of(rows[mission]), rows[mission]["outcome"])


def to_log(poses):
    """From the map's frame to the log's."""
    yaw = np.deg2rad(YAW_DEG)
    x_axis, y_axis = np.array([np.cos(yaw), np.sin(yaw), 0.0]), np.array([-np.sin(yaw), np.cos(yaw), 0.0])
    moved = poses.copy()
    offset = poses[:, 1:4] - ORIGIN_M
    moved[:, 1], moved[:, 2], moved[:, 3] = offset @ x_axis, offset @ y_axis, offset[:, 2]
    w, z = np.cos(0.5 * yaw), -np.sin(0.5 * yaw)
    qx, qy, qz, qw = poses[:, 4:8].T
    moved[:, 4:8] = np.column_stack([w * qx - z * qy, w * qy + z * qx, w * qz + z * qw, w * qw - z * qz])
    return moved


def write(path, poses, mission):
    with open(path, "w", encoding="ascii") as file:
        file.write("# A made log: a simulated flight with noise, by tests/real_flights/make_example.py\n")
        file.write("# timestamp tx ty tz qx qy qz qw\n")
        start_s = 1_700_000_000 + 60 * mission
        for t, *rest in poses:
            file.write(f"{start_s + t:.3f} " + " ".join(f"{value:.4f}" for value in rest) + "\n")


if __name__ == "__main__":
    main()
