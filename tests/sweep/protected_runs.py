#!/usr/bin/env python3
"""`run` flies and says what protects it: as root and as an ordinary user, with and without namespaces, Landlock of each
version, filters of system calls.

    protected_runs.py PROGRAM --planners FOLDER [--cases 'a;b'] [--short]

In each case the rows are those of the first one; the database (runs.sandbox) says what protects the run, and a warning
where nothing does; and the ways of tests/sweep/hostile that it is protected from change nothing."""

import argparse
import contextlib
import os
import pathlib
import re
import sqlite3
import sys
import tempfile

from hostile_runs import Runs, arguments, good_of

NOBODY = 65534
SIGNALS = [
    "kill_parent",
    "stop_parent",
    "kill_parent_by_descriptor",
    "kill_parent_otherwise",
    "trace_parent",
    "limit_parents_files",
    "kill_siblings",
    "change_terminal",
    "freeze_terminal",
    "send_datagram",
    "call_newer_kernels",
]
PROGRAMS = ["read_parent_memory+program"]
FILES = [
    "update_rows",
    "remove_database",
    "truncate_database",
    "rename_database",
    "change_good_planner",
    "leave_files",
    "write_parent_memory",
    "read_terminal",
    "fill_shared_memory+processes",
    *PROGRAMS,
]
ALWAYS = ["write_inherited"]

# Case: (words before the program, user, options of run, what runs.sandbox says, ways that change nothing).
CASES = {
    "as it is": ([], 0, [], r"landlock.*seccomp", SIGNALS + FILES),
    "an ordinary user": ([], NOBODY, [], r"landlock.*seccomp", SIGNALS + FILES),
    "no namespaces": (["--no-namespaces"], 0, [], r"landlock.*seccomp", SIGNALS + FILES),
    "an ordinary user, no namespaces": (["--no-namespaces"], NOBODY, [], r"landlock.*seccomp", SIGNALS + FILES),
    "no Landlock": (["--no-landlock"], 0, [], r"^(?!.*landlock).*seccomp", SIGNALS),
    "an ordinary user, no Landlock": (["--no-landlock"], NOBODY, [], r"^(?!.*landlock).*seccomp", SIGNALS + PROGRAMS),
    "an ordinary user in a container, no Landlock": (
        ["--no-landlock", "--no-namespaces"],
        NOBODY,
        [],
        r"^(?!.*landlock).*seccomp",
        SIGNALS + PROGRAMS,
    ),
    "no seccomp": (["--no-seccomp"], 0, [], r"landlock(?!.*seccomp)", FILES),
    "nothing": (["--no-seccomp", "--no-landlock"], 0, [], r"^none: the kernel", ALWAYS),
    "--no-sandbox": ([], 0, ["--run-option=--no-sandbox"], r"^none: --no-sandbox", ALWAYS),
} | {
    f"Landlock {version}": ([f"--landlock-version={version}"], 0, [], r"landlock.*seccomp", SIGNALS + FILES)
    for version in (1, 2, 3, 4, 5, 6)
}


def sandbox_of(file):
    with contextlib.closing(sqlite3.connect(file)) as db:
        return db.execute("SELECT DISTINCT sandbox FROM runs").fetchall()


def check(given, folder, name, first):
    """The problems of a case, its rows, and what it says of itself."""
    words, user, options, pattern, ways = CASES[name]
    before = f"--before={given.planners / 'older_kernel'} {' '.join(words)}" if words else "--before="
    if user:
        before = before.replace(str(given.planners / "older_kernel"), str(folder / "older_kernel"))
        folder.chmod(0o755)
        (folder / "older_kernel").write_bytes((given.planners / "older_kernel").read_bytes())
        (folder / "older_kernel").chmod(0o755)
    runs = Runs(
        arguments(
            [
                str(given.program),
                "--planners",
                str(given.planners),
                "--missions",
                "2",
                f"--as-user={user}",
                before,
                *options,
            ]
        ),
        folder,
    )
    runs.measure()
    problems = []
    if first is not None and (good_of(runs.honest) != good_of(first) or runs.honest["map"] != first["map"]):
        problems.append("other rows")
    said = sandbox_of(folder / "nothing/run/results.db")
    if len(said) != 1 or not re.search(pattern, said[0][0], re.IGNORECASE):
        problems.append(f"runs.sandbox says {said}")
    if "no Landlock" in name and "no Landlock" not in runs.honest_text:
        problems.append(f"no warning that files can be written: {runs.honest_text!r}")
    if name == "nothing" and "no sandbox" not in runs.honest_text:
        problems.append(f"no warning that nothing protects it: {runs.honest_text!r}")
    for way in ways[:1] + ways[-1:] if given.short else ways:
        problems += [f"{way}: {problem}" for problem in runs.fly(way)[0]]
    return problems, runs.honest, said


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--planners", required=True, type=pathlib.Path)
    parser.add_argument("--short", action="store_true", help="two ways a case")
    parser.add_argument("--cases", default="", help="names, separated by | [all]")
    given = parser.parse_args()
    given.planners = given.planners.resolve()
    first, broken = None, 0
    for name in given.cases.split("|") if given.cases else CASES:
        if CASES[name][1] and os.getuid() != 0:
            print(f"passed over: {name} (only root can become another user)")
            continue
        with tempfile.TemporaryDirectory() as folder:
            problems, rows, said = check(given, pathlib.Path(folder), name, first)
        first = first or rows
        broken += 1 if problems else 0
        print(
            f"{'BROKEN' if problems else 'ok    '} {name}: {said}"
            + "".join(f"\n      {problem}" for problem in problems),
            flush=True,
        )
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
