"""Where the program lies that belongs to this package."""

import os
from pathlib import Path

from avoidbench import _core


def program_file() -> Path:
    """The program `avoidbench`: what the environment variable AVOIDBENCH_PROGRAM names; else that in the package, where it was
    installed with it; else that of the build tree in which the package lies.

    Raises FileNotFoundError where there is none."""
    named = os.environ.get("AVOIDBENCH_PROGRAM")
    if named:
        file = Path(named).resolve()
        if not file.is_file():
            raise FileNotFoundError(f"AVOIDBENCH_PROGRAM: no file {file}")
        return file
    package = Path(__file__).parent.absolute()  # not resolved: a build tree has this file by a link
    candidates = [package / "program" / "bin" / "avoidbench", package.parent.parent / "avoidbench"]
    for file in candidates:
        if file.is_file():
            return file.resolve()
    looked = ", ".join(str(file) for file in candidates)
    raise FileNotFoundError(f"the program avoidbench is not there; looked for {looked}; AVOIDBENCH_PROGRAM may name it")


def _tell_extension() -> None:
    try:
        _core.set_program_file(str(program_file()))
    except FileNotFoundError:
        if os.environ.get("AVOIDBENCH_PROGRAM"):
            raise
        # Maps of generators and of files need no program.


_tell_extension()
