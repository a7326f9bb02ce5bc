"""Finds the program that belongs to this package."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path


def program_file() -> Path:
    """The program `avoidbench` that this package uses. The first that exists of: the file that the environment variable
    AVOIDBENCH_PROGRAM names; the one in the package, if installed with it; the one of the build tree that contains the
    package; `avoidbench` on the PATH, unless that is this package's own.

    Raises FileNotFoundError if there is none, or AVOIDBENCH_PROGRAM does not name a program."""
    named = os.environ.get("AVOIDBENCH_PROGRAM")
    if named:
        if not _is_program(Path(named)):
            raise FileNotFoundError(f"AVOIDBENCH_PROGRAM={named}: there is no executable program")
        return Path(named).absolute()
    package = Path(__file__).parent.absolute()  # not resolved: a build tree has this file by a link
    places = [package / "program" / "bin" / "avoidbench", package.parent.parent / "avoidbench"]
    for place in places:
        if _is_program(place):
            return place
    on_path = shutil.which("avoidbench")
    if on_path and not _is_script(Path(on_path)):
        return Path(on_path)
    raise FileNotFoundError(
        "the avoidbench program was not found: install it (docs/install.md), or name it by the environment variable "
        f"AVOIDBENCH_PROGRAM. Looked for: {', '.join(map(str, places))}, and avoidbench on the PATH"
    )


def _is_program(file: Path) -> bool:
    return file.is_file() and os.access(file, os.X_OK)


def _is_script(file: Path) -> bool:
    """As what pip makes of `python -m avoidbench`, which would look for itself."""
    with file.open("rb") as start:
        return start.read(2) == b"#!"


def tell_program_file(tell: Callable[[str], None]) -> None:
    """Gives program_file() to `tell`, if there is one. Raises FileNotFoundError if AVOIDBENCH_PROGRAM names none."""
    try:
        tell(str(program_file()))
    except FileNotFoundError:
        if os.environ.get("AVOIDBENCH_PROGRAM"):
            raise
        # Maps of generators and of files need no program.
