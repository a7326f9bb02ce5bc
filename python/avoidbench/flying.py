"""Flies a class of avoidbench.Planner over a sweep, using the program."""

import contextlib
import hashlib
import inspect
import linecache
import os
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from avoidbench._layouts import AB_PROCESS_VARIABLE
from avoidbench.planner import Planner
from avoidbench.serving import check, planners_of

if TYPE_CHECKING:
    from avoidbench.results import Results


def _place(planner: type[Planner]) -> str:
    """The file that a class is written in, or what Python calls a notebook's cell; "" where nobody knows."""
    with contextlib.suppress(OSError, TypeError):
        file = inspect.getfile(planner)
        if Path(file).is_file():
            return file
    functions = [value for value in vars(planner).values() if inspect.isfunction(value)]
    return functions[0].__code__.co_filename if functions else ""


def _copy_of_cell(place: str, planner: type[Planner]) -> Path:
    source = "".join(linecache.getlines(place))
    if not source:
        raise ValueError(
            f"{planner.__name__}: its source can't be found, and the program starts it from a file: define it in a file"
        )
    folder = Path(tempfile.gettempdir()) / f"avoidbench-{os.getuid()}" / hashlib.sha256(source.encode()).hexdigest()
    folder.mkdir(parents=True, exist_ok=True)
    copy = folder / f"{planner.name}.py"
    if not copy.is_file():
        partial = copy.with_suffix(f".{os.getpid()}")
        partial.write_text(source, encoding="utf-8")
        partial.replace(copy)
    return copy


def _entry(planner: type[Planner]) -> tuple[str, dict[str, Any]]:
    """What a sweep says of the class: `plugin`, and among the parameters the command that chooses one of several."""
    place = _place(planner)
    file = Path(place).absolute() if Path(place).is_file() else _copy_of_cell(place, planner)
    module = sys.modules[planner.__module__]
    beside = [name for name, one in planners_of(module).items() if _place(one) == place]
    if planner.__name__ not in beside:
        raise ValueError(f"expected a class at the top level of its file, got {planner.__qualname__}")
    if len(beside) == 1:
        return str(file), {}
    return "process", {"command": ["python3", "-m", "avoidbench.serving", str(file), planner.__name__]}


def fly(
    sweep: str | os.PathLike[str] | Mapping[str, Any],
    planner: type[Planner],
    *,
    parameters: Mapping[str, Any] | None = None,
    label: str | None = None,
    camera: int | None = None,
    filter: str | Mapping[str, Any] | None = None,
    set: Mapping[str, Any] | None = None,
    database: str | os.PathLike[str] | None = None,
    progress: bool = True,
    **options: Any,
) -> "Results":
    """Flies `planner` over all missions of a sweep in place of the sweep's own planners: run() with the file that the
    class is written in. The program starts this Python for it, in its sandbox, once for each of its workers.

    That file is imported there, so it calls fly() under `if __name__ == "__main__":` only; of a notebook it is the cell
    that defines the class, with what this imports. One of several planners of a file is started by a command that names
    it, which is then part of its trials' keys.

    Args:
        sweep: a sweep file, the name of a built-in sweep ("quick"), or a dict with the contents of a file.
        planner: a subclass of Planner. The digests of its file, of the modules that this imports from its folder and of
            the planner's `files` are part of its trials' keys; what else it reads is not, so change `version` with it.
        parameters: values of the planner's parameters.
        label: its name in reports (default: its own).
        camera: index of the one camera that it sees, if the sensor has several (default: all). A planner with
            one_camera then needs it.
        filter: the filter that its commands pass through, as in a sweep: "stopping_distance", a file, or a dict of
            plugin and parameters.
        set, database, progress: as run() has them.
        options: further arguments of run(), such as jobs, plan_timeout_s and sandbox.

    Raises InputError for errors in a sweep, with file, line and column, or in the planner's declarations;
    ProgramError if the program failed otherwise; KeyboardInterrupt after an interrupt."""
    if AB_PROCESS_VARIABLE in os.environ:
        raise RuntimeError(
            "fly() was called while the program imports its planner's file: call it under if __name__ == '__main__'"
        )
    from avoidbench._extension import InputError
    from avoidbench.program import ProgramError
    from avoidbench.sweep_run import run

    check(planner)
    plugin, command = _entry(planner)
    chosen: dict[str, Any] = {"plugin": plugin, "parameters": {**command, **(parameters or {})}}
    if label is not None:
        chosen["label"] = label
    if camera is not None:
        chosen["camera"] = camera
    if filter is not None:
        chosen["filter"] = filter
    if isinstance(sweep, Mapping):
        sweep = {**sweep, "planners": [chosen]}
    else:
        set = {**(set or {}), "planners": [chosen]}
    try:
        return run(sweep, set=set, database=database, progress=progress, **options)
    except ProgramError as error:
        if error.exit_code == 2:
            raise InputError(str(error)) from None
        raise
