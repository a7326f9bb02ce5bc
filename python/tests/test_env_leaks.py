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


def check_flat(work: Callable[[], None], warm_up: int, count: int, limit_mib: float) -> None:
    """`count` times more of it let the process grow by less than the limit, at the third try at the
    latest: a leak grows each time, the allocator now and then, since how many arenas threads share
    depends on when they run."""
    for _ in range(warm_up):
        work()
    grown_mib = []
    for _ in range(3):
        before = memory_mib()
        for _ in range(count):
            work()
        grown_mib.append(memory_mib() - before)
        if grown_mib[-1] < limit_mib:
            return
    raise AssertionError(f"memory grew by {grown_mib} MiB, each of at least {limit_mib}")


def test_resets(is_long: bool) -> None:
    env = AvoidbenchEnv(ONE, observe=["depth", "goal"])
    check_flat(env.reset, 200, 10_000 if is_long else 1500, 4.0)


def test_resets_of_vectors_that_make_maps_again(is_long: bool) -> None:
    env = AvoidbenchVectorEnv(changed(SMALL, maps={"seeds": list(range(1, 9))}), 4, threads=2, kept_maps=2)
    check_flat(env.reset, 20, 200 if is_long else 40, 12.0)


def test_steps_and_ends(is_long: bool) -> None:
    env = AvoidbenchVectorEnv(ONE, 4, threads=2, autoreset_mode="SameStep")
    env.reset()
    check_flat(lambda: env.step(np.zeros((4, 4))), 300, 20_000 if is_long else 2000, 4.0)


def test_environments_that_are_made_and_closed(is_long: bool) -> None:
    def make_and_close() -> None:
        env = AvoidbenchVectorEnv(ONE, 3, threads=3, observe=["depth"])
        env.reset()
        env.step(np.zeros((3, 4)))
        env.close()

    make_and_close()
    threads = thread_count()
    check_flat(make_and_close, 20, 200 if is_long else 60, 6.0)
    assert thread_count() <= threads


def test_environments_that_are_refused() -> None:
    def refuse() -> None:
        try:
            AvoidbenchVectorEnv(ONE, 3, threads=3, action="none")
        except ValueError:
            return
        raise AssertionError("this was made")

    threads = thread_count()
    check_flat(refuse, 50, 500, 3.0)
    assert thread_count() <= threads
