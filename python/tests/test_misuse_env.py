"""Whatever is done to an environment ends in an exception that says what is wrong: none ends the process or hangs."""

from __future__ import annotations

import copy
import gc
import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import avoidbench
import gymnasium
import numpy as np
import pytest
from avoidbench.env import AvoidbenchEnv, AvoidbenchVectorEnv, InputError
from flights import ONE, SMALL, changed
from gymnasium.vector import AsyncVectorEnv

STILL = np.zeros((2, 4))


def vector(**options: Any) -> AvoidbenchVectorEnv:
    return AvoidbenchVectorEnv(
        options.pop("sweep", SMALL), **{"num_envs": 2, "threads": 2, "observe": ["goal"], **options}
    )


def single(**options: Any) -> AvoidbenchEnv:
    return AvoidbenchEnv(options.pop("sweep", SMALL), **{"observe": ["goal"], **options})


@pytest.mark.parametrize(
    ("actions", "error", "text"),
    [
        (np.zeros(4), ValueError, r"actions: expected an array of shape \(2, 4\), got \(4,\)"),
        (np.zeros((2, 5)), ValueError, r"got \(2, 5\)"),
        (np.zeros((0, 4)), ValueError, r"got \(0, 4\)"),
        (np.zeros((2, 4, 1)), ValueError, r"got \(2, 4, 1\)"),
        ([[1, 2], [3]], ValueError, r"actions: expected an array of shape \(2, 4\)"),
        (np.zeros((2, 4), object), TypeError, "got object"),
        (np.zeros((2, 4), complex), TypeError, "got complex128"),
        (np.zeros((2, 4), bool), TypeError, "got bool"),
        (np.full((2, 4), "1"), TypeError, "got <U1"),
        (np.zeros((2, 4), "datetime64[s]"), TypeError, "got datetime64"),
        ("up", TypeError, "expected real numbers"),
        (None, TypeError, "got object"),
        ([[np.nan] * 4] * 2, InputError, "slot 0: number 0 of the action is not finite"),
        ([[0] * 4, [0, 0, 0, -np.inf]], InputError, "slot 1: number 3 of the action is not finite"),
        ([[0] * 4, [0, 0, 0, 1e5]], InputError, r"slot 1: number 3 of the action is 1e\+05, beyond ±9e\+04"),
        ([[0] * 4, [0, 1e7, 0, 0]], InputError, r"slot 1: number 1 of the action is 1e\+07, beyond"),
        (np.full((2, 4), np.finfo(np.float64).max), InputError, "beyond"),
        (np.full((2, 4), np.finfo(np.longdouble).max), InputError, "not finite"),
    ],
)
@pytest.mark.filterwarnings("ignore:overflow encountered in cast")
def test_actions_that_are_none_are_refused_and_nothing_is_flown(
    actions: Any, error: type[Exception], text: str
) -> None:
    env = vector(observe=["pose"], copy=False)
    seen, _ = env.reset(seed=1)
    before = seen["pose"].copy()
    with pytest.raises(error, match=text):
        env.step(actions)
    assert np.array_equal(seen["pose"], before)
    env.step(STILL)


def test_actions_of_one_flight_are_told_by_their_name() -> None:
    env = single()
    env.reset()
    for action, error, text in (
        (np.zeros(3), ValueError, r"action: expected an array of shape \(4,\), got \(3,\)"),
        ([[1, 2], [3]], ValueError, "action: expected an array"),
        ("up", TypeError, "action: expected real numbers"),
        (np.zeros((1, 4)), ValueError, r"got \(1, 4\)"),
    ):
        with pytest.raises(error, match=text):
            env.step(action)


