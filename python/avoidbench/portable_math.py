"""Elementary functions with the same bits on every machine: for planners whose flights are to repeat elsewhere.
Python's `math` asks the machine's C library, whose last bits differ. `math.sqrt` and the four operations are the same
everywhere."""

import os
from importlib.util import find_spec

if "AVOIDBENCH_PLANNER_FDS" not in os.environ and find_spec("avoidbench._core") is not None:
    from avoidbench import _core

    sin, cos, tan = _core.portable_sin, _core.portable_cos, _core.portable_tan
    asin, acos = _core.portable_asin, _core.portable_acos
    atan, atan2 = _core.portable_atan, _core.portable_atan2
    exp, log = _core.portable_exp, _core.portable_log
else:  # the same bits, more slowly
    from avoidbench._python_math import acos, asin, atan, atan2, cos, exp, log, sin, tan

__all__ = ["acos", "asin", "atan", "atan2", "cos", "exp", "log", "sin", "tan"]
