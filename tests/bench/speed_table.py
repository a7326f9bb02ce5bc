#!/usr/bin/env python3
"""Writes docs/speed.md: the time of images, trials, maps and the database on this machine, each with a reference
measured in the same run.

    tests/bench/speed_table.py [BUILD FOLDER, build/release] [--rounds 5] [--out docs/speed.md]

Builds the benchmarks it needs, runs them in turns on one core as many rounds, and takes medians. Nothing else should
run on the machine (some twenty minutes)."""

import argparse
import collections
import datetime
import heapq
import itertools
import json
import os
import pathlib
import platform
import re
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BENCHES = {
    "render_bench": "^depth/",
    "camera_bench": ".",
    # Without whole flights by sensors of which one exposure takes a tenth of a second: camera_bench has those.
    "trial_bench": "^(whole_trial|measure_map)|^sensor/(depth|stereo_sg|d435|surround)",
}
SWEEP = """
sweep: rows
maps: {{generator: forest, area_m: [40, 40], poisson_radius_m: 3.5, seeds: {{from: 1, to: 25, count: 25}}}}
trials: 20
planners: [{build}/planners/reactive.so]
sensor: {{width_px: 64, height_px: 48}}
"""


def measure(build, rounds):
    """Median of each counter, and of the time in ms, by benchmark: {"depth/hall/320": {"ratio": …}}."""
    seen = collections.defaultdict(lambda: collections.defaultdict(list))
    core = str(max(os.sched_getaffinity(0)))
    for count in range(rounds):
        print(f"round {count + 1} of {rounds}", flush=True)
        for name, pattern in BENCHES.items():
            said = subprocess.run(
                [
                    "taskset",
                    "-c",
                    core,
                    build / "bench" / name,
                    f"--benchmark_filter={pattern}",
                    "--benchmark_format=json",
                    "--benchmark_min_time=0.2",
                ],
                check=True,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
            ).stdout
            for run in json.loads(said)["benchmarks"]:
                key = re.sub(r"/(iterations:\d+|manual_time)", "", run["name"])
                run["time_ms"] = run["real_time"] * {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}[run["time_unit"]]
                for field, value in run.items():
                    if isinstance(value, (int, float)):
                        seen[key][field].append(value)
    return {key: {field: statistics.median(values) for field, values in fields.items()} for key, fields in seen.items()}


def written_rows(build, rounds):
    """CPU time in which the one writer stores a flight with its trajectory, ms."""
    with tempfile.TemporaryDirectory() as folder:
        sweep = pathlib.Path(folder) / "rows.yaml"
        sweep.write_text(SWEEP.format(build=build))
        times_ms = []
        for count in range(rounds):
            said = subprocess.run(
                [build / "bench/large_sweep", sweep, pathlib.Path(folder) / f"{count}.db"],
                check=True,
                capture_output=True,
                text=True,
            ).stdout
            times_ms.append(float(re.search(r"([\d.]+) ms CPU to write one", said).group(1)))
    return statistics.median(times_ms)


def speed_up(workers, flights_s, write_s):
    """Of `workers` cores whose flights one process writes, over one core that flies and writes, by playing a sweep
    through. A worker gets its next flight when the writer has taken its last."""
    todo = iter(flights_s)
    landings = list(itertools.islice(todo, workers))  # when each flight in the air ends
    heapq.heapify(landings)
    writer_s = 0.0
    while landings:
        landed_s = heapq.heappop(landings)
        writer_s = max(writer_s, landed_s) + write_s
        flight_s = next(todo, None)
        if flight_s is not None:
            heapq.heappush(landings, writer_s + flight_s)
    return sum(flight_s + write_s for flight_s in flights_s) / writer_s


def spread_flights(mean_s, count=20000):
    """Flights between half and one and a half times as long as the mean, in an order that repeats."""
    return [mean_s * (0.5 + (i * 0.6180339887498949) % 1.0) for i in range(count)]


def table(head, rows):
    return "\n".join(
        ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(row) + " |" for row in rows]
    )


def depth_rows(figures):
    for place in ("hall", "forest"):
        for width in (640, 320, 64):
            f = figures[f"depth/{place}/{width}"]
            yield [
                place,
                f"{width} × {width * 3 // 4}",
                f"{f['ms']:.2f}",
                f"{f['Mray_per_s']:.1f}",
                f"{f['ratio']:.3f}",
            ]


