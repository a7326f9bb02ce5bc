"""round_trip.py PROGRAM SOURCE: simulated flights exported, written as logs in each format and imported again: every
metric within its tolerance of the simulated flight's."""

import sys

import flown
import logs

# Relative and absolute: what smoothing positions of 100 Hz without noise leaves.
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


def main():
    with flown.bench(*sys.argv[1:3]) as bench:
        sweep = {"sweep": "flown", "seed": 24, "maps": bench.place, "trials": 4, "planners": ["reactive"]}
        bench.write("flown.yaml", sweep)
        bench.fly("flown.yaml", "flown")
        simulated, paths = bench.rows("flown"), bench.paths("flown")
        for kind in logs.WRITERS:
            recordings = []
            for mission, row in simulated.items():
                log = logs.write_log(kind, bench.folder, f"{kind}{mission}", paths[mission])
                recordings.append({"log": log.name, "planner": "reactive", "goal": flown.goal_of(row)})
                if row["outcome"] == "collided":
                    recordings[-1]["outcome"] = "collided"
            file = bench.flights(kind, recordings, 0.0005, jerk_mps3=100)
            bench.run("import", file, "--db", f"{kind}.db")
            check(kind, simulated, bench.rows(kind))
            # A second time adds nothing.
            bench.run("import", file, "--db", f"{kind}.db")
            assert len(bench.rows(kind)) == len(simulated)


def check(kind, simulated, imported):
    assert sorted(simulated) == sorted(imported), kind
    for mission, row in simulated.items():
        real = imported[mission]
        assert real["planner"] == "reactive_real", real["planner"]
        assert real["outcome"] == row["outcome"], (kind, mission, real["outcome"], real["reason"])
        for name, (relative, absolute) in TOLERANCES.items():
            expected, got = row[name], real[name]
            if expected is None:
                assert got is None, (kind, mission, name, got)
                continue
            print(f"{kind} {mission} {name}: expected {expected:.6g}, got {got:.6g}")
            assert abs(got - expected) <= max(absolute, relative * abs(expected)), (kind, mission, name, expected, got)
        for name in NULL:
            assert real[name] is None, (kind, mission, name, real[name])


if __name__ == "__main__":
    main()
