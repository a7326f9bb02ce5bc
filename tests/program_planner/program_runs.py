#!/usr/bin/env python3
"""Sweeps flown by planners that are programs.

    program_runs.py PROGRAM PROGRAMS SOURCES TORTURE [--kills N]

The rows of straight_line are the library's to the last bit where it flies as a program in C and in Python: with one
worker and two, and after SIGKILLs of the run and of its processes; replay and the conformance suite take it. Programs
that break, hang or leave something behind cost their own trials only; a file that a planner depends on and that changes
stops the run. PROGRAMS: the folder of the test programs; TORTURE: the library of tests/sweep/planners/torture.cpp. Exit
code 77: no Python with NumPy here."""

import argparse
import os
import pathlib
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "sweep"))
from same_bits import rows  # noqa: E402

SMALL = """
sweep: programs
maps: {generator: hall, area_m: [10, 14], poisson_radius_m: 3.2, seeds: 2}
trials: 3
sensor: {width_px: 80, height_px: 60}
mission: {time_limit_s: 20}
planners:
"""
HAS_ENDED = "planner_crashed"
HOSTILE = [  # the way, the outcome, a part of the reason; each way's own reason is in hostile_test.cpp
    ("exit", HAS_ENDED, "ended with exit code 3"),
    ("fork_of_its_own_and_exit", HAS_ENDED, "exit code 5"),
    ("exit_in_reset", HAS_ENDED, "reset: the program hostile ended"),
    ("exit_in_create", "planner_error", "exit code 7"),
    ("close_socket", "planner_error", "has closed its socket"),
    ("status", "planner_error", "99, which is no status"),
    ("silent_error", "planner_error", "without saying why"),
    ("spin", "planner_hung", "longer than the plan timeout"),
    ("stop", "planner_hung", "longer than the plan timeout"),
]

# The way: what it may be of a program. It reaches neither the worker's pipes nor its rounding, and overwrites the
# segment's head, which the host writes again. Memory fills slowly on some machines; a thread may crash after the
# trial's end.
TORTURE = {
    "nothing": ["reached_goal"],
    "segfault": [HAS_ENDED],
    "abort": [HAS_ENDED],
    "exit": [HAS_ENDED],
    "throw": ["planner_error"],
    "loop": ["planner_hung"],
    "memory": ["planner_crashed", "planner_hung"],
    "overflow": [HAS_ENDED],
    "close": [HAS_ENDED],
    "print": ["reached_goal"],
    "nan": ["planner_error"],
    "thread": [HAS_ENDED, "reached_goal"],
    "scribble": ["reached_goal"],
    "round": ["reached_goal"],
    "reopen": [HAS_ENDED],
    "terminate": [HAS_ENDED],
}


class Runs:
    def __init__(self, given, folder):
        self.program = given.program
        self.programs, self.sources = pathlib.Path(given.programs).absolute(), pathlib.Path(given.sources).absolute()
        self.torture = pathlib.Path(given.torture).absolute()
        self.folder = pathlib.Path(folder)
        self.problems = 0
        # A mark by which what is left behind is known.
        self.environment = {**os.environ, "AVOIDBENCH_TEST_MARK": str(self.folder)}

    def expect(self, what, is_so, found=""):
        print(f"{'ok' if is_so else 'WRONG'}  {what}{'' if is_so else ': ' + str(found)}", flush=True)
        self.problems += 0 if is_so else 1

    def sweep(self, name, planners, head=SMALL):
        file = self.folder / name
        file.write_text(head + "".join(f"  - {planner}\n" for planner in planners))
        return file

    def start(self, sweep, database, *options):
        command = [self.program, "run", str(sweep), "--quiet", "--db", str(self.folder / database), *options]
        return subprocess.Popen(command, env=self.environment, stderr=subprocess.PIPE, text=True)

    def run(self, sweep, database, *options, code=0):
        process = self.start(sweep, database, *options)
        _, said = process.communicate()
        if process.returncode != code:
            print(said)
            self.expect(f"{sweep} ends with exit code {code}", False, process.returncode)
        return said

    def call(self, *words):
        return subprocess.run(
            [self.program, *map(str, words)], env=self.environment, capture_output=True, text=True, cwd=self.folder
        )

    def left_behind(self):
        """Processes of this test's runs that live on."""
        found = []
        for folder in pathlib.Path("/proc").iterdir():
            if not folder.name.isdigit() or int(folder.name) == os.getpid():
                continue
            try:
                if f"AVOIDBENCH_TEST_MARK={self.folder}".encode() in (folder / "environ").read_bytes().split(b"\0"):
                    found.append((folder / "cmdline").read_bytes().replace(b"\0", b" ").decode())
            except OSError:
                pass
        return found

    def expect_nothing_left(self, when):
        for _ in range(50):
            found = self.left_behind()
            if not found:
                break
            time.sleep(0.1)
        self.expect(f"no process is left {when}", not found, found)


