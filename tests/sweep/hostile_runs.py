#!/usr/bin/env python3
"""Flies planners that attack the program, one way at a time, beside good ones, and looks at what that did.

    hostile_runs.py PROGRAM --planners FOLDER [--good FOLDER] [--ways a,b | --short] [--part I/N] [--parallel N]
    [--run-option=--no-sandbox] [--before WORDS]
                    [--as-user UID] [--keep FOLDER]

FOLDER has the libraries of tests/sweep/hostile. For each way a small sweep is flown by two workers. After it, the good
planners' rows are those of a run without the hostile one, to the bit; its own rows are those of the flight that it
would have had, or say how it failed, whatever it wrote into the pipes; the maps, the tables, the other files are what
they were; no process lives that was started by the run; no file lies about; the database has no log beside it, is sound
and can be locked; and it took no longer than half again the limits that the hostile calls ran into. Ways that would
reach processes outside of the run are passed over where there is no namespace for them."""

import argparse
import concurrent.futures
import contextlib
import ctypes
import fcntl
import hashlib
import json
import os
import pathlib
import pty
import re
import shlex
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import termios
import time

from hostile_ways import ANY, ENDS, EXPECTED, FAILS, HONEST, LIBRARIES, NEED_MOUNTS, NEED_PROCESSES, SHORT, TERMINAL
from same_bits import rows

SWEEP = """
sweep: hostile
maps: {{generator: hall, area_m: [10, 14], poisson_radius_m: 2.6, seeds: [1]}}
trials: {missions}
planners:
  - planners/straight_line.so
{hostile}
  - planners/reactive.so
sensor: {{width_px: 80, height_px: 60}}
mission: {{time_limit_s: 20}}
"""
PLANNER = """  - {{plugin: planners/{library}, label: hostile,
     parameters: {{way: {way}, folder: {folder}, metric_count: {metrics}}}}}"""

PLAN_TIMEOUT_S, TRIAL_TIMEOUT_S, SILENCE_S, MEMORY_MIB = 1.0, 6.0, 21.0, 300
DESCRIBE_TIMEOUT_S = 10.0  # that a planner has to say what it is
PR_SET_CHILD_SUBREAPER = 36
MARKS = ["/tmp", "/var/tmp", "/dev/shm"]  # folders in which ways leave files of this name
MARK = "avoidbench_hostile_"
TYPED = b"typed by the user\n"  # into the run's terminal, where it stays unread
INHERITED = (77, 200)  # descriptors of the file "precious" that the shell has open as it starts the run


# ----------------------------------------------------------------------------------------------------------------------
# In a namespace of its own, as process 1, or at least as the one that orphans come to: runs the program and says what
# it left.


def descendants():
    """Processes that come from this one, however far, and live, with their command lines."""
    parents, found = {}, {}
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rpartition(")")[2].split()
            command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if fields[0] != "Z":
            parents[int(folder.name)] = int(fields[1])
            found[int(folder.name)] = command

    def comes_from_here(pid):
        while pid in parents:
            pid = parents[pid]
            if pid == os.getpid():
                return True
        return False

    return {pid: command for pid, command in found.items() if comes_from_here(pid)}


def wait_for(pid, deadline, look):
    """Its exit code; or None where it did not end in time and was killed. Gathers whatever else ends, and looks at each
    turn."""
    while True:
        look()
        ended, status = os.waitpid(-1, os.WNOHANG)
        if ended == pid:
            return os.waitstatus_to_exitcode(status)
        if ended == 0:
            if time.monotonic() > deadline:
                os.kill(pid, signal.SIGKILL)
                os.waitpid(pid, 0)
                return None
            time.sleep(0.005)


def gather():
    """The zombies."""
    with contextlib.suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0] > 0:
            pass


def shared_objects():
    """How many shared memories, semaphores and queues there are in this namespace."""
    return sum(len(file.read_text().splitlines()) - 1 for file in pathlib.Path("/proc/sysvipc").glob("*"))


def open_terminal(file):
    """A terminal that echoes nothing, whose user has typed a line: both of its ends and its settings. Its name is
    written to the file."""
    control, terminal = pty.openpty()
    settings = termios.tcgetattr(terminal)
    settings[3] &= ~termios.ECHO
    termios.tcsetattr(terminal, termios.TCSANOW, settings)
    os.write(control, TYPED)
    file.write_text(os.ttyname(terminal))
    return control, terminal, termios.tcgetattr(terminal)


