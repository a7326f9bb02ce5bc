#!/usr/bin/env python3
"""Runs that are disturbed at random (seeded) moments, again and again, until they end, give the rows of one that was
left alone.

    disturbed_runs.py PROGRAM [--count 300] [--databases 40] [--seed 1] [--long-locks 2] [--only WAY]

Each database is flown by the same command until that has ended well and its share of disturbances is used up: signals
to the run (KILL, TERM, INT, HUP, USR1 and then TERM, STOP and CONT) and to its workers, these also as if their planner
had crashed, a limit of their CPU time, nobody who reads the messages, a full disk, a lock on the database, the database
moved, deleted, replaced. Then its rows are those of the undisturbed run. A run that ends otherwise says what to do,
unless SIGKILL ended it; it never says that all is well while trials are missing from the file that it names; the file
is sound at all times; no process is left."""

import argparse
import contextlib
import itertools
import os
import pathlib
import random
import re
import resource
import signal
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time

from same_bits import rows

SWEEP = """
sweep: disturbed
maps: {generator: hall, area_m: [10, 14], poisson_radius_m: [2.6, 3.2], seeds: 2}
trials: 3
planners: [straight_line, reactive]
sensor: {width_px: 80, height_px: 60}
mission: {time_limit_s: 20}
"""
TRIALS = 24


class Runs:
    def __init__(self, program, folder):
        self.program, self.folder = program, pathlib.Path(folder)
        self.sweep = self.folder / "sweep.yaml"
        self.sweep.write_text(SWEEP)
        self.problems = 0

    def command(self, name, *options):
        return [self.program, "run", str(self.sweep), "--quiet", "--db", str(self.folder / name), *options]

    def run(self, name, *options):
        subprocess.run(self.command(name, *options), check=True, stderr=subprocess.DEVNULL)
        return rows(self.folder / name)

    def fly_undisturbed(self, *options):
        """Flies what the others are compared with; how long it took, in s."""
        began = time.monotonic()
        self.whole = self.run("whole.db", *options)
        took_s = time.monotonic() - began
        if len(self.whole["trial"]) != TRIALS:
            sys.exit(f"{len(self.whole['trial'])} trials undisturbed, expected {TRIALS}")
        print(f"{TRIALS} trials undisturbed in {took_s:.1f} s", flush=True)
        return took_s

    def expect(self, what, found, expected):
        different = [kind for kind in expected if found[kind] != expected[kind]]
        print(f"{'ok' if not different else 'DIFFERENT: ' + ', '.join(different)}  {what}", flush=True)
        self.problems += 1 if different else 0

    def check_file(self, name):
        file = self.folder / name
        if not file.exists() or file.stat().st_size == 0:
            return
        with contextlib.closing(sqlite3.connect(file)) as db:
            answer = db.execute("PRAGMA integrity_check").fetchone()[0]
        if answer != "ok":
            print(f"damaged: {answer}")
            self.problems += 1


MARK = "AVOIDBENCH_DISTURBED_RUN"  # in the environment of a run and of all that it starts
WHAT_TO_DO = re.compile(r"again|free|make room|move it|elsewhere|another|--db|see ", re.IGNORECASE)
# What ends a process that does not catch it; each in its turn.
ENDING = itertools.cycle(
    [
        "SEGV",
        "ABRT",
        "BUS",
        "QUIT",
        "ALRM",
        "XCPU",
        "FPE",
        "ILL",
        "TRAP",
        "SYS",
        "USR2",
        "VTALRM",
        "PROF",
        "XFSZ",
        "IO",
        "PWR",
        "STKFLT",
        "RTMIN",
        "RTMAX",
        "PIPE",
        "HUP",
    ]
)
LONG_LOCK_S = 35.0
DISK_KIB = 65536


