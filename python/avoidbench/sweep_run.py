"""Flies a sweep: `avoidbench run` with a progress bar."""

from __future__ import annotations

import contextlib
import json
import os
import queue
import re
import signal
import subprocess
import sys
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import FrameType
from typing import Any

from tqdm.auto import tqdm

from avoidbench._text import without_columns
from avoidbench.database_file import all_sweeps, opened
from avoidbench.program import ProgramError, environment, error_of, find_program, path_argument, run_program, warn_of
from avoidbench.results import Results

Sweep = str | os.PathLike[str] | Mapping[str, Any]

_EXIT_DONE, _EXIT_UNFLOWN = 0, 1
_POLL_S = 0.2
_END = re.compile(
    r"results are in (?P<file>.*); to see them: avoidbench report .*?"
    r"( --sweep (?P<sweep>[A-Za-z0-9_.-]+)@(?P<revision>\d+))?"
)
_NAME = re.compile(r"""^['"]?sweep['"]?:\s*['"]?(?P<name>[A-Za-z0-9_.-]+)['"]?\s*(#.*)?$""", re.MULTILINE)


def _plain(value: Any) -> Any:
    """What JSON has no word for: paths, and numbers and arrays of NumPy."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{value!r} of type {type(value).__name__} can't be used in a sweep")


def _json(value: Any) -> str:
    return json.dumps(value, default=_plain, ensure_ascii=False, allow_nan=False)


def _overrides(values: Mapping[str, Any] | Sequence[str] | None) -> list[str]:
    """The arguments `--set PATH=VALUE`."""
    if values is None:
        return []
    if isinstance(values, str):
        return [f"--set={values}"]
    if isinstance(values, Mapping):
        return [f"--set={path}={_json(value)}" for path, value in values.items()]
    return [f"--set={text}" for text in values]


def _visible(text: str) -> str:
    """Without characters that a terminal obeys."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


class _Bar:
    """Shows what the program says on standard error."""

    def __init__(self, is_shown: bool) -> None:
        self.is_shown = is_shown
        self.lines: list[str] = []
        self._bar: tqdm[Any] | None = None

    def take(self, line: str) -> None:
        """One line: progress as JSON, or a message."""
        progress = None
        if line.startswith("{"):
            with contextlib.suppress(ValueError):
                progress = json.loads(line)
        if not isinstance(progress, dict) or not {"done", "done_before", "total", "planners"} <= progress.keys():
            self.say(line)
            self.lines.append(line)
            return
        if not self.is_shown:
            return
        if self._bar is None:
            self._bar = tqdm(total=progress["total"], initial=progress["done_before"], unit="trial", dynamic_ncols=True)
        goals = ", ".join(
            f"{_visible(label)} {planner['reached_goal']}/{planner['flown']}"
            for label, planner in progress["planners"].items()
        )
        self._bar.set_postfix_str(f"goals: {goals}" if goals else "", refresh=False)
        is_new = progress["done"] != self._bar.n
        self._bar.n = progress["done"]
        if is_new or sys.stderr.isatty():  # a terminal's clock goes on; a log is not filled with it
            self._bar.refresh()
        if progress["done"] >= progress["total"]:
            self._bar.close()  # what comes now is said below it

    def say(self, line: str) -> None:
        """Shows a message; warnings are Python's to show."""
        if self.is_shown and line and not line.startswith("warning: "):
            tqdm.write(line, file=sys.stderr)

    def close(self, is_stopped: bool) -> None:
        """The bar of a run that was stopped goes away: the program does not say how far it came at last."""
        if self._bar is not None:
            self._bar.leave = not is_stopped
            self._bar.close()


def _read_lines(process: subprocess.Popen[bytes], lines: queue.SimpleQueue[str]) -> None:
    assert process.stderr is not None
    for line in process.stderr:
        lines.put(line.decode("utf-8", errors="replace").rstrip("\n"))


