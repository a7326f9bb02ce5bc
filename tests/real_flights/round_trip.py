"""round_trip.py PROGRAM SOURCE: simulated flights exported, written as logs in each format and imported again: every
metric within its tolerance of the simulated flight's. The formats agree with each other to the last digits of a clock."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import logs

# Relative, or absolute where the unit is given behind it: what smoothing positions of 100 Hz without noise leaves.
TOLERANCES = {
    "finished": (0, 0),
    "path_optimality_pct": (0, 0.1),
    "energy_optimality": (0.15, 0),
    "energy_optimality_per_m": (0.15, 0),
    "average_goal_velocity_mps": (1e-3, 0),
    "average_goal_velocity_mps_all": (1e-3, 0),
    "mission_progress_pct": (0, 0.1),
    "relative_end_distance_ratio": (0, 0.002),
    "collision_count": (0, 0),
    "path_length_m": (1e-3, 0),
    "flight_time_s": (0, 0.005),
    "mean_speed_mps": (1e-3, 0),
    "max_speed_mps": (0.01, 0),
    "min_clearance_m": (0, 0.01),
    "mean_clearance_m": (0, 0.01),
    "mean_curvature_1pm": (0.05, 0.005),
    "acceleration_effort": (0.03, 0),
    "jerk_effort": (0.35, 0),
    "goals_reached_count": (0, 0),
}
NULL = ["tracking_rmse_m", "rotor_energy_j", "processing_time_ms", "plan_call_count", "no_plan_count"]


def rows_of(run, database):
    lines = run("export", "trials", database, "--format", "jsonl").splitlines()
    return {row["mission_index"]: row for row in map(json.loads, lines)}


def main():
    program, source = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as folder:

        def run(*words):
            done = subprocess.run([program, *map(str, words)], cwd=folder, capture_output=True, text=True, check=False)
            assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
            return done.stdout

        place = {
            "generator": "point_cloud",
            "file": str(source / "maps/thicket.pcd"),
            "bounds": {"lowest_m": [0, 0, 0], "highest_m": [24, 30, 6]},
            "flight_height_m": 2.2,
        }
        sweep = {"sweep": "flown", "seed": 24, "maps": place, "trials": 4, "planners": ["reactive"]}
        Path(folder, "flown.yaml").write_text(json.dumps(sweep))
        run("run", "flown.yaml", "--quiet", "--db", "flown.db")
        flown = rows_of(run, "flown.db")
        trials = [row["trial_id"] for _, row in sorted(flown.items())]
        run("export", "trajectory", "flown.db", *trials, "--format", "tum", "--output", "paths/")
        for kind in logs.WRITERS:
            recordings = []
            for mission, row in sorted(flown.items()):
                poses = logs.read_tum(Path(folder, "paths", row["trial_key"][:12] + ".tum"))
                log = logs.write_log(kind, folder, f"{kind}{mission}", poses)
                goal = [row[f"goal_{axis}_m"] for axis in "xyz"]
                recordings.append({"log": str(log), "planner": "reactive", "goal": goal})
                if row["outcome"] == "collided":
                    recordings[-1]["outcome"] = "collided"
            file = {
                "flights": kind,
                "sweep": {"maps": place, "mission": {"free_radius_m": 0.8}},
                "smoothing": {"position_noise_m": 0.0005, "jerk_mps3": 100},
                "recordings": recordings,
            }
            Path(folder, f"{kind}.yaml").write_text(json.dumps(file))
            run("import", f"{kind}.yaml", "--db", f"{kind}.db")
            check(kind, flown, rows_of(run, f"{kind}.db"))
            # A second time adds nothing.
            run("import", f"{kind}.yaml", "--db", f"{kind}.db")
            assert len(rows_of(run, f"{kind}.db")) == len(flown)


def check(kind, flown, imported):
    assert sorted(flown) == sorted(imported), kind
    for mission, simulated in flown.items():
        real = imported[mission]
        assert real["planner"] == "reactive (real)", real["planner"]
        assert real["outcome"] == simulated["outcome"], (kind, mission, real["outcome"], real["reason"])
        for name, (relative, absolute) in TOLERANCES.items():
            expected, got = simulated[name], real[name]
            if expected is None:
                assert got is None, (kind, mission, name, got)
                continue
            error = abs(got - expected)
            print(f"{kind} {mission} {name}: {expected:.6g} {got:.6g}")
            assert error <= max(absolute, relative * abs(expected)), (kind, mission, name, expected, got)
        for name in NULL:
            assert real[name] is None, (kind, mission, name, real[name])


if __name__ == "__main__":
    main()