def by_label(found, label):
    """Of one planner: rows without its label."""
    return [row[1:] for row in found["trial"] if row[0] == label]


def doors(runs):
    return [
        f"{{plugin: {runs.programs}/straight_line, label: c}}",
        f"{{plugin: {runs.sources}/python/examples/straight_line.py, label: python}}",
    ]


def same_bits(runs):
    quick = runs.sources / "configs/sweeps/quick.yaml"
    planners = [
        "{plugin: straight_line, label: library}",
        *doors(runs),
        f"{{plugin: process, label: command, parameters: {{command: [{runs.programs}/straight_line]}}}}",
    ]
    head = quick.read_text()
    head = head[: head.index("planners:")] + "planners:\n"
    tail = re.sub(r"(?s)^.*\nvehicle:", "vehicle:", quick.read_text())
    first = None
    for jobs in (1, 2):
        sweep = runs.sweep("quick.yaml", planners, head)
        sweep.write_text(sweep.read_text() + tail)
        runs.run(sweep, f"quick{jobs}.db", "--jobs", str(jobs))
        found = rows(runs.folder / f"quick{jobs}.db")
        library = by_label(found, "library")
        runs.expect(f"the quick sweep has its 8 trials with {jobs} workers", len(library) == 8, len(library))
        for label in ("c", "python", "command"):
            runs.expect(f"{label} with {jobs} workers: the library's rows", by_label(found, label) == library)
        first = first or found
        runs.expect(f"all rows are those of one worker with {jobs}", found == first)
    runs.expect_nothing_left("after sweeps")
    database = runs.folder / "quick1.db"
    verified = runs.call("replay", database, "--verify")
    runs.expect(
        "replay --verify starts no command on a database's word",
        verified.returncode == 2 and "a command that only a database names is not started" in verified.stderr,
        verified.stdout + verified.stderr,
    )
    verified = runs.call("replay", database, "--verify", "--sweep-file", runs.folder / "quick.yaml")
    runs.expect("replay --verify flies all of them again", verified.returncode == 0, verified.stdout + verified.stderr)