class _Interrupts:
    """Gives each SIGINT (Ctrl-C, a notebook's stop) to the program for as long as it runs, instead of raising
    KeyboardInterrupt: the first asks it to finish what flies, a second one to end at once, as in a shell.

    Only a main thread gets signals; where they are ignored (nohup), they stay so.
    """

    def __init__(self) -> None:
        self.count = 0
        self._given = 0
        self._process: subprocess.Popen[bytes] | None = None
        is_main = threading.current_thread() is threading.main_thread()
        self._former = signal.getsignal(signal.SIGINT) if is_main else None
        self._is_caught = self._former not in (None, signal.SIG_IGN)

    def __enter__(self) -> _Interrupts:
        if self._is_caught:
            signal.signal(signal.SIGINT, self._forward)
        return self

    def __exit__(self, *_: object) -> None:
        if self._is_caught:
            signal.signal(signal.SIGINT, self._former)

    def give_to(self, process: subprocess.Popen[bytes]) -> None:
        """From now on to this process, with those that came before it was there."""
        self._process = process
        self._give()

    def _give(self) -> None:
        while self._process is not None and self._given < self.count:
            self._given += 1
            self._process.send_signal(signal.SIGINT)

    def _forward(self, _number: int, _frame: FrameType | None) -> None:
        self.count += 1
        self._give()


def _watch(process: subprocess.Popen[bytes], bar: _Bar, interrupts: _Interrupts) -> None:
    """Shows what the program says, until it ends."""
    lines: queue.SimpleQueue[str] = queue.SimpleQueue()
    reader = threading.Thread(target=_read_lines, args=(process, lines), daemon=True)
    reader.start()
    is_told = False
    while reader.is_alive() or process.poll() is None or not lines.empty():
        if interrupts.count > 0 and not is_told:
            bar.say("stopping: trials in flight are finished first; interrupt again to end at once")
            is_told = True
        with contextlib.suppress(queue.Empty):
            bar.take(lines.get(timeout=_POLL_S))


def _fly(arguments: Sequence[str], input_text: str | None, bar: _Bar) -> tuple[list[str], int, bool]:
    """Runs the program. Returns its command, its exit code, and whether the user interrupted."""
    command = [str(find_program()), *arguments]
    with _Interrupts() as interrupts:
        # In a session of its own: a terminal's Ctrl-C would reach it beside the signal sent here, and two
        # signals end it at once.
        try:
            process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                start_new_session=True,
                env=environment(),
            )
        except OSError as error:
            raise ProgramError(f"{command[0]} can't be started: {error.strerror}", command) from error
        try:
            interrupts.give_to(process)
            assert process.stdin is not None
            with contextlib.suppress(BrokenPipeError):  # it ended without reading, and says why
                process.stdin.write((input_text or "").encode())
                process.stdin.close()
            _watch(process, bar, interrupts)
        finally:
            if process.poll() is None:
                process.terminate()
                process.wait()
            if process.stderr is not None:
                process.stderr.close()
            bar.close(is_stopped=process.returncode not in (_EXIT_DONE, _EXIT_UNFLOWN))
        return command, process.returncode, interrupts.count > 0


def _name_of(sweep: str, overrides: Sequence[str], input_text: str | None) -> str | None:
    """The sweep's own name; None where the file is wrong, which `run` reports."""
    try:
        output = run_program(["config", "check", sweep, "--resolved", *overrides], input_text=input_text, warns=False)
    except ProgramError:
        return None
    found = _NAME.search(output.text)
    return found["name"] if found else None


def _results(bar: _Bar, database: str | os.PathLike[str] | None, name: str | None) -> Results:
    """The sweep and revision that was flown, by the last line that the program says."""
    ends = [found for line in bar.lines if (found := _END.fullmatch(line))]
    if not ends:
        raise ProgramError("the program did not say where its results are", stderr="\n".join(bar.lines))
    end = ends[-1]
    file = end["file"] if database is None else database
    if end["sweep"]:
        return Results(file, end["sweep"], int(end["revision"]))
    with opened(Path(file).absolute()) as connection:
        latest = {choice.sweep: choice.revision for choice in all_sweeps(connection)}
    chosen = name if name in latest else next(iter(latest)) if len(latest) == 1 else None
    return Results(file) if chosen is None else Results(file, chosen, latest[chosen])


