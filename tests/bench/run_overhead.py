#!/usr/bin/env python3
"""What a sweep costs beside its flights: how much faster two workers are than one, and where the CPU time of all
processes goes.

    tests/bench/run_overhead.py [BUILD FOLDER, build/release] [--rounds 5] [--sweep configs/sweeps/quick.yaml] [--set
    PATH=VALUE …]

Wall times are medians of as many rounds, one and two workers in turn; on a machine that others use they say little, and
the CPU time a trial, which stays the same where nothing is lost, says more. The profile needs perf: samples of the
parent, and those of workers in message passing, JSON, the start of processes and the kernel are overhead; those in the
C library that nobody can be charged with are listed by themselves, and counted as overhead in the upper bound."""

import argparse
import collections
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK_ROOMS = ["base", "geometry", "world", "render", "vehicle", "sensing", "plugin", "trial", "metrics"]
OVERHEAD_ROOMS = ["store", "sweep", "config", "report"]


def fly(program, given, folder, jobs):
    """Wall time and CPU time of one run, and its trials."""
    database = pathlib.Path(folder) / "run.db"
    database.unlink(missing_ok=True)
    command = [program, "run", given.sweep, "--quiet", "--jobs", str(jobs), "--db", database]
    for setting in given.set:
        command += ["--set", setting]
    began = time.monotonic()
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(f"exit code {process.returncode} of {command}")
    return time.monotonic() - began, usage.ru_utime + usage.ru_stime


def symbols_of(build, rooms):
    names = set()
    for room in rooms:
        for library in (build / "lib").glob(f"*/{room}/*.a"):
            said = subprocess.run(["nm", "-C", "--defined-only", library], capture_output=True, text=True).stdout
            for line in said.splitlines():
                if match := re.match(r"[0-9a-f]+ [tTuUwWV] (.*)", line):
                    names.add(match.group(1).split("(")[0].split(" [clone")[0])
    return names


def kind_of(sample, parent, work, overhead):
    pid, dso, symbol = sample
    name = symbol.split("(")[0].split(" [clone")[0]
    if pid == parent:
        return "overhead: the parent"
    if "kernel" in dso:
        return "overhead: kernel, of workers"
    if dso.startswith("ld-"):
        return "overhead: loading of programs"
    if "/planners/" in dso:
        return "planner"
    if dso.startswith(("libembree", "libopencv", "libtbb", "libm.so", "libpng")):
        return "render and sense (libraries)"
    if dso.startswith(("libsqlite3", "libz.so")):
        return "overhead: database"
    if "nlohmann" in symbol or name in overhead - work:
        return "overhead: messages and JSON, of workers"
    if name in work or "Eigen" in symbol or "avoidbench::" in symbol:
        return "render, physics, trial, metrics"
    return "not told apart: C and C++ library"


def profile(program, build, given, folder):
    data = pathlib.Path(folder) / "perf.data"
    command = [
        "perf",
        "record",
        "-q",
        "-F",
        "299",
        "-o",
        data,
        program,
        "run",
        given.sweep,
        "--quiet",
        "--jobs",
        "2",
        "--db",
        pathlib.Path(folder) / "profile.db",
    ]
    for setting in given.set:
        command += ["--set", setting]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    said = subprocess.run(["perf", "script", "-i", data, "-F", "pid,ip,sym,dso"], capture_output=True, text=True).stdout
    work, overhead = symbols_of(build, WORK_ROOMS), symbols_of(build, OVERHEAD_ROOMS)
    counts, parent = collections.Counter(), None
    for line in said.splitlines():
        match = re.match(r"\s*(\d+)\s+[0-9a-f]+ (.*) \((.*)\)$", line)
        if not match:
            continue
        pid, symbol, place = match.groups()
        parent = parent or pid  # the first one to run
        dso = place if "/planners/" in place or "kernel" in place else pathlib.Path(place).name
        counts[kind_of((pid, dso, symbol), parent, work, overhead)] += 1
    total = sum(counts.values())
    print(f"\nshare of CPU time, {total} samples")
    for kind, count in counts.most_common():
        print(f"  {100 * count / total:5.1f} %  {kind}")
    told = sum(count for kind, count in counts.items() if kind.startswith("overhead"))
    unknown = counts["not told apart: C and C++ library"]
    print(f"overhead {100 * told / total:.1f} % of CPU; at most {100 * (told + unknown) / total:.1f} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--sweep", default=ROOT / "configs/sweeps/quick.yaml")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE")
    given = parser.parse_args()
    build = given.build.resolve()
    program = build / "avoidbench"
    with tempfile.TemporaryDirectory() as folder:
        figures = {1: [], 2: []}
        for _ in range(given.rounds):
            for jobs, rounds in figures.items():
                rounds.append(fly(program, given, folder, jobs))
        for jobs, rounds in figures.items():
            wall_s, cpu_s = (statistics.median(column) for column in zip(*rounds))
            print(
                f"{jobs} workers: {wall_s:7.2f} s wall, {cpu_s:7.2f} s CPU, {cpu_s / wall_s:.2f} cores in use",
                flush=True,
            )
        walls = [[wall_s for wall_s, _ in figures[jobs]] for jobs in (1, 2)]
        pairs = [one / two for one, two in zip(*walls)]
        print(
            f"two workers are {statistics.median(pairs):.2f} times as fast (median of {given.rounds}; "
            f"{min(pairs):.2f} to {max(pairs):.2f})"
        )
        cpu = [statistics.median(cpu_s for _, cpu_s in figures[jobs]) for jobs in (1, 2)]
        print(f"two workers take {100 * (cpu[1] / cpu[0] - 1):+.1f} % CPU")
        if shutil.which("perf") is None:
            print("no profile: perf is not installed")
        else:
            profile(program, build, given, folder)


if __name__ == "__main__":
    main()
