"""Memory and threads do not grow with resets, nor with environments that were made and closed."""

from __future__ import annotations

import ctypes
import gc
import os
from collections.abc import Callable

import numpy as np
from avoidbench.env import AvoidbenchEnv, AvoidbenchVectorEnv
from flights import ONE, SMALL, changed


def memory_mib() -> float:
    """What the process holds, once what is free was given back."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def thread_count() -> int:
    return len(os.listdir("/proc/self/task"))


def grown_mib(work: Callable[[], None], warm_up: int, count: int) -> float:
    """By how much `count` times more of it let the process grow."""
    for _ in range(warm_up):
        work()
    before = memory_mib()
    for _ in range(count):
        work()
    return memory_mib() - before


def test_resets(is_long: bool) -> None:
    env = AvoidbenchEnv(ONE, observe=["depth", "goal"])
    assert grown_mib(env.reset, 200, 10_000 if is_long else 1500) < 4.0


def test_resets_of_vectors_that_make_maps_again(is_long: bool) -> None:
    env = AvoidbenchVectorEnv(changed(SMALL, maps={"seeds": list(range(1, 9))}), 4, threads=2, kept_maps=2)
    assert grown_mib(env.reset, 20, 200 if is_long else 40) < 12.0


def test_steps_and_ends(is_long: bool) -> None:
    env = AvoidbenchVectorEnv(ONE, 4, threads=2, autoreset_mode="SameStep")
    env.reset()
    assert grown_mib(lambda: env.step(np.zeros((4, 4))), 300, 20_000 if is_long else 2000) < 4.0


def test_environments_that_are_made_and_closed(is_long: bool) -> None:
    def make_and_close() -> None:
        env = AvoidbenchVectorEnv(ONE, 3, threads=3, observe=["depth"])
        env.reset()
        env.step(np.zeros((3, 4)))
        env.close()

    make_and_close()
    threads = thread_count()
    assert grown_mib(make_and_close, 20, 200 if is_long else 60) < 6.0
    assert thread_count() <= threads


def test_environments_that_are_refused() -> None:
    def refuse() -> None:
        try:
            AvoidbenchVectorEnv(ONE, 3, threads=3, action="none")
        except ValueError:
            return
        raise AssertionError("this was made")

    threads = thread_count()
    assert grown_mib(refuse, 50, 500) < 3.0
    assert thread_count() <= threads