def _number_options(values: Mapping[str, float | None]) -> list[str]:
    return [f"--{name}={float(value)!r}" for name, value in values.items() if value is not None]


def run(
    sweep: Sweep,
    *,
    set: Mapping[str, Any] | Sequence[str] | None = None,
    jobs: int | None = None,
    database: str | os.PathLike[str] | None = None,
    progress: bool = True,
    shard: str | None = None,
    until: str | None = None,
    rerun: str | None = None,
    plan_timeout_s: float | None = None,
    trial_timeout_s: float | None = None,
    memory_limit_mib: float | None = None,
    grace_s: float | None = None,
    bundle: bool = False,
    keep_planners: bool = True,
    sandbox: bool = True,
) -> Results:
    """Flies a sweep's trials by the avoidbench program, in worker processes, and returns their results.

    Trials that the database has are not flown again, so the same call resumes where it was stopped. An
    interrupt (Ctrl-C, a notebook's stop) lets the trials in flight finish and keeps all finished trials; a
    second one ends immediately.

    Args:
        sweep: a sweep file (YAML), the name of one that comes with avoidbench ("quick"), or a dict with the
            contents of a file, whose paths are relative to the current folder.
        set: values to override, {"maps.poisson_radius_m": 3.0} or ["maps.poisson_radius_m=3.0"]; a list of
            values in place of one value is an axis.
        jobs: worker processes; None: one per allowed CPU.
        database: file of the results; None: results/NAME.db, NAME being the sweep's.
        progress: shows a bar and the program's messages. Its warnings are always Python's warnings.
        shard: fly this part of the sweep only, such as "2/3".
        until: when a planner has flown enough, such as "success_rate ci<0.05".
        rerun: fly stored trials again: "failed", "all", or a trial's key.
        plan_timeout_s, trial_timeout_s: wall time after which a plan call (10) or trial (3600) counts as hung.
        memory_limit_mib: limit of a worker's resident memory; None: nine tenths of the memory, shared by all.
        grace_s: time for trials in flight to finish after an interrupt (30).
        bundle: also keep copies of map and wind field files next to the database.
        keep_planners: keep copies of the planners there, to fly trials again after a rebuild.
        sandbox: False lets planners write files, start programs and use the network.

    Returns:
        The results of this sweep in the revision that was flown, including those of earlier runs.

    Raises:
        ProgramError: the errors in the sweep, with FILE:LINE:COLUMN, or why the run failed.
        KeyboardInterrupt: the user stopped it.
    """
    is_dict = isinstance(sweep, Mapping)
    input_text = _json(sweep) if is_dict else None
    file = "-" if is_dict else path_argument(sweep)  # type: ignore[arg-type]
    overrides = _overrides(set)
    arguments = ["run", file, "--progress=json", *overrides]
    texts = {
        "shard": shard,
        "until": until,
        "rerun": rerun,
        "db": None if database is None else os.fspath(database),
        "jobs": None if jobs is None else str(jobs),
    }
    arguments += [f"--{name}={value}" for name, value in texts.items() if value is not None]
    arguments += _number_options(
        {
            "plan-timeout": plan_timeout_s,
            "trial-timeout": trial_timeout_s,
            "memory-limit": memory_limit_mib,
            "grace": grace_s,
        }
    )
    flags = {"--bundle": bundle, "--no-keep": not keep_planners, "--no-sandbox": not sandbox}
    arguments += [flag for flag, is_given in flags.items() if is_given]
    name = _name_of(file, overrides, input_text)
    bar = _Bar(progress)
    command, exit_code, is_interrupted = _fly(arguments, input_text, bar)
    stderr = "\n".join(bar.lines)
    if is_dict:
        stderr = without_columns(stderr, "standard input", "the sweep")
    if is_interrupted:
        raise KeyboardInterrupt("stopped; finished trials are kept, and the same call resumes from there")
    if exit_code not in (_EXIT_DONE, _EXIT_UNFLOWN):
        raise error_of(command, exit_code, stderr)
    warn_of(stderr, stacklevel=2)
    return _results(bar, database, name)
