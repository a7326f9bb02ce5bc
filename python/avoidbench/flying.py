"""Flies planners that are written in Python, in this process."""

import hashlib
import inspect
import os
import signal
import tempfile
import threading
import warnings
from collections.abc import Mapping
from pathlib import Path
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any

from avoidbench import _core
from avoidbench._input import plain_places
from avoidbench._text import overrides, plain_text, yaml_text
from avoidbench.planner import Planner
from avoidbench.planner_files import planner_files
from avoidbench.planner_table import Table

if TYPE_CHECKING:
    from avoidbench.results import Results

_TABLES: dict[str, Table] = {}
"""By file: a registered table must stay."""


def _source_file(planner: type[Planner]) -> Path:
    """The file that the class is written in; of a notebook's a copy of its source."""
    try:
        file = Path(inspect.getfile(planner))
        if file.is_file():
            return file.absolute()
        source = inspect.getsource(planner)
    except (OSError, TypeError):
        raise ValueError(
            f"{planner.__name__}: its source is not to be had, and trials need its digest: write it in a file"
        ) from None
    digest = hashlib.sha256(source.encode()).hexdigest()
    folder = Path(tempfile.gettempdir()) / f"avoidbench-{os.getuid()}" / digest
    folder.mkdir(parents=True, exist_ok=True)
    copy = folder / f"{planner.name}.py"
    if not copy.is_file():
        partial = copy.with_suffix(f".{os.getpid()}")
        partial.write_text(source, encoding="utf-8")
        partial.replace(copy)
    return copy


class _Stopping:
    """An interrupt ends the sweep after the trial that flies, instead of in the middle of it."""

    def __init__(self) -> None:
        self.is_asked = False
        self._before: Any = None

    def _ask(self, number: int, frame: FrameType | None) -> None:
        self.is_asked = True
        _core.stop_flying()

    def __enter__(self) -> "_Stopping":
        if threading.current_thread() is threading.main_thread():
            self._before = signal.signal(signal.SIGINT, self._ask)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)


def fly(
    sweep: str | os.PathLike[str] | Mapping[str, Any],
    planner: type[Planner],
    *,
    parameters: Mapping[str, Any] | None = None,
    label: str | None = None,
    camera: int | None = None,
    set: Mapping[str, Any] | None = None,
    database: str | os.PathLike[str] | None = None,
    progress: bool = True,
) -> "Results":
    """Flies `planner` over all missions of a sweep in place of the sweep's own planners, in this process, one trial
    after the other.

    The trials are those that the program flies: same missions, keys, metrics and database. What the planner's call
    costs, Python's own share included, is its computing time. Trials that the database has are not flown again. An
    interrupt (Ctrl-C) ends after the trial that flies; what was flown is kept.

    Args:
        sweep: a sweep file, the name of a built-in sweep ("quick"), or a dict that says what a file would.
        planner: a subclass of Planner. The digests of the file that it is written in, of the modules that this imports
        from its folder
            and of the planner's `files` are part of its trials' keys; what else it reads is not, so change `version`
            with it.
        parameters: values of the planner's parameters.
        label: its name in reports; else its own.
        camera: of a sensor with several cameras the one that it sees, by its index; else each. A planner of one_camera
        needs it there. set: changes to the sweep, as the program's `--set`. database: file of the results; else
        results/NAME.db, NAME being the sweep's. progress: shows a bar.

    Raises InputError for what is wrong in a sweep, with file, line and column, or with the planner's declarations;
    KeyboardInterrupt after an interrupt."""
    from tqdm.auto import tqdm

    from avoidbench.results import Results

    table = Table(planner)
    script = _source_file(planner)
    table.name_files(planner_files(script, planner.files))
    file = str(script)
    _core.register_planner(file, table.address)
    _TABLES[f"{file} {table.address}"] = table
    chosen: dict[str, Any] = {"plugin": file, "parameters": dict(parameters or {})}
    if label is not None:
        chosen["label"] = label
    if camera is not None:
        chosen["camera"] = camera
    given, text = (
        (plain_text(os.fspath(sweep), "sweep"), None)
        if not isinstance(sweep, Mapping)
        else ("the sweep", yaml_text({**sweep, "planners": []}, "sweep"))
    )
    changes = [*overrides(set or {}), f"planners={yaml_text([chosen], 'planners')}"]
    with _Stopping() as stopping, tqdm(unit="trial", disable=not progress) as bar:

        def show(total: int, done: int) -> None:
            bar.total = total
            bar.n = done
            bar.refresh()

        file_of_results = "" if database is None else plain_text(os.fspath(database), "database")
        with plain_places(given if text is not None else None):
            flown = _core.fly_sweep(given, text, changes, file_of_results, show)
    for warning in flown["warnings"]:
        warnings.warn(warning, stacklevel=2)
    if stopping.is_asked:
        raise KeyboardInterrupt("stopped after the trial that flew; the same call goes on")
    return Results(flown["database"], flown["sweep"], flown["revision"])