def children(pid):
    with contextlib.suppress(OSError):
        return [int(word) for word in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    return []


def marked():
    """Live processes that come from a run of ours; zombies have no environment."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if f"{MARK}={os.getpid()}".encode() in (folder / "environ").read_bytes():
                found.append(int(folder.name))
    return found


def send(pid, number):
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, number)


class Disturbed:
    """One database, its run, and what is done to it."""

    def __init__(self, runs, name, draws, whole_s):
        self.runs, self.name, self.draws, self.whole_s = runs, name, draws, whole_s
        self.file = runs.folder / name
        self.done = []  # what was done, for messages
        self.process = None
        self.undo = []  # to be done when the run has ended
        self.must_fail = False  # the run can't end well any more
        self.is_gone = False  # its file went away, perhaps when the run had nothing left to store
        self.is_mute = False  # nobody reads its messages
        self.locks = []  # threads that hold one

    def problem(self, text):
        print(f"PROBLEM  {self.name}, after {', '.join(self.done) or 'nothing'}: {text}", flush=True)
        self.runs.problems += 1

    def start(self):
        if not self.file.exists() or self.file.stat().st_size == 0:
            # Of a run that was killed after its file was deleted or replaced: refused until somebody moves it away.
            self.file.with_name(self.file.name + "-wal").unlink(missing_ok=True)
        environment = os.environ | {MARK: str(os.getpid())}
        self.must_fail = self.is_gone = self.is_mute = False
        self.process = subprocess.Popen(
            self.runs.command(self.name, "--jobs", "2", "--grace", "2"),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            env=environment,
        )

    def wait(self, seconds):
        """Whether it has ended after that time."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(timeout=seconds)
        return self.process.poll() is not None

    def missing(self):
        """Whether the run has the database open and trials are missing from it."""
        with contextlib.suppress(OSError):
            files = [os.readlink(fd) for fd in pathlib.Path(f"/proc/{self.process.pid}/fd").iterdir()]
            if str(self.file) not in files:
                return False
        return self.stored() < len(self.runs.whole["trial"])

    def stored(self):
        """How many trials the file has."""
        with (
            contextlib.suppress(sqlite3.Error),
            contextlib.closing(sqlite3.connect(f"file:{self.file}?mode=ro", uri=True, timeout=5.0)) as db,
        ):
            return db.execute("SELECT count(*) FROM trials").fetchone()[0]
        return 0

    # What is done to it. Each leaves the run alone after that.

    def kill(self):
        send(self.process.pid, signal.SIGKILL)

    def terminate(self):
        send(self.process.pid, signal.SIGTERM)

    def interrupt(self):
        send(self.process.pid, signal.SIGINT)

    def hang_up(self):
        send(self.process.pid, signal.SIGHUP)

    def close_messages(self):
        self.is_mute = True
        self.process.stderr.close()

    def interrupt_twice(self):
        send(self.process.pid, signal.SIGINT)
        time.sleep(self.draws.uniform(0.0, 0.05))
        send(self.process.pid, signal.SIGINT)

    def warn_and_terminate(self):
        send(self.process.pid, signal.SIGUSR1)
        time.sleep(self.draws.uniform(0.0, 0.1))
        send(self.process.pid, signal.SIGTERM)

    def stop_and_continue(self):
        send(self.process.pid, signal.SIGSTOP)
        time.sleep(self.draws.uniform(0.05, 0.5))
        send(self.process.pid, signal.SIGCONT)

    def to_worker(self, number):
        workers = children(self.process.pid)
        if workers:
            send(self.draws.choice(workers), number)

    def kill_worker(self):
        self.to_worker(signal.SIGKILL)

    def kill_workers_often(self):
        for _ in range(6):
            self.to_worker(signal.SIGKILL)
            time.sleep(0.02)

    def terminate_worker(self):
        self.to_worker(signal.SIGTERM)

    def interrupt_worker(self):
        self.to_worker(signal.SIGINT)

    def signal_worker(self):
        """While flights end, as most workers measure maps before."""
        name = next(ENDING)
        self.done[-1] += " " + name
        before, limit = self.stored(), time.monotonic() + 10.0
        while self.stored() == before and self.process.poll() is None and time.monotonic() < limit:
            time.sleep(0.02)
        time.sleep(self.draws.uniform(0.0, 0.2))
        self.to_worker(getattr(signal, "SIG" + name))

    def limit_cpu_of_workers(self):
        for pid in children(self.process.pid):
            with contextlib.suppress(OSError):
                resource.prlimit(pid, resource.RLIMIT_CPU, (1, resource.RLIM_INFINITY))

    def stop_worker(self):
        workers = children(self.process.pid)
        for pid in workers:
            send(pid, signal.SIGSTOP)
        time.sleep(self.draws.uniform(0.05, 1.0))
        for pid in workers:
            send(pid, signal.SIGCONT)

    def fill_disk(self):
        """Few pages are left of the disk: where one of its own can be mounted for it, else by a limit of files."""
        pages = self.draws.randrange(8)
        if not os.path.ismount(self.file.parent):
            with contextlib.suppress(OSError, ProcessLookupError):
                size = self.file.stat().st_size + 4096 * pages
                resource.prlimit(self.process.pid, resource.RLIMIT_FSIZE, (size, size))
            return
        filler = self.file.parent / "filler"
        with contextlib.suppress(OSError), open(filler, "wb", buffering=0) as file:
            while True:
                file.write(bytes(4096))
        os.truncate(filler, max(0, filler.stat().st_size - 4096 * pages))
        self.undo.append(lambda: filler.unlink(missing_ok=True))

    def lock(self, seconds=None):
        seconds = seconds or self.draws.uniform(0.1, 2.0)
        kind = self.draws.choice(["BEGIN EXCLUSIVE", "BEGIN IMMEDIATE"])
        taken = threading.Event()

        def hold():
            with (
                contextlib.suppress(sqlite3.Error),
                contextlib.closing(sqlite3.connect(self.file, timeout=5.0, isolation_level=None)) as db,
            ):
                db.execute(kind)
                taken.set()
                time.sleep(seconds)
                db.rollback()
            taken.set()

        if self.file.exists() and self.file.stat().st_size > 0:
            self.locks.append(threading.Thread(target=hold))
            self.locks[-1].start()
            taken.wait()

    def lock_for_long(self):
        self.lock(LONG_LOCK_S)

    def move(self):
        if not self.file.exists():
            return
        elsewhere = self.file.with_suffix(".moved")
        self.must_fail = self.missing()
        self.file.rename(elsewhere)

        def move_back():
            if not self.file.exists():
                elsewhere.rename(self.file)

        self.undo.append(move_back)

    def delete(self):
        if self.file.exists():
            self.must_fail, self.is_gone = self.missing(), True
            self.file.unlink(missing_ok=True)

    def replace(self):
        if self.file.exists():
            self.must_fail, self.is_gone = self.missing(), True
            new = self.file.with_suffix(".new")
            new.write_bytes(b"")
            new.rename(self.file)

    KINDS = (
        kill,
        terminate,
        interrupt,
        hang_up,
        close_messages,
        interrupt_twice,
        warn_and_terminate,
        stop_and_continue,
        kill_worker,
        kill_workers_often,
        terminate_worker,
        interrupt_worker,
        signal_worker,
        signal_worker,
        limit_cpu_of_workers,
        stop_worker,
        fill_disk,
        lock,
        move,
        delete,
        replace,
    )

    def disturb(self, kind):
        """Does it, unless the run has ended; whether it did."""
        if self.process.poll() is not None:
            return False
        self.done.append(kind.__name__)
        kind(self)
        return True

    def end(self, limit_s):
        """Waits for the run's end and judges how it ended; whether it ended well."""
        if self.is_mute:
            self.process.stderr = None  # communicate() would read from the closed one
        try:
            _, text = self.process.communicate(timeout=limit_s)
        except subprocess.TimeoutExpired:
            self.process.kill()
            _, text = self.process.communicate()
            self.problem(f"the run did not end within {limit_s:.0f} s: {(text or '')[-300:]!r}")
        text = text or ""
        for thread in self.locks:
            thread.join()
        self.locks = []
        code = self.process.returncode
        if code == 0 and self.must_fail:
            self.problem("exit code 0, but trials were missing when its file went away")
        if code in (-signal.SIGINT, -signal.SIGTERM, -signal.SIGHUP, -signal.SIGUSR1) and text == "":
            code = -signal.SIGKILL  # before it could say anything
        if code not in (
            0,
            1,
            2,
            75,
            130,
            -signal.SIGKILL,
            128 + signal.SIGINT,
            128 + signal.SIGTERM,
            128 + signal.SIGUSR1,
        ):
            self.problem(f"exit code {code}: {text[-300:]}")
        elif code not in (0, -signal.SIGKILL) and not self.is_mute and not WHAT_TO_DO.search(text):
            self.problem(f"exit code {code} and nothing about what to do: {text[-300:]!r}")
        if code == 2 and "locked" in text and "lock" in " ".join(self.done):
            self.problem(f"did not wait for the lock: {text[-200:]!r}")
        # A worker that was just starting ends when it finds nobody at its pipe.
        left, limit = marked(), time.monotonic() + 5.0
        while left and time.monotonic() < limit:
            time.sleep(0.05)
            left = marked()
        if left:
            self.problem(f"{len(left)} processes left")
            for pid in left:
                send(pid, signal.SIGKILL)
        for undo in self.undo:
            undo()
        self.undo = []
        self.runs.check_file(self.name)
        return code == 0 and not self.is_gone


def fly(runs, name, draws, whole_s, kinds):
    """One database, disturbed in these ways one after the other, then left alone until it is whole; how many were
    used."""
    one = Disturbed(runs, name, draws, whole_s)
    kinds, used = list(kinds), 0
    ended_well = False
    while kinds and not ended_well:
        one.start()
        while kinds and not one.wait(draws.uniform(0.05, min(0.3 * whole_s, 2.0))):
            used += 1 if one.disturb(kinds.pop()) else 0
        ended_well = one.end(LONG_LOCK_S + 60.0 + 5.0 * whole_s)
    for _ in range(4):
        if ended_well:
            break
        one.done.append("left alone")
        one.start()
        ended_well = one.end(120.0)
    if not ended_well:
        one.problem("does not end well, even left alone")
        return used
    runs.expect(f"{name}: {', '.join(one.done)}", rows(runs.folder / name), runs.whole)
    return used


@contextlib.contextmanager
def small_disk(folder):
    """A folder on a small disk of its own, where one can be mounted."""
    folder.mkdir()
    mounted = (
        subprocess.run(
            ["mount", "-t", "tmpfs", "-o", f"size={DISK_KIB}k", "tmpfs", folder], capture_output=True
        ).returncode
        == 0
    )
    try:
        yield
    finally:
        if mounted:
            subprocess.run(["umount", "--lazy", folder], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--databases", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--long-locks", type=int, default=2)
    parser.add_argument("--only", choices=[kind.__name__ for kind in Disturbed.KINDS])
    given = parser.parse_args()
    draws = random.Random(given.seed)
    with tempfile.TemporaryDirectory() as folder, small_disk(pathlib.Path(folder) / "disk"):
        runs = Runs(given.program, folder)
        began = time.monotonic()
        whole_s = runs.fly_undisturbed("--jobs", "2")
        done = database = 0
        while done < given.count or database < given.databases:
            allowed = [kind for kind in Disturbed.KINDS if given.only in (None, kind.__name__)]
            kinds = draws.choices(allowed, k=max(1, round(given.count / given.databases)))
            if database < given.long_locks:
                kinds = [Disturbed.lock_for_long]
            name = f"disturbed{database}.db"
            done += fly(runs, f"disk/{name}" if database % 2 == 0 else name, draws, whole_s, kinds)
            database += 1
    print(f"{done} disturbances of {database} databases, {runs.problems} problems, {time.monotonic() - began:.0f} s")
    sys.exit(1 if runs.problems else 0)


if __name__ == "__main__":
    main()
