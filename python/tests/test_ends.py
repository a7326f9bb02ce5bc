"""Processes whose threads fly until they end: each ends as if it had none."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

MADE = """
import threading, time, sys
import numpy as np
import avoidbench
from avoidbench.env import AvoidbenchVectorEnv
from flights import SMALL
env = AvoidbenchVectorEnv(SMALL, 2, threads=2, observe=["depth", "goal"])
env.reset(seed=1)
"""
# What a daemon thread does at Python's end.
WORK = {
    "steps": "env.step(np.zeros((2, 4)))",
    "steps and goes on after errors": "\n    try: env.step(np.zeros((2, 4)))\n    except Exception: pass",
    "makes environments": "AvoidbenchVectorEnv(SMALL, 2, threads=2).reset(seed=1)",
    "sees": 'avoidbench.make_world("hall").depth(np.tile(np.eye(4), (20, 1, 1)))',
}


def run(text: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", text], cwd=Path(__file__).parent, capture_output=True, text=True, timeout=60, check=False
    )


@pytest.mark.parametrize("work", WORK)
def test_python_ends_with_a_thread_inside(work: str) -> None:
    thread = f"\ndef work():\n  while True:\n    {WORK[work].strip()}\nthreading.Thread(target=work, daemon=True).start()\ntime.sleep(0.3)\n"
    for _ in range(3):
        done = run(MADE + thread)
        assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(("end", "code"), [("raise KeyboardInterrupt", -2), ("sys.exit(7)", 7)])
def test_the_exit_code_is_that_of_the_main_thread(end: str, code: int) -> None:
    thread = "threading.Thread(target=lambda: [env.step(np.zeros((2, 4))) for _ in range(10**6)], daemon=True).start()\ntime.sleep(0.2)\n"
    assert run(MADE + thread + end).returncode == code


def test_a_fork_ends_while_a_thread_of_its_parent_flies() -> None:
    text = """
import os
threading.Thread(target=lambda: [env.step(np.zeros((2, 4))) for _ in range(10**6)], daemon=True).start()
for _ in range(5):
    time.sleep(0.02)
    child = os.fork()
    if child == 0:
        sys.exit(3)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 3
"""
    done = run(MADE + text)
    assert (done.returncode, done.stderr) == (0, "")


def test_actions_that_another_thread_writes_to_are_checked_as_they_are_flown() -> None:
    text = """
actions = np.zeros((2, 4))
def write():
    while True:
        actions[:] = np.nan
        actions[:] = 0
threading.Thread(target=write, daemon=True).start()
for _ in range(1000):
    try:
        env.step(actions)
    except avoidbench.InputError as error:
        assert "not finite" in str(error)
"""
    done = run(MADE + text)
    assert (done.returncode, done.stderr) == (0, "")