def look_at(control, terminal, settings):
    """What became of the terminal: what was shown, whether its settings are others, whether it is stopped, what stands
    to be read."""
    found = {"shown": "", "typed": "", "is_changed": True, "is_stopped": True}
    os.set_blocking(control, False)
    os.set_blocking(terminal, False)
    with contextlib.suppress(OSError, termios.error):
        with contextlib.suppress(BlockingIOError):
            found["shown"] = os.read(control, 1000).decode(errors="replace")
        found["is_changed"] = termios.tcgetattr(terminal) != settings
        with contextlib.suppress(BlockingIOError):
            found["is_stopped"] = os.write(terminal, b".") != 1
        settings[3] &= ~termios.ICANON
        termios.tcsetattr(terminal, termios.TCSANOW, settings)
        with contextlib.suppress(BlockingIOError):
            found["typed"] = os.read(terminal, 1000).decode(errors="replace")
    return found


def inside(file):
    given = json.loads(pathlib.Path(file).read_text())
    folder = pathlib.Path(given["folder"])
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    control, terminal, settings = open_terminal(folder.parent / "terminal")
    began = time.monotonic()
    pid = os.fork()
    if pid == 0:
        os.setsid()
        if given["has_terminal"]:  # else what is left is not hung up when the run ends
            fcntl.ioctl(terminal, termios.TIOCSCTTY, 0)
        for number, name in [(1, "stdout"), (2, "stderr")]:
            os.dup2(os.open(folder.parent / name, os.O_CREAT | os.O_WRONLY | os.O_TRUNC, 0o600), number)
        os.dup2(terminal, 0)
        os.closerange(3, 64)
        for number in INHERITED:
            os.dup2(os.open(folder.parent / "precious", os.O_RDWR), number)
        os.closerange(3, 64)
        os.chdir(folder)
        os.execvpe(given["command"][0], given["command"], given["environment"])
    foreground = set()

    def look():
        with contextlib.suppress(OSError):
            foreground.add(os.tcgetpgrp(control))

    code = wait_for(pid, began + given["deadline_s"], look)
    found = {"code": code, "took_s": time.monotonic() - began}
    time.sleep(0.1)  # what was killed at the end may take a moment to be gone
    gather()
    found["left"] = list(descendants().values())
    for left in descendants():
        os.kill(left, signal.SIGKILL)
    found["shared"] = shared_objects()
    found["terminal"] = look_at(control, terminal, settings)
    found["foreground_is_run"] = foreground <= {0, pid}
    (folder.parent / "found.json").write_text(json.dumps(found))


# ----------------------------------------------------------------------------------------------------------------------


def namespaces():
    """The words before a command that give it processes and mounts of its own: (words, has them)."""
    words = ["unshare", "--pid", "--fork", "--mount-proc", "--kill-child", "--mount", "--ipc"]
    for attempt in [words, [*words[:1], "--user", "--map-root-user", *words[1:]]]:
        with contextlib.suppress(OSError):
            if subprocess.run([*attempt, "true"], capture_output=True).returncode == 0:
                return attempt
    return []


def files_of(folder):
    """Every file below a folder, by name: what is in it; a word for what is no file."""

    def content(path):
        if path.is_symlink() or not path.is_file():
            return "folder" if path.is_dir() else "no file"
        return hashlib.sha256(path.read_bytes()).hexdigest()

    return {str(path.relative_to(folder)): content(path) for path in sorted(folder.rglob("*"))}


