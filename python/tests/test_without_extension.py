"""A folder of sources with Python, NumPy and pandas alone: results can be read, and the rest says what it lacks."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import avoidbench
import pandas as pd
import pytest
from avoidbench.program import find_program

SOURCES = Path(__file__).parent.parent
if not (SOURCES / "avoidbench").is_dir():
    pytest.skip("the package is tested apart from its repository", allow_module_level=True)

# As where neither is installed.
HIDING = """
import importlib.abc, sys

class Hiding(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name == "avoidbench._core" or name.split(".")[0] in {hidden}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Hiding())
import avoidbench
"""


def run_without(script: str, *arguments: object, hidden: Any = ("gymnasium", "tqdm"), program: str = "") -> str:
    """What a script prints that has neither the extension nor these modules, and only this program."""
    environment = {"PYTHONPATH": str(SOURCES), "PATH": "/nowhere", "PYTHONDONTWRITEBYTECODE": "1"}
    if program:
        environment["AVOIDBENCH_PROGRAM"] = program
    done = subprocess.run(
        [sys.executable, "-c", HIDING.format(hidden=set(hidden) or "()") + script, *map(str, arguments)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_results_are_read_without_extension_and_program(odd_db: Path, tmp_path: Path) -> None:
    script = """
results = avoidbench.read(sys.argv[1])
key = results.trials["trial_key"][0]
tables = [results.trials, results.sweep("odd", 1).trials, results.maps, results.missions, results.sweeps,
          results.metrics, results.trajectory(key), results.calls(key), results.events(key)]
for i, table in enumerate(tables):
    table.to_pickle(f"{sys.argv[2]}/{i}.pkl")
try:
    results.report()
except avoidbench.ProgramError as error:
    print(error)
print(results)
"""
    printed = run_without(script, odd_db, tmp_path)
    assert "the avoidbench program was not found: install it" in printed
    assert f"<Results {odd_db}: odd@2: 1 trial" in printed
    results = avoidbench.read(odd_db)
    key = results.trials["trial_key"][0]
    ours = [results.trials, results.sweep("odd", 1).trials, results.maps, results.missions, results.sweeps]
    ours += [results.metrics, results.trajectory(key), results.calls(key), results.events(key)]
    for i, table in enumerate(ours):
        pd.testing.assert_frame_equal(pd.read_pickle(tmp_path / f"{i}.pkl"), table, check_exact=True)


def test_what_the_program_computes_needs_no_extension(tiny_db: Path) -> None:
    script = """
import warnings
warnings.simplefilter("ignore")
results = avoidbench.read(sys.argv[1])
print(results.report(), end="")
print(results.compare(sys.argv[1]))
"""
    printed = run_without(script, tiny_db, program=str(find_program()))
    assert printed.startswith(avoidbench.read(tiny_db).report()) and "No regression" in printed


@pytest.mark.parametrize(
    "use",
    [
        "avoidbench.AvoidbenchEnv",
        "from avoidbench import AvoidbenchVectorEnv",
        "avoidbench.make_world('hall')",
        "avoidbench.World",
        "avoidbench.InputError",
        "avoidbench.__version__",
        "import avoidbench.env",
        "avoidbench.fly('quick', Mine)",
        "import gymnasium; gymnasium.make('avoidbench/Forest-v0')",
    ],
)
def test_what_needs_the_extension_says_so(use: str) -> None:
    script = f"""
class Mine(avoidbench.Planner):
    name = "mine"
try:
    {use}
except ImportError as error:
    print(error)
"""
    printed = run_without(script, hidden=())
    assert printed.startswith("this needs the extension avoidbench._core, which can't be imported (No module named")
    assert "pip install ." in printed and "cmake --build build/release --target python" in printed


def test_an_extension_of_another_python_is_named(tmp_path: Path) -> None:
    package = tmp_path / "avoidbench"
    package.mkdir()
    for file in (SOURCES / "avoidbench").glob("*.py"):
        (package / file.name).symlink_to(file)
    (package / "_core.cpython-399-x86_64-linux-gnu.so").touch()
    done = subprocess.run(
        [sys.executable, "-c", "import avoidbench; avoidbench.World"],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1
    assert "No module named 'avoidbench._core'; there is _core.cpython-399-x86_64-linux-gnu.so)" in done.stderr


def test_names_that_are_not_there_are_no_matter_of_the_extension() -> None:
    printed = run_without(
        "print(hasattr(avoidbench, 'nonsense'), 'AvoidbenchEnv' in dir(avoidbench), avoidbench.Planner)"
    )
    assert printed.startswith("False True <class 'avoidbench.planner.Planner'>")
