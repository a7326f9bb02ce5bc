"""Elementary functions with the same bits on every machine, for planners whose flights must repeat elsewhere.
Python's `math` uses the machine's C library, whose last bits differ. `math.sqrt` and the four operations are the same
everywhere."""

import ctypes
from collections.abc import Callable
from pathlib import Path
from typing import Any

_PACKAGE = Path(__file__).parent.absolute()  # not resolved: a build tree has this file by a link
# Beside the program's copy of this package; from the package itself in a build tree, and where pip installed it.
_FOLDERS = (
    _PACKAGE.parent,
    _PACKAGE.parent.parent / "share/avoidbench/python",
    _PACKAGE / "program/share/avoidbench/python",
)


def _library() -> ctypes.CDLL:
    for folder in _FOLDERS:
        file = folder / "libportable_math.so"
        if file.is_file():
            return ctypes.CDLL(str(file))
    raise ImportError(f"libportable_math.so, which is built with avoidbench, is not in {', '.join(map(str, _FOLDERS))}")


def _function(name: str, arguments: int = 1) -> Any:
    function = _LIBRARY[f"portable_{name}"]
    function.restype = ctypes.c_double
    function.argtypes = [ctypes.c_double] * arguments
    return function


_LIBRARY = _library()
_OfOne = Callable[[float], float]
sin: _OfOne = _function("sin")
cos: _OfOne = _function("cos")
tan: _OfOne = _function("tan")
asin: _OfOne = _function("asin")
acos: _OfOne = _function("acos")
atan: _OfOne = _function("atan")
exp: _OfOne = _function("exp")
log: _OfOne = _function("log")
atan2: Callable[[float, float], float] = _function("atan2", 2)

__all__ = ["acos", "asin", "atan", "atan2", "cos", "exp", "log", "sin", "tan"]