@pytest.mark.parametrize("dtype", ["f2", "f4", ">f8", "i1", "u8", "i8", "g"])
@pytest.mark.parametrize("layout", ["C", "F", "strided"])
def test_numbers_of_any_kind_and_layout_are_the_same_action(dtype: str, layout: str) -> None:
    plain = vector(sweep=ONE, observe=["pose"])
    plain.reset(seed=1)
    wanted = [plain.step([[1, 0, 1, 0], [2, 1, 0, 0]])[0]["pose"] for _ in range(5)][-1]
    actions = np.zeros((4, 8), dtype)[::2, ::2] if layout == "strided" else np.zeros((2, 4), dtype, order=layout)  # type: ignore[call-overload]
    actions[:] = [[1, 0, 1, 0], [2, 1, 0, 0]]
    actions.flags.writeable = False
    env = vector(sweep=ONE, observe=["pose"])
    env.reset(seed=1)
    assert np.array_equal([env.step(actions)[0]["pose"] for _ in range(5)][-1], wanted)


@pytest.mark.parametrize("action", ["velocity", "acceleration", "rates_thrust", "trajectory"])
def test_the_greatest_actions_are_flown_to_an_end(action: str) -> None:
    env = vector(sweep=ONE, action=action, observe=["state", "goal", "pose", "imu"])
    env.reset(seed=1)
    random = np.random.default_rng(1)
    for _ in range(70):
        actions = 1e6 * random.choice([-1.0, 0.0, 1.0], env.action_space.shape)
        if action != "rates_thrust":
            actions[:, 3::4] *= 0.09  # yaws and their rates
        seen, rewards, *_ = env.step(actions)
        assert all(np.isfinite(array).all() for array in seen.values()) and np.isfinite(rewards).all()


@pytest.mark.parametrize("points", [1, 1000])
def test_the_shortest_trajectories_are_flown(points: int) -> None:
    env = vector(sweep=ONE, action="trajectory", trajectory_points=points, trajectory_horizon_s=0.01)
    env.reset(seed=1)
    for number in (0.0, 0.001, -1.0, 9e4):
        env.step(np.full(env.action_space.shape, number))


def test_a_closed_environment_says_so() -> None:
    env, one = vector(), single(observe=["depth"], render_mode="rgb_array")
    for closed in (env, one):
        closed.reset()
        closed.close()
        closed.close()
        for call in (closed.reset, lambda closed=closed: closed.step(STILL)):
            with pytest.raises(gymnasium.error.ClosedEnvironmentError, match="closed: make another one"):
                call()
    with pytest.raises(gymnasium.error.ClosedEnvironmentError):
        one.render()
    assert env.observation_space.sample() and one.action_space.sample() is not None and repr(env) and str(one)


def test_steps_at_the_wrong_time() -> None:
    env, one = vector(autoreset_mode="Disabled"), single(sweep=ONE)
    for begun in (env, one):
        with pytest.raises(InputError, match=r"slot 0: call reset\(\) before step\(\)"):
            begun.step(STILL[0] if begun is one else STILL)
    with pytest.raises(InputError, match="slot 1: call reset"):
        env.reset(options={"reset_mask": np.array([True, False])})
        env.step(STILL)
    one.reset()
    while not one.step(STILL[0])[3]:
        pass
    with pytest.raises(InputError, match="its episode has ended"):
        one.step(STILL[0])
    one.reset()
    one.step(STILL[0])


@pytest.mark.parametrize(
    ("arguments", "error", "text"),
    [
        ({"seed": -1}, ValueError, "seed: expected .* got -1"),
        ({"seed": 2**64}, ValueError, "seed"),
        ({"seed": 1.0}, TypeError, "seed: expected a whole number"),
        ({"seed": "1"}, TypeError, "seed"),
        ({"options": {"mask": 1}}, ValueError, "'mask' is not an option"),
    ],
)
def test_resets_that_are_none(arguments: dict[str, Any], error: type[Exception], text: str) -> None:
    for env in (vector(), single()):
        with pytest.raises(error, match=text):
            env.reset(**arguments)