def killed(runs, kills):
    """The run, or one of its processes, is killed at a random moment, until it comes to its end."""
    sweep = runs.sweep("killed.yaml", ["{plugin: straight_line, label: library}", *doors(runs)])
    runs.run(sweep, "whole.db", "--jobs", "2")
    whole = rows(runs.folder / "whole.db")
    runs.expect(
        "rows of the small sweep", by_label(whole, "c") == by_label(whole, "python") == by_label(whole, "library")
    )
    draws = random.Random(11)
    for kill in range(kills):
        process = runs.start(sweep, f"killed{kill // 5}.db", "--jobs", "2")
        try:
            process.communicate(timeout=draws.uniform(0.1, 2.5))
            continue
        except subprocess.TimeoutExpired:
            pass
        if kill % 2 == 0:
            process.kill()
            process.communicate()
            runs.expect_nothing_left(f"after kill {kill} of the run")
        else:
            below = descendants(process.pid)
            if below:
                try:
                    os.kill(draws.choice(below), signal.SIGKILL)
                except ProcessLookupError:
                    pass
            process.communicate()
    for part in range((kills + 4) // 5):
        runs.run(sweep, f"killed{part}.db", "--jobs", "2")
        found = rows(runs.folder / f"killed{part}.db")["trial"]
        others = [row[:6] for row in found if row not in whole["trial"]]
        runs.expect(f"rows of run {part} after its kills", found == whole["trial"], (len(found), others))
    runs.expect_nothing_left("after kills")


def descendants(pid):
    parents = {}
    for folder in pathlib.Path("/proc").iterdir():
        try:
            if folder.name.isdigit():
                parents[int(folder.name)] = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
        except (OSError, IndexError):
            pass
    found, waiting = [], [pid]
    while waiting:
        parent = waiting.pop()
        children = [child for child, of in parents.items() if of == parent]
        found += children
        waiting += children
    return sorted(found)


def hostile(runs):
    planners = ["{plugin: straight_line, label: good}"]
    for way, _, _ in HOSTILE:
        planners.append(f"{{plugin: process, label: {way}, parameters: {{command: [{runs.programs}/hostile, {way}]}}}}")
    # It declares points, too.
    head = SMALL.replace("seeds: 2", "seeds: 1").replace("trials: 3", "trials: 2")
    head = head.replace("sensor: {", "sensor: {lidars: [mid360_like], ")
    sweep = runs.sweep("hostile.yaml", planners, head)
    runs.run(sweep, "hostile.db", "--jobs", "2", "--plan-timeout", "2")
    db = sqlite3.connect(runs.folder / "hostile.db")
    found = {}
    for label, outcome, reason in db.execute(
        "SELECT label, outcome, reason FROM trials JOIN planners USING (planner_key)"
    ):
        found.setdefault(label, []).append((outcome, reason))
    for way, outcome, reason in HOSTILE:
        trials = found.get(way, [])
        is_so = len(trials) == 2 and all(one == outcome and reason in why for one, why in trials)
        runs.expect(f"hostile: {way} is {outcome}", is_so, trials)
    alone = runs.sweep("alone.yaml", planners[:1], head)
    runs.run(alone, "alone.db")
    runs.expect(
        "a good planner's rows beside them",
        by_label(rows(runs.folder / "hostile.db"), "good") == by_label(rows(runs.folder / "alone.db"), "good"),
    )
    runs.expect_nothing_left("after hostile programs")


def tortured(runs):
    """The ways of tests/sweep/planners/torture.cpp, of the same source as a library and as a program."""
    head = SMALL.replace("seeds: 2", "seeds: 1").replace("trials: 3", "trials: 2")
    limits = ("--jobs", "2", "--plan-timeout", "2", "--memory-limit", "200")
    wall_s, found = {}, {}
    for door, plugin in (("library", runs.torture), ("program", runs.programs / "torture")):
        planners = ["{plugin: straight_line, label: good}"]
        planners += [f"{{plugin: {plugin}, label: {way}, parameters: {{way: {way}}}}}" for way in TORTURE]
        began = time.monotonic()
        runs.run(runs.sweep("torture.yaml", planners, head), f"torture_{door}.db", *limits)
        wall_s[door] = time.monotonic() - began
        found[door] = rows(runs.folder / f"torture_{door}.db")
        runs.expect_nothing_left(f"after torture by a {door}")
    runs.expect(
        "good planner's rows: the same beside tortured libraries and programs",
        by_label(found["library"], "good") == by_label(found["program"], "good"),
    )
    db = sqlite3.connect(runs.folder / "torture_program.db")
    for way, outcomes in TORTURE.items():
        given = [
            one
            for (one,) in db.execute(
                "SELECT outcome FROM trials JOIN planners USING (planner_key) WHERE label = ?", (way,)
            )
        ]
        is_so = len(given) == 2 and set(given) <= set(outcomes)
        runs.expect(f"torture through the door: {way} is {' or '.join(outcomes)}", is_so, given)
    for way in ("nothing", "print"):
        runs.expect(f"{way}: the library's rows", by_label(found["library"], way) == by_label(found["program"], way))
    print(
        f"    wall time by the program {wall_s['program']:.1f} s, by the library {wall_s['library']:.1f} s: "
        f"ratio {wall_s['program'] / wall_s['library']:.2f}"
    )


PLANNER = """
import avoidbench
from avoidbench.planner import Planner, Velocity
import own_gains


class Mine(Planner):
    name = "mine"
    version = "1"
    summary = "Flies by its gain."
    files = ("weights.txt",)

    def plan(self, observation):
        print("seen at", observation.time_s)
        return Velocity([own_gains.GAIN, 0.0, 0.0])
"""


def files_of_planners(runs):
    own = runs.folder / "own"
    own.mkdir()
    (own / "mine.py").write_text(PLANNER)
    (own / "own_gains.py").write_text("GAIN = 1.0\n")
    (own / "weights.txt").write_text("1\n")
    described = runs.call("planners", "describe", own / "mine.py")
    runs.expect(
        "describe shows the files",
        "own_gains.py" in described.stdout and "weights.txt" in described.stdout,
        described.stdout + described.stderr,
    )
    listed = subprocess.run(
        [runs.program, "planners", "list"],
        capture_output=True,
        text=True,
        env={**runs.environment, "AVOIDBENCH_PLANNER_PATH": str(own)},
    )
    runs.expect(
        "list shows them", "mine" in listed.stdout and "depends on own_gains.py" in listed.stderr, listed.stderr
    )
    sweep = own / "sweep.yaml"
    sweep.write_text(SMALL.replace("trials: 3", "trials: 1").replace("seeds: 2", "seeds: 1") + "  - mine.py\n")

    def keys():
        db = sqlite3.connect(runs.folder / "files.db")
        return [key for (key,) in db.execute("SELECT trial_key FROM trials ORDER BY trial_key")]

    runs.run(sweep, "files.db")
    first = keys()
    latest = first[0]
    runs.run(sweep, "files.db")
    runs.expect("nothing has changed: nothing is flown again", keys() == first and len(first) == 1, keys())
    for name, text in (("weights.txt", "2\n"), ("own_gains.py", "GAIN = 0.5\n")):
        before = keys()
        (own / name).write_text(text)
        runs.run(sweep, "files.db")
        runs.expect(f"another {name} makes other trials", len(keys()) == len(before) + 1, keys())
        (latest,) = set(keys()) - set(before)

    def replay(key):
        return subprocess.run(
            [runs.program, "replay", runs.folder / "files.db", key[:12]],
            capture_output=True,
            text=True,
            cwd=own,
            env=runs.environment,
        )

    replayed = replay(latest)
    runs.expect(
        "replay flies it, and shows what it prints",
        replayed.returncode == 0 and "seen at" in replayed.stdout,
        replayed.stdout + replayed.stderr,
    )
    replayed = replay(first[0])
    runs.expect(
        "replay does not fly a trial of other files",
        replayed.returncode == 2 and "mine.py" in replayed.stderr,
        replayed.stderr,
    )
    # While a sweep flies.
    sweep.write_text(
        SMALL.replace("trials: 3", "trials: 40").replace("time_limit_s: 20", "time_limit_s: 30") + "  - mine.py\n"
    )
    process = runs.start(sweep, "changed.db", "--jobs", "1")
    time.sleep(2.5)
    (own / "weights.txt").write_text("while it is flown\n")
    _, said = process.communicate()
    runs.expect("a file that changes stops the run", process.returncode == 2 and "changed during the run" in said, said)
    runs.expect_nothing_left("after a stop")


def mistakes(runs):
    folder = runs.folder
    (folder / "two.py").write_text(
        "from avoidbench.planner import Planner\nclass A(Planner):\n    name = 'a'\nclass B(Planner):\n    name = 'b'\n"
    )
    (folder / "none.py").write_text("import avoidbench\n")
    (folder / "broken.py").write_text("import avoidbench\n1 +\n")
    (folder / "unnamed.py").write_text("from avoidbench.planner import Planner\nclass A(Planner):\n    name = 'A b'\n")
    for planner, wanted in (
        ("two.py", "defines the planners A, B"),
        ("none.py", "defines no subclass"),
        ("broken.py", "SyntaxError"),
        ("unnamed.py", "expected a text of a-z 0-9 _"),
        ("process", "it needs parameters: {command:"),
        ("{plugin: process, parameters: {command: []}}", "expected a program and its arguments"),
        ("{plugin: process, parameters: {command: [no-such-program]}}", "there is no program 'no-such-program'"),
    ):
        sweep = runs.sweep("mistake.yaml", [planner])
        said = runs.run(sweep, "mistake.db", code=2)
        at = re.search(r"mistake\.yaml:\d+:\d+: ", said)
        runs.expect(f"{planner}: {wanted}", wanted in said and at is not None, said)


def checked(runs):
    planners = [runs.programs / "straight_line", runs.sources / "python/examples/straight_line.py"]
    for kind in ("python", "weights"):  # what users begin from
        runs.expect(f"planners new --kind {kind}", runs.call("planners", "new", kind, "--kind", kind).returncode == 0)
        planners.append(runs.folder / kind / f"{kind}.py")
    for planner in planners:
        found = runs.call("planners", "check", planner)
        runs.expect(f"planners check {planner.name}", found.returncode == 0, found.stdout + found.stderr)
    runs.expect_nothing_left("after checks")


def looked_for_once(runs):
    """The run looks for a Python with NumPy, not each of its workers: one killed meanwhile would leave that behind."""
    log, wrapper = runs.folder / "looks.txt", runs.folder / "python.sh"
    python = os.environ.get("AVOIDBENCH_PYTHON", "python3")
    wrapper.write_text(f'#!/bin/sh\ncase "$*" in *find_spec*) echo look >> {log} ;; esac\nexec {python} "$@"\n')
    wrapper.chmod(0o755)
    runs.environment["AVOIDBENCH_PYTHON"] = str(wrapper)
    sweep = runs.sweep("looks.yaml", [runs.sources / "python/examples/straight_line.py"])
    # Without a sandbox workers can write to the log, too.
    runs.run(sweep, "looks.db", "--jobs", "3", "--no-sandbox")
    del runs.environment["AVOIDBENCH_PYTHON"]
    if "AVOIDBENCH_PYTHON" in os.environ:
        runs.environment["AVOIDBENCH_PYTHON"] = os.environ["AVOIDBENCH_PYTHON"]
    looks = log.read_text().count("look")
    runs.expect("Python is looked for once", looks == 1, looks)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("programs")
    parser.add_argument("sources")
    parser.add_argument("torture")
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--only", default="")
    given = parser.parse_args()
    python = os.environ.get("AVOIDBENCH_PYTHON", "python3")
    if subprocess.run([python, "-c", "import numpy"], capture_output=True).returncode != 0:
        print(f"passed over: {python} has no NumPy")
        sys.exit(77)
    folder = tempfile.mkdtemp()
    try:
        runs = Runs(given, folder)
        parts = {
            "mistakes": mistakes,
            "checked": checked,
            "looks": looked_for_once,
            "same_bits": same_bits,
            "files": files_of_planners,
            "hostile": hostile,
            "tortured": tortured,
            "killed": lambda all_runs: killed(all_runs, given.kills),
        }
        for name, part in parts.items():
            if given.only in ("", name):
                part(runs)
    finally:
        shutil.rmtree(folder)
    sys.exit(1 if runs.problems else 0)


if __name__ == "__main__":
    main()