def camera_rows(figures):
    names = dict.fromkeys(key.split("/")[0] for key in figures if "ratio_to_true_depth" in figures[key])
    for name in names:
        yield [f"`{name}`"] + [
            cell
            for place in ("hall", "forest")
            for cell in (
                f"{figures[f'{name}/{place}']['time_ms']:.2f}",
                f"{figures[f'{name}/{place}']['ratio_to_true_depth']:.2f}",
            )
        ]


def trial_rows(figures):
    for place in ("hall", "forest"):
        for suffix, size in (("", "320 × 240"), ("_64x48", "64 × 48")):
            f = figures[f"whole_trial/{place}{suffix}"]
            yield (
                [place, size, f"{f['real_time_factor']:.1f}"]
                + [f"{100 * f[share]:.1f}" for share in ("bare_ratio", "render_ratio", "planner_ratio", "rest_ratio")]
                + [f"{f['rest_ms_per_image']:.3f}"]
            )


def sensor_rows(figures):
    names = dict.fromkeys(key.split("/")[1] for key in figures if key.startswith("sensor/"))
    for name in names:
        hall, forest = (figures[f"sensor/{name}/{place}"] for place in ("hall", "forest"))
        yield [
            f"`{name}`",
            f"{hall['real_time_factor']:.2f}",
            f"{hall['in_bare_loops']:.1f}",
            f"{forest['real_time_factor']:.2f}",
            f"{forest['in_bare_loops']:.1f}",
        ]


def map_rows(figures):
    for what, key in (
        ("forest 40 × 40 m, environment metrics", "forest_without_missions"),
        ("the same with 10 missions and their reference paths", "forest_with_10_missions"),
        ("hall with 10 missions", "hall_with_10_missions"),
    ):
        time_ms = figures[f"measure_map/{key}"]["time_ms"]
        yield [what, f"{time_ms:.0f}", f"{time_ms / figures['depth/forest/320']['ms']:.0f}"]


def scaling_rows(write_s):
    for workers in (1, 2, 4, 16, 64):
        cells = [speed_up(workers, spread_flights(mean_s), write_s) / workers for mean_s in (0.1, 1.0, 8.0)]
        yield [str(workers)] + [f"{100 * cell:.1f} %" for cell in cells]


def page(figures, write_ms, rounds):
    cpu = next(
        (line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")),
        platform.machine(),
    )
    write_s = 1e-3 * write_ms
    text = (pathlib.Path(__file__).parent / "speed_page.md.in").read_text()
    return text.format(
        date=datetime.date.today().isoformat(),
        cpu=cpu,
        rounds="one round" if rounds == 1 else f"medians of {rounds} rounds",
        depth=table(["map", "pixels", "ms", "million rays/s", "ratio to the bare loop"], depth_rows(figures)),
        camera=table(["sensor", "hall: ms", "× true depth", "forest: ms", "× true depth"], camera_rows(figures)),
        trial=table(
            ["map", "pixels", "× real time", "bare loop %", "images %", "planner %", "rest %", "rest, ms per image"],
            trial_rows(figures),
        ),
        sensor=table(
            ["sensor", "hall: × real time", "in bare loops", "forest: × real time", "in bare loops"],
            sensor_rows(figures),
        ),
        maps=table(["what", "ms", "in forest images"], map_rows(figures)),
        write_ms=f"{write_ms:.2f}",
        rows_per_s=f"{1.0 / write_s:.0f}",
        scaling=table(["workers", "flights of 0.1 s", "1 s", "8 s"], scaling_rows(write_s)),
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--out", default=ROOT / "docs/speed.md", type=pathlib.Path)
    given = parser.parse_args()
    build = given.build.resolve()
    subprocess.run(["cmake", "-S", ROOT, "-B", build, "-DAVOIDBENCH_BENCH=ON"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", build, "--target", *BENCHES, "large_sweep"], check=True)
    given.out.write_text(page(measure(build, given.rounds), written_rows(build, given.rounds), given.rounds))
    print(f"written: {given.out}")


if __name__ == "__main__":
    main()