@pytest.mark.parametrize("mask", [np.ones(2), [1, 0], np.ones(3, bool), np.zeros(2, bool), "ab", [[True, True]], 1])
def test_masks_that_are_none(mask: Any) -> None:
    env = vector(autoreset_mode="Disabled")
    env.reset()
    with pytest.raises(ValueError, match="reset_mask"):
        env.reset(options={"reset_mask": mask})
    with pytest.raises(InputError, match="a seed applies to all slots"):
        env.reset(seed=1, options={"reset_mask": np.array([True, False])})
    with pytest.raises(TypeError, match="one number for all slots"):
        env.reset(seed=[1, 2])
    env.step(STILL)


@pytest.mark.parametrize(
    ("arguments", "error", "text"),
    [
        ({"observe": ["deph"]}, ValueError, "observe: 'deph' is not one of .*did you mean depth"),
        ({"observe": "depth"}, TypeError, "observe: expected a list of names"),
        ({"observe": []}, ValueError, "at least one"),
        ({"observe": ["goal", "goal"]}, ValueError, "each only once"),
        ({"observe": [3]}, ValueError, "observe: 3"),
        ({"observe": None}, TypeError, "iterable"),
        ({"action": "velocty"}, InputError, "did you mean velocity"),
        ({"action": 3}, TypeError, "action: expected a word"),
        ({"frame": "wrld"}, InputError, "did you mean world"),
        ({"order": "inturn"}, InputError, "did you mean in_turn"),
        ({"depth": "invers"}, InputError, "did you mean inverse"),
        ({"policy": "a\0"}, ValueError, "byte 0"),
        ({"policy": "\udcff"}, ValueError, "UTF-8"),
        ({"kept_maps": 0}, ValueError, "kept_maps: expected .* got 0"),
        ({"seed": -1}, ValueError, "seed: expected .* got -1"),
        ({"trajectory_points": 0}, ValueError, "trajectory_points: expected .* got 0"),
        ({"trajectory_points": 10**30}, ValueError, "trajectory_points"),
        ({"trajectory_horizon_s": 0}, InputError, "horizon"),
        ({"trajectory_horizon_s": 1e-300}, InputError, "horizon"),
        ({"trajectory_horizon_s": float("nan")}, ValueError, "not finite"),
        ({"trajectory_horizon_s": "1"}, TypeError, "expected a number"),
        ({"reward": 3}, TypeError, "reward: expected a Reward"),
        ({"reward": avoidbench.env.Reward(crash=float("inf"))}, ValueError, "reward.crash: inf is not finite"),
        ({"reward": avoidbench.env.Reward(goal="1")}, TypeError, "reward.goal"),  # type: ignore[arg-type]
        ({"render_mode": "human"}, ValueError, "render_mode"),
        ({"set": {"trials": 0}}, InputError, "trials"),
        ({"set": {"no_such": 1}}, InputError, "no_such"),
        ({"set": {"latency.mode": "measured"}}, InputError, "latency.mode"),
        ({"sweep": None}, TypeError, "sweep: expected a file"),
        ({"sweep": b"x"}, TypeError, "got bytes"),
        ({"sweep": ""}, InputError, "no built-in sweep"),
        ({"sweep": "no/such.yaml"}, InputError, "no/such.yaml"),
        ({"sweep": {}}, InputError, "the sweep"),
        ({"sweep": {**SMALL, "trails": 3}}, InputError, r"^the sweep: trails: .*did you mean trials"),
        ({"sweep": {**SMALL, 3: 3}}, TypeError, "expected text as a key"),
        ({"sweep": changed(SMALL, sensor={"min_range_m": 0}), "observe": ["depth"]}, InputError, "min_range_m"),
        ({"sweep": {**SMALL, "axes": {"sensor.width_px": [16, 20]}}}, InputError, "one shape"),
    ],
)
def test_environments_that_can_not_be_are_refused(arguments: dict[str, Any], error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=text):
        single(**arguments)
    with pytest.raises(error, match=text):
        vector(**arguments)


