#!/usr/bin/env python3
"""Runs command-line tests that are text files.

usage: run_cli_tests.py --program build/avoidbench --plugins build/tests/plugin/bad FILE.test…

A file is a list of steps, run in a new empty folder:

    # a comment
    $ avoidbench config check bad.yaml      the command, by /bin/sh
    exit: 2                                 its exit code; 0 where this line is missing
    stdout:                                 then the lines expected there
    stderr:                                 likewise; both may be missing: not looked at
    ~~~ bad.yaml                            a file to write, up to the closing ~~~
    ~~~

An expected line `...` stands for any number of lines, and `...` within a line for any text. A backslash at the
beginning of an expected line is left out, so that what would begin something else can be expected: `\\# a heading`,
`\\$ a command`, `\\~~~ text`. In commands and expected lines @SOURCE@ is the source tree, @PLUGINS@ the folder of bad
planners. A file without a command fails."""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent


def parse(text):
    """The file's steps: ("file", name, content) or ("run", line number, command, exit, stdout, stderr)."""
    steps, current, stream = [], None, None
    lines = text.split("\n")
    i = 0
    while i < len(lines):
        line = lines[i]
        i += 1
        if line.startswith("~~~ "):
            end = lines.index("~~~", i)
            steps.append(("file", line[4:].strip(), "\n".join(lines[i:end]) + "\n"))
            i = end + 1
            current = stream = None
        elif line.startswith("$ "):
            current = {"line": i, "command": line[2:], "exit": 0, "stdout": None, "stderr": None}
            steps.append(("run", current))
            stream = None
        elif current is not None and stream is None and line.startswith("exit: "):
            current["exit"] = int(line[6:])
        elif current is not None and line in ("stdout:", "stderr:"):
            stream = line[:-1]
            current[stream] = []
        elif line.startswith("# "):
            stream = None
        elif stream is not None:
            current[stream].append(line.removeprefix("\\"))
        elif line.strip():
            raise SystemExit(f"line {i}: what is this? {line}")
    if not any(step[0] == "run" for step in steps):
        raise SystemExit("no command to run")
    return steps


def pattern(expected):
    """A regular expression for the expected lines; blank lines at the end do not count."""
    while expected and not expected[-1].strip():
        expected = expected[:-1]
    parts = []
    for line in expected:
        if line.strip() == "...":
            parts.append(r"(?:[^\n]*\n)*?")
        else:
            parts.append(r"[^\n]*?".join(re.escape(piece) for piece in line.split("...")) + r"[ \t]*\n")
    return re.compile("".join(parts) + r"\s*")


def run_file(path, program, plugins):
    names = {"@SOURCE@": str(HERE.parent.parent), "@PLUGINS@": plugins}

    def filled(text):
        for name, value in names.items():
            text = text.replace(name, value)
        return text

    failures = []
    environment = dict(os.environ, LC_ALL="C.UTF-8", NO_COLOR="1", COLUMNS="80")
    environment.pop("AVOIDBENCH_PLANNER_PATH", None)
    environment["PATH"] = os.path.dirname(program) + os.pathsep + environment.get("PATH", "")
    with tempfile.TemporaryDirectory(prefix="avoidbench_cli_") as folder:
        for step in parse(path.read_text()):
            if step[0] == "file":
                target = pathlib.Path(folder, step[1])
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_text(filled(step[2]))
                continue
            run = step[1]
            done = subprocess.run(
                ["/bin/sh", "-c", filled(run["command"])],
                cwd=folder,
                env=environment,
                capture_output=True,
                text=True,
                timeout=300,
                stdin=subprocess.DEVNULL,
            )
            place = f"{path.name}:{run['line']}: $ {run['command']}"
            if done.returncode != run["exit"]:
                failures.append(
                    f"{place}\n  exit code {done.returncode}, expected {run['exit']}\n"
                    f"  stdout: {done.stdout}\n  stderr: {done.stderr}"
                )
                continue
            for stream in ("stdout", "stderr"):
                expected = run[stream]
                if expected is None:
                    continue
                actual = getattr(done, stream)
                if actual and not actual.endswith("\n"):
                    actual += "\n"
                if not pattern([filled(line) for line in expected]).fullmatch(actual):
                    failures.append(
                        f"{place}\n--- expected {stream}\n" + filled("\n".join(expected)) + f"\n--- got\n{actual}"
                    )
    return failures


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--plugins", default="")
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    failed = 0
    for path in arguments.files:
        for failure in run_file(path, os.path.abspath(arguments.program), os.path.abspath(arguments.plugins)):
            print(failure)
            failed += 1
    if failed:
        print(f"{failed} steps failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
