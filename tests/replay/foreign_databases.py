#!/usr/bin/env python3
"""Databases of strangers: nothing that they name runs outside of a worker's sandbox, and no command of theirs runs at
all.

    foreign_databases.py PROGRAM LEAVES_MARK STRAIGHT_LINE

LEAVES_MARK: the library of planners/leaves_mark.cpp, which writes a file where it is let; STRAIGHT_LINE: a planner that
is a program. Each command that flies stored trials is tried with a database whose planner is a command, and with one of
a library that was flown without a sandbox. Also: a planner of the user's own is flown, whatever the database says of
how its planner was started; and no command leaves SQLite's files beside a database."""

import os
import pathlib
import re
import sqlite3
import subprocess
import sys
import tempfile

SWEEP = """
sweep: foreign
maps: {generator: hall, area_m: [10, 14], poisson_radius_m: 2.5}
trials: 2
sensor: {width_px: 80, height_px: 60}
mission: {time_limit_s: 5}
planners: [PLANNER]
"""
REFUSAL = "a command that only a database names is not started"


class Folder:
    def __init__(self, program, folder):
        self.program, self.folder = program, pathlib.Path(folder)
        self.mark = self.folder / "mark"
        self.environment = {**os.environ, "AVOIDBENCH_TEST_MARK": str(self.mark)}
        self.problems = 0

    def expect(self, what, is_so, found=""):
        print(f"{'ok' if is_so else 'WRONG'}  {what}{'' if is_so else ': ' + str(found)}", flush=True)
        self.problems += 0 if is_so else 1

    def call(self, *words):
        done = subprocess.run(
            [self.program, *map(str, words)],
            env=self.environment,
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=300,
        )
        left = [path.name for path in self.folder.rglob("*") if path.name.endswith(("-wal", "-shm", "-journal"))]
        self.expect(f"{' '.join(map(str, words[:4]))} leaves no file beside a database", not left, left)
        return done

    def flown(self, name, planner, *options):
        """A database of two trials, at least one of them a collision."""
        sweep = self.folder / f"{name}.yaml"
        sweep.write_text(SWEEP.replace("PLANNER", planner))
        database = self.folder / f"{name}.db"
        done = self.call("run", sweep, "--db", database, "--quiet", "--jobs", "1", *options)
        if done.returncode != 0:
            sys.exit(f"{name} is not flown: {done.stderr}")
        with sqlite3.connect(database) as file:
            outcomes = [outcome for (outcome,) in file.execute("SELECT outcome FROM trials ORDER BY rowid")]
        self.expect(f"{name} is flown, and something struck", "collided" in outcomes, outcomes)
        return database, outcomes.index("collided") + 1


def commands(database, trial):
    """All that fly stored trials, and what they end with where they may not."""
    return {
        "replay": (["replay", database, trial], 2),
        "replay --png": (["replay", database, trial, "--png", "r.png"], 2),
        "replay --page": (["replay", database, trial, "--page", "r.html"], 2),
        "replay --verify": (["replay", database, "--verify"], 2),
        "explain": (["explain", database], 0),  # what the stored flight alone tells is told
        "explain TRIAL": (["explain", database, trial], 0),
        "explain TRIAL --png": (["explain", database, trial, "--png", "e.png"], 2),
        "explain --what-if": (["explain", database, "--what-if", "nothing"], 2),
        "explain --minimal": (["explain", database, trial, "--minimal", "scene", "--most-flights", "3"], 2),
    }