@pytest.mark.parametrize(
    ("count", "error"), [(0, ValueError), (-1, ValueError), (10**9, ValueError), (2.0, TypeError), ("2", TypeError)]
)
def test_numbers_of_slots_and_threads_that_can_not_be(count: Any, error: type[Exception]) -> None:
    with pytest.raises(error, match="num_envs"):
        vector(num_envs=count)
    with pytest.raises(error, match="threads"):
        vector(threads=count)


def test_a_wrong_file_is_told_with_its_places(tmp_path: Path) -> None:
    file = tmp_path / "wrong.yaml"
    file.write_text("sweep: a\nplanners: [straight_line]\nmaps:\n  generator: hall\n  seeds: [1]\n  heigth_m: 5\n")
    for make in (single, vector):
        with pytest.raises(InputError, match=rf"{file}:6:3: .*heigth_m"):
            make(sweep=file)


@pytest.mark.parametrize("make", [gymnasium.make, gymnasium.make_vec])
def test_a_wrong_keyword_of_make_is_told(make: Callable[..., Any]) -> None:
    with pytest.raises(TypeError, match="obsrve"):
        make("avoidbench/Hall-v0", obsrve=["goal"])
    with pytest.raises(TypeError, match="sweep"):
        make("avoidbench/Sweep-v0")


def test_copies_and_pickles_are_refused() -> None:
    for env in (vector(), single()):
        for call in (pickle.dumps, copy.deepcopy):
            with pytest.raises(TypeError, match="make another one with the same arguments"):
                call(env)


@pytest.mark.parametrize(
    ("given", "error", "text"),
    [
        (
            lambda *_: np.zeros(3),
            ValueError,
            r"reward: expected an array of shape \(2,\) from the function, got \(3,\)",
        ),
        (lambda *_: 0.0, ValueError, r"from the function, got \(\)"),
        (lambda *_: [0.0, float("nan")], ValueError, "gave nan, which is not finite"),
        (lambda *_: [0.0, float("inf")], ValueError, "gave inf"),
        (lambda *_: [1j, 0], TypeError, "got complex128"),
        (lambda *_: None, TypeError, "got object"),
        (lambda *_: "ab", TypeError, "got <U2"),
        (lambda *_: 1 / 0, ZeroDivisionError, "division"),
        (lambda: 0, TypeError, "arguments"),
    ],
)
def test_reward_functions_that_fail(given: Any, error: type[Exception], text: str) -> None:
    env = vector(reward=given)
    env.reset(seed=1)
    for _ in range(2):
        with pytest.raises(error, match=text):
            env.step(STILL)
    env.reset(seed=1)


def test_two_environments_in_one_process_do_not_meet() -> None:
    alone = vector(sweep=ONE, observe=["pose"])
    alone.reset(seed=1)
    wanted = [alone.step(STILL + 1.0)[0]["pose"] for _ in range(40)]
    one, other = vector(sweep=ONE, observe=["pose"]), vector(sweep=SMALL, threads=1)
    one.reset(seed=1)
    other.reset(seed=2)
    for step in range(40):
        other.step(STILL - 1.0)
        assert np.array_equal(one.step(STILL + 1.0)[0]["pose"], wanted[step])


