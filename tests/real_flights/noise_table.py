"""noise_table.py PROGRAM SOURCE: the table of docs/real_flights.md: what noise of positions and their smoothing do to
path and energy optimality. Simulated flights are exported, noise is added, and they are imported again."""

import sys

import flown
import logs
import numpy as np

NOISES_M = (0.0, 0.01, 0.03, 0.1)
RATES_HZ = (10, 30, 100)


def main():
    with flown.bench(*sys.argv[1:3]) as bench:
        sweep = {"sweep": "flown", "seed": 24, "maps": bench.place, "trials": 12, "planners": ["ego"]}
        bench.write("flown.yaml", sweep)
        bench.fly("flown.yaml", "flown")
        bench.fly("flown.yaml", "longer", flown.SMALLER_GOAL)
        truth = {mission: row for mission, row in bench.rows("flown").items() if row["is_finished"]}
        paths = bench.paths("longer")
        print(
            f"{len(truth)} flights: path optimality {mean(truth, 'path_optimality_pct'):.2f} %, "
            f"energy optimality {mean(truth, 'energy_optimality'):.1f} m/s²"
        )
        print("| noise of a position | poses | path optimality, % | energy optimality |\n|---|---|---|---|")
        random = np.random.default_rng(7)
        for noise_m in NOISES_M:
            for rate_hz in RATES_HZ:
                name = f"n{round(1000 * noise_m)}_{rate_hz}"
                recordings = []
                for mission, row in truth.items():
                    poses = thinned(paths[mission], rate_hz)
                    poses[:, 1:4] += random.normal(0.0, noise_m, poses[:, 1:4].shape)
                    log = logs.write_log("tum", bench.folder, f"f{mission}", poses)
                    recordings.append({"log": log.name, "planner": "ego", "goal": flown.goal_of(row)})
                bench.run("import", bench.flights(name, recordings, max(noise_m, 0.001)), "--db", f"{name}.db")
                real = bench.rows(name)
                cells = [error(truth, real, "path_optimality_pct", 1), error(truth, real, "energy_optimality", 0)]
                print(f"| {100 * noise_m:g} cm | {rate_hz} Hz | {cells[0]} | {cells[1]} |", flush=True)


def thinned(path, rate_hz):
    """The path at this rate, between its samples by proportion."""
    times = np.arange(0.0, path[-1, 0], 1.0 / rate_hz)
    return np.column_stack([times, *(np.interp(times, path[:, 0], path[:, k]) for k in range(1, 8))])


def mean(rows, name):
    return float(np.mean([row[name] for row in rows.values()]))


def error(truth, real, name, is_absolute):
    """The mean and the worst error over flights; relative in percent if not `is_absolute`."""
    errors = []
    for row, found in zip(truth.values(), real.values(), strict=True):
        if found[name] is None:
            continue
        difference = found[name] - row[name]
        errors.append(difference if is_absolute else 100.0 * difference / row[name])
    unit = "" if is_absolute else " %"
    lost = len(truth) - len(errors)
    return f"{np.mean(errors):+.2f}{unit} ({max(errors, key=abs):+.2f}{unit})" + (f", {lost} lost" if lost else "")


if __name__ == "__main__":
    main()