class Runs:
    def __init__(self, given, folder):
        self.given, self.folder = given, folder
        self.program = str(pathlib.Path(given.program).resolve())
        self.before = namespaces()
        self.words = list(given.before)
        if given.as_user:
            self.words[:0] = ["setpriv", f"--reuid={given.as_user}", f"--regid={given.as_user}", "--clear-groups"]
            folder.chmod(0o755)
            self.program = str(shutil.copy(self.program, folder))  # its own folder need not be open to that user
        options = subprocess.run([self.program, "run", "--help"], capture_output=True, text=True).stdout
        self.options = [
            "--jobs",
            "2",
            "--quiet",
            "--plan-timeout",
            str(PLAN_TIMEOUT_S),
            "--memory-limit",
            str(MEMORY_MIB),
            *given.run_option,
        ]
        self.trial_limit_s = SILENCE_S
        if "--trial-timeout" in options:
            self.options += ["--trial-timeout", str(TRIAL_TIMEOUT_S)]
            self.trial_limit_s = TRIAL_TIMEOUT_S
        self.locales = folder / "locales"
        self.locales.mkdir()
        with contextlib.suppress(OSError):
            subprocess.run(
                ["localedef", "-f", "UTF-8", "-i", "de_DE", str(self.locales / "de_DE.UTF-8")], capture_output=True
            )
        if not (self.locales / "de_DE.UTF-8").exists():
            print("no locale with a decimal comma can be made here: its ways change nothing")
        self.metrics = 0
        self.honest = self.schema = None
        self.honest_s, self.honest_text = 0.0, ""

    def prepare(self, name, way, library):
        """A folder with the sweep and the planners, and an empty home beside it."""
        folder = self.folder / name / "run"
        (folder / "planners").mkdir(parents=True)
        (folder.parent / "home").mkdir()
        (folder.parent / "temporary").mkdir()
        (folder.parent / "precious").write_text("of the user")
        for planner in ["straight_line", "reactive"]:
            shutil.copy(pathlib.Path(self.given.good) / f"{planner}.so", folder / "planners")
        shutil.copy(pathlib.Path(self.given.planners) / library, folder / "planners")
        hostile = PLANNER.format(library=library, way=way, folder=folder, metrics=self.metrics) if way else ""
        (folder / "sweep.yaml").write_text(SWEEP.format(missions=self.given.missions, hostile=hostile))
        if self.given.as_user:
            for path in [folder, *folder.rglob("*"), folder.parent / "home", folder.parent / "temporary"]:
                os.chown(path, self.given.as_user, self.given.as_user)
        return folder

    def run(self, folder, deadline_s):
        """Runs the sweep of `folder`; what `inside` found, with what the program wrote."""
        home = folder.parent
        environment = {name: value for name, value in os.environ.items() if name in ("PATH", "LANG", "LD_LIBRARY_PATH")}
        environment |= {"HOME": str(home / "home"), "TMPDIR": str(home / "temporary"), "LOCPATH": str(self.locales)}
        # Without copies of planners, which are files that a run leaves.
        command = [*self.words, self.program, "run", "sweep.yaml", "--db", "results.db", "--no-keep", *self.options]
        (home / "given.json").write_text(
            json.dumps(
                {
                    "folder": str(folder),
                    "command": command,
                    "environment": environment,
                    "deadline_s": deadline_s,
                    "has_terminal": re.split("[+]|_again", home.name)[0] in TERMINAL,
                }
            )
        )
        made = subprocess.run(
            [*self.before, sys.executable, __file__, "--inside", str(home / "given.json")],
            capture_output=True,
            text=True,
        )
        if not (home / "found.json").exists():
            return {
                "code": "none: what started it was ended, too",
                "took_s": 0.0,
                "left": [],
                "terminal": {},
                "shared": 0,
                "foreground_is_run": True,
                "stdout": "",
                "stderr": made.stderr,
            }
        found = json.loads((home / "found.json").read_text())
        for name in ("stdout", "stderr"):
            with open(home / name, "rb") as file:
                found[name] = file.read(1 << 20).decode(errors="replace")
        return found

    def measure(self):
        """The flights without anything hostile, and with a hostile planner that does nothing."""
        folder = self.prepare("alone", "", "hostile.so")
        self.run(folder, 120.0)
        alone = rows(folder / "results.db")
        with contextlib.closing(sqlite3.connect(folder / "results.db")) as db:
            self.metrics = db.execute("SELECT count(*) FROM metric_definitions").fetchone()[0]
        folder = self.prepare("nothing", "nothing", "hostile.so")
        found = self.run(folder, 120.0)
        if found["code"] != 0:
            sys.exit(f"the sweep itself does not fly: exit code {found['code']}, {found['stderr']}")
        self.honest, self.honest_s, self.honest_text = rows(folder / "results.db"), found["took_s"], found["stderr"]
        self.schema = schema_of(folder / "results.db")
        if good_of(self.honest) != good_of(alone) or len(good_of(alone)) != 2 * self.given.missions:
            sys.exit("the good planners fly differently beside one that does nothing")

    def fly(self, name):
        """The problems that a way makes, and a line about it. Once more, with limits measured again, where it took too
        long: others may have used this machine, too."""
        problems, line = self.fly_once(name, name)
        if any(problem.startswith("took") for problem in problems):
            calm = self.run(self.prepare(f"{name}_calm", "nothing", "hostile.so"), 120.0)
            self.honest_s = max(self.honest_s, calm["took_s"])
            problems, line = self.fly_once(name, f"{name}_again")
        return problems, line

    def fly_once(self, name, folder_name):
        expected = EXPECTED[name]
        way, _, uses = name.partition("+")
        library = LIBRARIES.get(way, f"hostile_{uses}" if uses else "hostile") + ("" if uses == "program" else ".so")
        folder = self.prepare(folder_name, "nothing" if way in LIBRARIES else way, library)
        before = files_of(folder.parent)
        limit_s = {"call": PLAN_TIMEOUT_S, "trial": self.trial_limit_s, "load": 0.0}[
            expected.limit
        ] * self.given.missions
        limits_s = self.honest_s + limit_s + (DESCRIBE_TIMEOUT_S if expected.limit == "load" else 0.0)
        found = self.run(folder, 1.5 * limits_s + 5.0)
        problems = (
            ["it did not end" if found["code"] is None else f"exit code {found['code']}"]
            if found["code"] not in expected.codes
            else []
        )
        if found["code"] in expected.codes and found["code"] != 0 and not re.search(expected.message, found["stderr"]):
            problems.append("nothing that says what to do")
        if found["took_s"] > 1.5 * limits_s:
            problems.append(f"took {found['took_s']:.1f} s, its limits are {limits_s:.1f} s")
        problems += after_processes(found)
        problems += self.check_files(folder, before)
        problems += self.check_database(folder / "results.db", expected, found["code"])
        outcome = self.outcome(folder / "results.db")
        if not self.given.keep:
            shutil.rmtree(folder.parent, ignore_errors=True)
        last = found["stderr"].strip().splitlines()[-1:] if problems or found["code"] != 0 else []
        return problems, f"{found['took_s']:5.1f} s  {name}: {outcome}" + "".join(
            f"\n      | {line[:200]}" for line in last
        )

    def check_files(self, folder, before):
        made = {"run/results.db", "given.json", "found.json", "stdout", "stderr", "terminal"}
        after = files_of(folder.parent)
        problems = [f"left {name}" for name in after if name not in before and name not in made]
        problems += [f"changed {name}" for name in before if after.get(name) != before[name]]
        for place in MARKS:
            file = pathlib.Path(place) / f"{MARK}{re.split('[+]|_again', folder.parent.name)[0]}"
            if file.exists():
                problems.append(f"left {file}")
                file.unlink()
        return problems

    def check_database(self, file, expected, code):
        if not file.exists():
            return ["no database"] if expected.flies else []
        try:
            with contextlib.closing(sqlite3.connect(file, timeout=0)) as db:
                sound = db.execute("PRAGMA integrity_check").fetchone()[0]
                db.execute("BEGIN EXCLUSIVE")
                db.rollback()
            found = rows(file)
            schema = schema_of(file)
        except sqlite3.Error as error:
            return [f"the database: {error}"]
        problems = [] if sound == "ok" else [f"the database is damaged: {sound}"]
        if schema != self.schema:
            problems.append("the database has other tables")
        good, honest = good_of(found), good_of(self.honest)
        if code == 0 and len(found["trial"]) != 3 * self.given.missions:
            problems.append(f"{len(found['trial'])} rows, {3 * self.given.missions} expected")
        if any(row not in honest for row in good) or (code == 0 and good != honest):
            problems.append("the good planners' rows differ")
        if any(row not in self.honest[kind] for kind in ("map", "mission") for row in found[kind]):
            problems.append("maps or missions differ")
        return problems + [self.judge(row, expected) for row in hostile_of(found) if self.judge(row, expected)]

    def judge(self, row, expected):
        """What is wrong with a row of the hostile planner; nothing where it is an honest flight or says how that
        failed."""
        outcome, reason = row[3], row[4]
        is_honest = row in hostile_of(self.honest)
        failed = outcome in ("planner_error", "planner_crashed", "planner_hung")
        if "forged" in reason or len(reason) > 10000:
            return f"a reason of {len(reason)} characters: {reason[:60]!r}"
        if expected.kind == HONEST and not is_honest:
            return f"mission {row[2]} is not as without the attack: {outcome}, {reason[:100]}"
        if expected.kind == FAILS and not (failed and re.search(expected.message, f"{outcome}: {reason}")):
            return f"mission {row[2]}: {outcome}, {reason[:100]}"
        if expected.kind in (ANY, ENDS) and not (is_honest or failed):
            return f"mission {row[2]} neither honest nor failed: {outcome}, {reason[:100]}"
        return None

    def outcome(self, file):
        with contextlib.suppress(sqlite3.Error, IndexError):
            found = hostile_of(rows(file))
            if all(row in hostile_of(self.honest) for row in found):
                return "honest"
            failures = sorted({f"{row[3]}, {row[4][:90]}" for row in found if row not in hostile_of(self.honest)})
            return "; ".join(failures)
        return "no rows"