def test_threads_that_step_one_environment_are_told_or_wait() -> None:
    env = vector(sweep=SMALL, num_envs=16, observe=["depth", "goal"])
    env.reset(seed=1)
    done, refused, other = [0], [0], []

    def use(number: int) -> None:
        for turn in range(60):
            try:
                if (turn + number) % 20 == 0:
                    env.reset(seed=turn)
                else:
                    env.step(np.zeros((16, 4)))
                done[0] += 1
            except RuntimeError as error:
                assert "one thread at a time" in str(error)
                refused[0] += 1
            except BaseException as error:
                other.append(error)

    threads = [threading.Thread(target=use, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
        assert not thread.is_alive()
    assert not other and done[0] > 0 and refused[0] > 0 and done[0] + refused[0] == 240
    env.reset()
    env.step(np.zeros((16, 4)))


def test_closing_while_another_thread_steps() -> None:
    env = vector(num_envs=64, observe=["depth"])
    env.reset(seed=1)
    raised: list[BaseException] = []

    def use() -> None:
        try:
            while True:
                env.step(np.zeros((64, 4)))
        except BaseException as error:
            raised.append(error)

    thread = threading.Thread(target=use)
    thread.start()
    time.sleep(0.2)
    env.close()
    thread.join(60)
    assert not thread.is_alive() and isinstance(raised[0], gymnasium.error.ClosedEnvironmentError)


def outcome_of(
    script: str, *arguments: str, timeout_s: float = 100.0, signal_after: str | None = None
) -> tuple[int, str]:
    """Exit status and output of a Python that runs `script`. With `signal_after` a SIGINT comes when it has printed
    this line."""
    # Of a fork beside threads Python warns from 3.12 on; that is what is tried here.
    command = [sys.executable, "-X", "faulthandler", "-W", "ignore::DeprecationWarning", "-c", script, *arguments]
    process = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    try:
        if signal_after is not None:
            assert process.stdout is not None
            for line in process.stdout:
                if line.strip() == signal_after:
                    break
            time.sleep(0.3)
            process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=timeout_s)
    finally:
        process.kill()
        process.wait()
    return process.returncode, output


FORK = """
import gc, os, sys, avoidbench
import numpy as np
from flights import SMALL
from avoidbench.env import AvoidbenchVectorEnv
env = AvoidbenchVectorEnv(SMALL, 4, threads=2, observe=["depth"])
env.reset(seed=1)
child = os.fork()
if child == 0:
    for call in (lambda: env.step(np.zeros((4, 4))), env.reset):
        try:
            call()
            print("flown", flush=True)
        except avoidbench.InputError as error:
            print("told" if "another process" in str(error) else error, flush=True)
    {end}
    own = AvoidbenchVectorEnv(SMALL, 4, threads=2, observe=["depth"])
    own.reset(seed=1)
    own.step(np.zeros((4, 4)))
    print("own", flush=True)
    sys.exit(0)
status = os.waitpid(child, 0)[1]
env.step(np.zeros((4, 4)))
print("parent", os.waitstatus_to_exitcode(status))
"""


@pytest.mark.parametrize("end", ["env.close()", "del env; gc.collect()", "pass"])
def test_a_forked_process_is_told_and_can_make_its_own(end: str) -> None:
    status, output = outcome_of(FORK.replace("{end}", end))
    assert (status, output.split("\n")[:4]) == (0, ["told", "told", "own", "parent 0"]), output


def steps_of_a_child(queue: Any) -> None:
    env = AvoidbenchVectorEnv(SMALL, 2, threads=2, observe=["pose"])
    env.reset(seed=1)
    queue.put(env.step(STILL + 1.0)[0]["pose"])


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
@pytest.mark.filterwarnings("ignore:.*multi-threaded, use of fork.*:DeprecationWarning")
def test_multiprocessing(method: str) -> None:
    env = AvoidbenchVectorEnv(SMALL, 2, threads=2, observe=["pose"])
    env.reset(seed=1)
    context = multiprocessing.get_context(method)
    queue = context.Queue()
    process = context.Process(target=steps_of_a_child, args=(queue,))
    process.start()
    assert np.array_equal(queue.get(timeout=100), env.step(STILL + 1.0)[0]["pose"])
    process.join(100)
    assert process.exitcode == 0


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_gymnasiums_vector_of_processes(method: str) -> None:
    env = AsyncVectorEnv([single, single], context=method)
    observation, _ = env.reset(seed=1)
    assert env.observation_space.contains(observation)
    for _ in range(5):
        env.step(STILL.astype(np.float32))
    env.close()


INTERRUPTED = """
import json, sys, time
import numpy as np
from avoidbench.env import AvoidbenchVectorEnv
env = AvoidbenchVectorEnv(json.loads(sys.argv[1]), int(sys.argv[2]), threads=int(sys.argv[3]), observe=["depth"])
began = None
def step():
    env.step(np.zeros((env.num_envs, 4)))
if sys.argv[4] == "step":
    env.reset(seed=1)
print("go", flush=True)
try:
    while True:
        began = time.monotonic()
        step() if sys.argv[4] == "step" else env.reset(seed=1)
except KeyboardInterrupt:
    print("interrupted", flush=True)
try:
    step()
    print("goes on")
except ValueError as error:
    print(str(error).split(": ")[1])
small = AvoidbenchVectorEnv(json.loads(sys.argv[5]), 2, threads=2, observe=["goal"])
small.reset()
if sys.argv[4] == "step":
    env.reset(seed=1)
    step()
print("usable", flush=True)
"""


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("call", ["step", "reset"])
def test_control_c_ends_long_calls_soon(call: str, threads: int) -> None:
    if call == "step":  # a step takes a second
        sweep, slots = changed(SMALL, sensor={"width_px": 640, "height_px": 480}), 32
    else:  # a reset takes minutes, for maps of a second each
        sweep, slots = changed(SMALL, maps={"area_m": [40, 40], "seeds": list(range(1, 400))}), 400
    began = time.monotonic()
    status, output = outcome_of(
        INTERRUPTED, json.dumps(sweep), str(slots), str(threads), call, json.dumps(SMALL), signal_after="go"
    )
    lines = output.split("\n")
    assert status == 0 and lines[0] == "interrupted" and lines[2] == "usable", output
    assert lines[1] in ("call reset() before step()", "goes on"), output
    assert time.monotonic() - began < 60.0


NO_MISSION = """
import json, sys
from avoidbench.env import AvoidbenchEnv
env = AvoidbenchEnv(json.loads(sys.argv[1]), observe=["goal"], kept_maps=1)
print("go", flush=True)
try:
    env.reset()
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


def test_a_search_for_a_mission_is_interrupted() -> None:
    # Nowhere are 1.95 m free around a start; each of a thousand tries makes a map.
    sweep = changed(
        SMALL, maps={"seeds": list(range(1, 100)), "poisson_radius_m": 2.0}, mission={"free_radius_m": 1.95}
    )
    status, output = outcome_of(NO_MISSION, json.dumps(sweep), signal_after="go", timeout_s=60)
    assert (status, output) == (0, "interrupted\n")


def test_a_handler_of_signals_may_not_step_what_is_being_stepped() -> None:
    env = vector(
        sweep=changed(SMALL, sensor={"width_px": 320, "height_px": 240}), num_envs=64, threads=1, observe=["depth"]
    )
    env.reset(seed=1)
    told: list[str] = []

    def handler(*_: object) -> None:
        try:
            env.step(np.zeros((64, 4)))
        except RuntimeError as error:
            told.append(str(error))

    before = signal.signal(signal.SIGUSR1, handler)
    try:
        timer = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGUSR1))
        timer.start()
        deadline = time.monotonic() + 60
        while not told and time.monotonic() < deadline:
            env.step(np.zeros((64, 4)))
            if not timer.is_alive() and not told:
                timer = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGUSR1))
                timer.start()
        timer.join()
    finally:
        signal.signal(signal.SIGUSR1, before)
    assert told and "one thread at a time" in told[0]
    env.step(np.zeros((64, 4)))


def test_environments_that_are_never_closed_end_with_the_process() -> None:
    script = (
        "from flights import SMALL\nfrom avoidbench.env import *\n"
        "kept = [AvoidbenchVectorEnv(SMALL, 3, threads=2) for _ in range(5)]\n"
        "[env.reset() for env in kept]\nkept.append(kept)\n"
    )
    assert outcome_of(script) == (0, "")


def test_what_can_not_be_made_leaves_nothing_behind() -> None:
    gc.collect()
    before = len(os.listdir("/proc/self/task"))
    for _ in range(20):
        with pytest.raises(InputError):
            vector(set={"latency.mode": "measured"})
    gc.collect()
    assert len(os.listdir("/proc/self/task")) <= before
