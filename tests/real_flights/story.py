"""story.py PROGRAM SOURCE [MISSIONS]: one whole story. A made reality has wind, an odometry that drifts, another
latency and another mass than its twin. Flights of it are exported as if recorded, with noise; the twin is flown, and
twins with one of the four each. The table of gaps has to find the one that matters most in truth: reality is flown
without one of the four each."""

import json
import sys

import flown
import logs
import numpy as np

GAPS = {
    "wind": "wind.mean_world_mps=[4, 0, 0]",
    "drift": "odometry.position_drift_ratio=0.01",
    "late": "latency.ms=180",
    "mass": "vehicle.mass_kg=0.8",
}
NOISE_M, EVERY = 0.01, 2  # of 100 Hz


def main():
    missions = int(sys.argv[3]) if len(sys.argv) > 3 else 10
    with flown.bench(*sys.argv[1:3]) as bench:
        sweep = {"sweep": "reality", "seed": 24, "maps": bench.place, "trials": missions, "planners": ["reactive"]}
        bench.write("reality.yaml", sweep)
        bench.fly("reality.yaml", "reality", [*GAPS.values(), *flown.SMALLER_GOAL])
        record(bench)
        print(bench.run("import", "wood.yaml", "--db", "wood.db", "--twin", "wood_twin.yaml"))

        bench.fly("wood_twin.yaml", "twin")
        for name, change in GAPS.items():
            bench.fly("wood_twin.yaml", f"twin_{name}", [change])
            # The truth: reality without one of the four.
            bench.fly("wood_twin.yaml", f"without_{name}", [other for other in GAPS.values() if other != change])
        found = gaps(bench, "twin", *(f"twin_{name}" for name in GAPS))
        truth = gaps(bench, *(f"without_{name}" for name in GAPS))
        nearer_m = {name: found["twin"] - found[f"twin_{name}"] for name in GAPS}
        farther_m = {name: truth[f"without_{name}"] for name in GAPS}
        print("nearer to reality by adding it to the twin, m:", nearer_m)
        print("distance from reality by taking it out of reality, m:", farther_m)
        assert max(nearer_m, key=nearer_m.get) == max(farther_m, key=farther_m.get), (nearer_m, farther_m)

        # Both in one report and page.
        bench.run("import", "wood.yaml", "--db", "twin.db", "--beside", "twin")
        report = bench.run("report", "twin.db", "--page", "page.html")
        print(report)
        assert "reactive_real" in report, report


def record(bench):
    """Writes reality's flights as logs, and the file that names them."""
    random = np.random.default_rng(1)
    recordings = []
    paths = bench.paths("reality")
    for mission, row in bench.rows("reality").items():
        poses = paths[mission][::EVERY]
        poses[:, 1:4] += random.normal(0.0, NOISE_M, poses[:, 1:4].shape)
        log = logs.write_log("mcap", bench.folder, f"flight{mission}", poses)
        recordings.append({"log": log.name, "planner": "reactive", "goal": flown.goal_of(row)})
        if row["outcome"] != "reached_goal":
            recordings[-1]["outcome"] = row["outcome"]
    bench.flights("wood", recordings, NOISE_M)


def gaps(bench, *names):
    """The median distance of each simulation from the real flights, m."""
    files = [f"{name}.db" for name in names]
    print(bench.run("compare", "--real", "wood.db", *files))
    rows = json.loads(bench.run("compare", "--real", "wood.db", *files, "--format", "json"))
    return {row["simulation"]: float(row["distance_m"]) for row in rows}


if __name__ == "__main__":
    main()