def after_processes(found):
    problems = [f"{len(found['left'])} processes left: {found['left'][0][:60]}"] if found["left"] else []
    if found["shared"]:
        problems.append(f"{found['shared']} shared objects left")
    if found["stdout"]:
        problems.append(f"on the standard output: {found['stdout'][:60]!r}")
    if "\033" in found["stderr"]:
        problems.append("control characters on the standard error")
    terminal = found["terminal"]
    if terminal and terminal["typed"] != TYPED.decode():
        problems.append(f"in the terminal stands to be read: {terminal['typed'][:40]!r}")
    if terminal.get("shown"):
        problems.append(f"written to the terminal: {terminal['shown'][:40]!r}")
    problems += [
        f"the terminal {name.replace('_', ' ')}" for name in ("is_changed", "is_stopped") if terminal.get(name)
    ]
    if not found["foreground_is_run"]:
        problems.append("took the terminal")
    return problems


def good_of(found):
    return [row for row in found["trial"] if row[0] != "hostile"]


def hostile_of(found):
    return [row for row in found["trial"] if row[0] == "hostile"]


def schema_of(file):
    with contextlib.closing(sqlite3.connect(file)) as db:
        return db.execute(
            "SELECT type, name, sql FROM sqlite_schema WHERE name NOT LIKE 'sqlite_stat%' ORDER BY 1, 2"
        ).fetchall()


