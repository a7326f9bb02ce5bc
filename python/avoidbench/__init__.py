"""Flies sweeps with avoidbench and reads their results."""

from avoidbench.comparison import Comparison
from avoidbench.database_file import ResultsError
from avoidbench.program import ProgramError
from avoidbench.results import Results, read
from avoidbench.sweep_run import run

__all__ = ["Comparison", "ProgramError", "Results", "ResultsError", "read", "run"]