def foreign_command(at, straight_line):
    payload = f"{{ echo was here > {at.mark}; }} 2>/dev/null; exec {straight_line}"
    planner = f'{{plugin: process, label: evil, parameters: {{command: [sh, -c, "{payload}"]}}}}'
    database, trial = at.flown("command", planner, "--no-sandbox")
    at.expect("the command would leave a mark", at.mark.exists())
    at.mark.unlink(missing_ok=True)
    sweep = (at.folder / "command.yaml").rename(at.folder / "kept_away.yaml")
    for name, (words, code) in commands(database, trial).items():
        done = at.call(*words)
        at.expect(f"{name} ends with {code}", done.returncode == code, (done.returncode, done.stderr))
        at.expect(f"{name} starts no command", not at.mark.exists())
        at.expect(
            f"{name} shows it and says what to do",
            REFUSAL in done.stderr
            and str(at.mark) in done.stderr
            and "--sweep-file FILE or --library FILE" in done.stderr,
            done.stderr,
        )
        at.mark.unlink(missing_ok=True)
    done = at.call("replay", database, trial, "--library", straight_line)
    at.expect(
        "a program of one's own is flown, by no word of the database's",
        done.returncode == 0 and not at.mark.exists(),
        done.stderr,
    )
    done = at.call("replay", database, "--verify", "--sweep-file", sweep)
    at.expect(
        "what a sweep of one's own has is flown, in the sandbox",
        (done.returncode, done.stdout) == (0, "2 trials flown again, 0 different\n") and not at.mark.exists(),
        done,
    )
    at.expect(
        "what its sandbox grants it is said once",
        done.stderr.count("planner evil declares that it needs processes") == 1,
        done.stderr,
    )
    done = at.call("explain", database, "--sweep-file", sweep)
    at.expect(
        "and explained", done.returncode == 0 and REFUSAL not in done.stderr and not at.mark.exists(), done.stderr
    )


def foreign_library(at, library):
    """The run says that it had no sandbox: its word, too, is the stranger's."""
    database, trial = at.flown("library", f"{{plugin: {library}, label: evil}}", "--no-sandbox")
    at.expect("the library would leave a mark", at.mark.exists())
    at.mark.unlink(missing_ok=True)
    for name, (words, _) in commands(database, trial).items():
        done = at.call(*words)
        at.expect(f"{name} flies it", done.returncode == 0, (done.returncode, done.stderr))
        at.expect(f"{name} flies it in the sandbox", not at.mark.exists())
        at.mark.unlink(missing_ok=True)
    done = at.call("replay", database, trial, "--no-sandbox")
    at.expect("--no-sandbox is the user's word", done.returncode == 0 and at.mark.exists(), done.stderr)
    at.mark.unlink(missing_ok=True)
    for jobs in ("1", "2"):
        done = at.call("replay", database, "--verify", "--jobs", jobs)
        at.expect(f"{jobs} workers verify", done.stdout == "2 trials flown again, 0 different\n", done)


def other_commands(at):
    """What else opens databases, also where it ends with an error."""
    database = at.folder / "library.db"
    for words, code in (
        (["report", database], 0),
        (["report", database, "--page", "p.html"], 0),
        (["compare", database, database], 0),
        (["export", "trials", database], 0),
        (["replay", database, "--list"], 0),
        (["replay", database, "99"], 2),
        (["replay", database, "1", "--library", "nobody"], 2),
        (["explain", database, "99"], 2),
        (["explain", database, "--png", "x.png"], 2),
        (["merge", "all.db", database], 0),
        (["merge", "all.db", "nowhere.db"], 2),
        (["run", "library.yaml", "--db", database, "--rerun", "nobody"], 2),
    ):
        done = at.call(*words)
        at.expect(
            f"{words[0]} {words[2] if len(words) > 2 else ''} ends with {code}",
            done.returncode == code,
            (done.returncode, done.stderr),
        )


def main():
    program, library, straight_line = (str(pathlib.Path(word).absolute()) for word in sys.argv[1:4])
    with tempfile.TemporaryDirectory() as folder:
        at = Folder(program, folder)
        if re.search("kernel has no sandbox", at.call("run", "quick", "--dry-run").stderr):
            print("passed over: this kernel has no sandbox")
            sys.exit(77)
        foreign_library(at, library)
        foreign_command(at, straight_line)
        other_commands(at)
    sys.exit(1 if at.problems else 0)


if __name__ == "__main__":
    main()
