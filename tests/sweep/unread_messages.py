#!/usr/bin/env python3
"""A run goes on whoever reads its messages: with the rows of one that was left alone.

    unread_messages.py PROGRAM

Standard error is a terminal that was stopped (Ctrl-S), one whose window takes no more, a full pipe, or a pipe that
nobody reads; then the terminal goes away, which gives trials in flight the grace of any signal to stop, or none of it
matters under nohup."""

import contextlib
import os
import pty
import signal
import subprocess
import sys
import tempfile
import termios
import time

from disturbed_runs import Runs
from same_bits import rows


@contextlib.contextmanager
def terminal():
    """(the window's end, the program's end)"""
    ends = pty.openpty()
    try:
        yield ends
    finally:
        for end in ends:
            with contextlib.suppress(OSError):
                os.close(end)


def fill(descriptor):
    os.set_blocking(descriptor, False)
    for count in (4096, 1, 1):
        with contextlib.suppress(BlockingIOError):
            while True:
                os.write(descriptor, b"x" * count)
        time.sleep(0.1)  # a terminal passes on what it has
    os.set_blocking(descriptor, True)  # as the program finds it


class Unread:
    def __init__(self, runs, whole_s):
        self.runs, self.limit_s = runs, 60.0 + 5.0 * whole_s

    def command(self, name):
        return [word for word in self.runs.command(name, "--jobs", "2", "--progress", "json") if word != "--quiet"]

    def start(self, name, stderr, **options):
        return subprocess.Popen(
            self.command(name), stdout=subprocess.DEVNULL, stderr=stderr, stdin=subprocess.DEVNULL, **options
        )

    def problem(self, text):
        print(f"PROBLEM  {text}", flush=True)
        self.runs.problems += 1

    def expect(self, what, process, name, codes=(0,)):
        """It ends in time, with one of these exit codes, and 0 means all rows."""
        try:
            code = process.wait(timeout=self.limit_s)
        except subprocess.TimeoutExpired:
            self.problem(f"{what}: the run did not end within {self.limit_s:.0f} s")
            process.kill()
            process.wait()
            return
        if code not in codes:
            self.problem(f"{what}: exit code {code}, expected {codes}")
        elif code == 0:
            self.runs.expect(what, rows(self.runs.folder / name), self.runs.whole)
        else:
            self.runs.expect(f"{what}, then resumed", self.runs.run(name), self.runs.whole)

    def stopped_terminal(self):
        with terminal() as (_, inner):
            termios.tcflow(inner, termios.TCOOFF)
            self.expect("a stopped terminal", self.start("stopped_terminal.db", inner), "stopped_terminal.db")

    def stopped_terminal_and_signal(self):
        with terminal() as (_, inner):
            termios.tcflow(inner, termios.TCOOFF)
            process = self.start("signal.db", inner)
            time.sleep(1.0)
            process.send_signal(signal.SIGTERM)
            self.expect("a stopped terminal and SIGTERM", process, "signal.db", codes=(0, 75))

    def full_terminal(self):
        with terminal() as (_, inner):
            fill(inner)
            self.expect("a terminal that takes no more", self.start("full_terminal.db", inner), "full_terminal.db")

    def full_pipe(self):
        reader, writer = os.pipe()
        fill(writer)
        self.expect("a full pipe", self.start("full_pipe.db", writer), "full_pipe.db")
        if not os.get_blocking(writer):
            self.problem("the caller's pipe was made non-blocking")
        os.close(reader)
        os.close(writer)

    def broken_pipe(self):
        for name, to_stdout in (("broken_pipe.db", False), ("broken_both.db", True)):
            process = subprocess.Popen(
                self.command(name),
                stdout=subprocess.PIPE if to_stdout else subprocess.DEVNULL,
                stderr=subprocess.STDOUT if to_stdout else subprocess.PIPE,
            )
            reader = process.stdout or process.stderr
            os.read(reader.fileno(), 1)
            reader.close()
            self.expect(f"a pipe that nobody reads any more{' (2>&1 | head)' if to_stdout else ''}", process, name)

    def hang_up(self):
        """All of a session get the signal, and the run gets it twice: from the terminal and from its shell."""
        process = self.start("hang_up.db", subprocess.PIPE, start_new_session=True)
        process.stderr.readline()
        for _ in range(3):
            os.killpg(process.pid, signal.SIGHUP)
        text = process.stderr.read().decode()
        self.expect("a terminal that went away", process, "hang_up.db", codes=(0, 75))
        if process.returncode == 75 and "run the same command again to resume" not in text:
            self.problem(f"SIGHUP and no word of what to do: {text[-300:]!r}")
        process = self.start(
            "nohup.db", subprocess.PIPE, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)
        )
        process.stderr.readline()
        process.send_signal(signal.SIGHUP)
        process.stderr.read()
        self.expect("under nohup", process, "nohup.db")


def main():
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(sys.argv[1], folder)
        unread = Unread(runs, runs.fly_undisturbed("--jobs", "2"))
        for way in (
            unread.stopped_terminal,
            unread.stopped_terminal_and_signal,
            unread.full_terminal,
            unread.full_pipe,
            unread.broken_pipe,
            unread.hang_up,
        ):
            way()
    sys.exit(1 if runs.problems else 0)


if __name__ == "__main__":
    main()