def compare_ways(program, folder):
    """The ways that the library has against those that are expected here: none may be forgotten."""
    environment = os.environ | {"AVOIDBENCH_PLANNER_PATH": str(folder)}
    told = subprocess.run(
        [program, "config", "explain", "hostile.way"], capture_output=True, text=True, env=environment
    ).stdout
    listed = re.search(r"one of nothing, (.*)", told)
    names = set(listed[1].split(", ")) if listed else set()
    missing, unknown = (
        sorted({name for name in EXPECTED if "+" not in name} - set(LIBRARIES) - names),
        sorted(names - set(EXPECTED)),
    )
    if missing or unknown:
        sys.exit(f"not in the library: {missing}; not expected: {unknown}")


def chosen(given, has_namespaces):
    names = given.ways.split(",") if given.ways else SHORT if given.short else list(EXPECTED)
    index, count = (int(part) for part in given.part.split("/"))
    names = names[index - 1 :: count]
    dangerous = [name for name in names if not has_namespaces and name in NEED_PROCESSES + NEED_MOUNTS]
    for name in dangerous:
        print(
            f"passed over: {name} (no namespace can be made here, and it would reach processes or mounts that are "
            f"not ours)"
        )
    return [name for name in names if name not in dangerous]


def arguments(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--planners", required=True, type=pathlib.Path)
    parser.add_argument("--good", type=pathlib.Path, help="the good planners' folder [planners/ beside the program]")
    parser.add_argument("--ways", default="")
    parser.add_argument("--short", action="store_true", help="one or two ways of each kind")
    parser.add_argument("--part", default="1/1", help="I/N: every Nth way, from the Ith on")
    parser.add_argument("--missions", type=int, default=3)
    parser.add_argument("--parallel", type=int, default=1)
    parser.add_argument("--run-option", action="append", default=[])
    parser.add_argument(
        "--before", type=shlex.split, default=[], help="what stands before the program on its command line"
    )
    parser.add_argument("--as-user", type=int, default=0, help="for root: runs as this user")
    parser.add_argument("--keep", type=pathlib.Path, help="where the runs' folders stay")
    given = parser.parse_args(words)
    given.good = given.good or pathlib.Path(given.program).resolve().parent / "planners"
    return given


def main():
    # What a shell starts in the background ignores these, and so would the workers.
    for number in (signal.SIGINT, signal.SIGQUIT):
        signal.signal(number, signal.SIG_DFL)
    given = arguments(sys.argv[1:])
    began = time.monotonic()
    with tempfile.TemporaryDirectory(dir=given.keep) as name:
        runs = Runs(given, pathlib.Path(tempfile.mkdtemp(dir=given.keep)) if given.keep else pathlib.Path(name))
        runs.measure()
        compare_ways(runs.program, runs.folder / "nothing/run/planners")
        names = chosen(given, bool(runs.before))
        broken = 0
        with concurrent.futures.ThreadPoolExecutor(given.parallel) as pool:
            for problems, line in pool.map(runs.fly, names):
                broken += 1 if problems else 0
                print(
                    f"{'BROKEN' if problems else 'ok    '} {line}"
                    + "".join(f"\n      {problem}" for problem in problems),
                    flush=True,
                )
    print(f"{len(names)} ways, {broken} of them break something, {time.monotonic() - began:.0f} s")
    sys.exit(1 if broken or not names else 0)


if __name__ == "__main__":
    inside(sys.argv[2]) if sys.argv[1:2] == ["--inside"] else main()
