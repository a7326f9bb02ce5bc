"""Finds the avoidbench program and runs it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import warnings
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from avoidbench._location import program_file

WARNING_MARK = "warning: "


class ProgramError(RuntimeError):
    """The avoidbench program was not found, refused its input, or failed.

    str() is the program's own message; an error in a file has its place, FILE:LINE:COLUMN,
    and an error in a dict its key.

    Attributes:
        command: the program and its arguments; empty where there is no program.
        exit_code: of the program: 2 for wrong input, negative for the signal that ended it; None
            if it was not started.
        stderr: everything that the program printed there, including warnings.
    """

    def __init__(
        self, message: str, command: Sequence[str] = (), exit_code: int | None = None, stderr: str = ""
    ) -> None:
        super().__init__(message)
        self.command = tuple(command)
        self.exit_code = exit_code
        self.stderr = stderr

    def __reduce__(self) -> tuple[type[ProgramError], tuple[object, ...]]:
        return type(self), (str(self), self.command, self.exit_code, self.stderr)


@dataclass(frozen=True)
class ProgramOutput:
    """What a run of the program gave: standard output as it came, messages, exit code."""

    stdout: bytes
    stderr: str
    exit_code: int

    @property
    def text(self) -> str:
        return self.stdout.decode("utf-8")


def find_program() -> Path:
    """The avoidbench program that this package uses.

    Raises:
        ProgramError: there is none, or AVOIDBENCH_PROGRAM names no program.
    """
    try:
        return program_file()
    except FileNotFoundError as error:
        raise ProgramError(str(error)) from None


def environment() -> dict[str, str]:
    """For the program: it starts planners in Python by this Python, as in its activated environment."""
    folders = [os.path.dirname(sys.executable), os.environ.get("PATH", os.defpath)]
    return {**os.environ, "PATH": os.pathsep.join(filter(None, folders))}


def warn_of(stderr: str, stacklevel: int = 3) -> None:
    """Gives the program's warnings to Python's `warnings`."""
    for line in stderr.splitlines():
        if line.startswith(WARNING_MARK):
            warnings.warn(line.removeprefix(WARNING_MARK), stacklevel=stacklevel + 1)


def error_of(command: Sequence[str], exit_code: int, stderr: str) -> ProgramError:
    """The exception for a program that ended with this exit code, with its message."""
    lines = [line for line in stderr.splitlines() if line and not line.startswith(WARNING_MARK)]
    what = " ".join(["avoidbench", *command[1:2]])
    if exit_code < 0:
        try:
            name = signal.Signals(-exit_code).name
        except ValueError:
            name = f"signal {-exit_code}"
        lines.append(f"{what} was ended by {name}")
    if not lines:
        lines = [f"{what} ended with exit code {exit_code} and printed no message"]
    return ProgramError("\n".join(lines), command, exit_code, stderr)


def path_argument(path: str | os.PathLike[str]) -> str:
    """A path as the program takes it: none is mistaken for an option."""
    text = os.fspath(path)
    return f"./{text}" if text.startswith("-") else text


def run_program(
    arguments: Sequence[str],
    *,
    input_text: str | None = None,
    good_exit_codes: Collection[int] = (0,),
    warns: bool = True,
) -> ProgramOutput:
    """Runs the program to its end.

    Args:
        arguments: without the program itself.
        input_text: for its standard input.
        good_exit_codes: those that are no error.
        warns: whether its warnings become Python's.

    Raises:
        ProgramError: any other exit code, with the program's message.
    """
    command = [str(find_program()), *arguments]
    try:
        done = subprocess.run(
            command, input=(input_text or "").encode(), capture_output=True, check=False, env=environment()
        )
    except OSError as error:
        raise ProgramError(f"{command[0]} can't be started: {error.strerror}", command) from error
    stderr = done.stderr.decode("utf-8", errors="replace")
    if done.returncode not in good_exit_codes:
        raise error_of(command, done.returncode, stderr)
    if warns:
        warn_of(stderr)
    return ProgramOutput(done.stdout, stderr, done.returncode)
