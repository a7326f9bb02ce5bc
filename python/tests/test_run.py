"""run(): what it flies, says and refuses, and how it is interrupted."""

from __future__ import annotations

import contextlib
import json
import os
import pickle
import re
import signal
import sqlite3
import subprocess
import sys
import time
import warnings
from pathlib import Path

import avoidbench
import numpy as np
import pytest
from avoidbench import _location
from avoidbench.program import find_program
from conftest import TINY, fly

SHORT = {**TINY, "planners": ["straight_line"]}
LONG = {**TINY, "sweep": "long", "trials": 15, "planners": ["reactive"]}


def trial_count(database: Path) -> int:
    """How many trials a database has that a run may be writing; 0 where there is none yet."""
    with contextlib.suppress(sqlite3.Error):
        connection = sqlite3.connect(f"{database.as_uri()}?mode=ro", uri=True)
        with contextlib.closing(connection):
            return int(connection.execute("SELECT count(*) FROM trials").fetchone()[0])
    return 0


def test_the_version_is_the_programs() -> None:
    said = subprocess.run([find_program(), "--version"], check=True, capture_output=True, text=True).stdout
    assert said.split()[:2] == ["avoidbench", avoidbench.__version__]
    # A planner's process imports by itself only what planners need; all names are there all the same.
    code = "from avoidbench import *; print(__version__)"
    lean = {**os.environ, "AVOIDBENCH_PLANNER_FDS": "3,4"}
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True, env=lean).stdout
    assert printed.strip() == avoidbench.__version__


def test_a_file_and_its_dict_are_the_same_trials(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("short.yaml").write_text(json.dumps(SHORT))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        of_dict = avoidbench.run(SHORT, progress=False)
        assert of_dict.path == tmp_path / "results" / "tiny.db"
        assert of_dict.choice == "tiny@1" and len(of_dict.trials) == 2
        again = avoidbench.run("short.yaml", progress=False, jobs=1)
        of_file = avoidbench.run(Path("short.yaml"), progress=False, database="file.db", keep_planners=False)
    assert list(again.trials["attempt"]) == [1, 1]
    assert of_dict.compare(of_file, exact=True).passed
    assert not Path("file.planners").exists() and Path("results/tiny.planners").exists()


def test_overrides_and_revisions(tmp_path: Path) -> None:
    database = tmp_path / "a.db"
    first = fly(SHORT, database, set={"trials": np.int64(1), "maps.poisson_radius_m": 4.5})
    assert "map.poisson_radius_m" not in first.trials, "nothing varies it"
    second = fly(SHORT, database, set=["trials=1", "maps.poisson_radius_m=[4.5, 5.0]"])
    assert (first.choice, second.choice) == ("tiny@1", "tiny@2")
    assert len(first.trials) == 1 and sorted(second.trials["map.poisson_radius_m"]) == [4.5, 5.0]
    assert sorted(second.maps["map.poisson_radius_m"]) == [4.5, 5.0]
    assert not first.compare(second, complete=False, exact=True).passed
    # The former one again, which is not the latest: its own results, not those of the latest revision.
    former = fly(SHORT, database, set={"trials": 1, "maps.poisson_radius_m": 4.5})
    assert former.choice == "tiny@1" and len(former.trials) == 1
    other = fly({**SHORT, "sweep": "another", "trials": 1}, database, set={"sweep": "third"})
    assert other.choice == "third@1" and len(avoidbench.read(database).sweeps) == 3


def test_the_package_loads_without_pandas() -> None:
    script = (
        "import sys, avoidbench; assert 'pandas' not in sys.modules; from avoidbench import run; print(run.__name__)"
    )
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, check=True).stdout == b"run\n"


def test_a_shard(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        results = avoidbench.run(SHORT, progress=False, shard="1/2")
    assert results.path.name == "tiny.shard1of2.db" and results.choice == "tiny@1"


def test_what_is_wrong_has_its_place(tmp_path: Path) -> None:
    file = tmp_path / "bad.yaml"
    file.write_text("sweep: bad\nplanners:\n  - straight_lin\nmaps: {generator: hall, height: 4}\n")
    with pytest.raises(avoidbench.ProgramError) as caught:
        avoidbench.run(file, progress=False)
    assert re.search(rf"^{re.escape(str(file))}:3:5: .*did you mean straight_line", str(caught.value), re.MULTILINE)
    assert re.search(r"bad\.yaml:4:25: maps\.height: ", str(caught.value))
    assert caught.value.exit_code == 2 and caught.value.command[1] == "run"
    copied = pickle.loads(pickle.dumps(caught.value))
    assert (str(copied), copied.exit_code) == (str(caught.value), 2)
    with pytest.raises(avoidbench.ProgramError, match=r"^the sweep: trials: -1 is outside"):
        avoidbench.run({**SHORT, "trials": -1}, progress=False, database=tmp_path / "x.db")
    with pytest.raises(avoidbench.ProgramError, match="no built-in sweep of this name; built in: .*quick"):
        avoidbench.run("nosuch", progress=False)
    with pytest.raises(avoidbench.ProgramError, match=r"maps\.foo: unknown key"):
        avoidbench.run("quick", set={"maps.foo": 2}, progress=False)
    with pytest.raises(avoidbench.ProgramError, match="--jobs"):
        avoidbench.run("quick", jobs=-1, progress=False)
    with pytest.raises(TypeError, match="can't be used in a sweep"):
        avoidbench.run({**SHORT, "seed": object()}, progress=False)
    with pytest.raises(ValueError, match="not JSON compliant"):
        avoidbench.run("quick", set={"trials": float("nan")}, progress=False)
    text = tmp_path / "text.db"
    text.write_text("no database\n" * 100)
    with pytest.raises(avoidbench.ProgramError, match="not a database"):
        avoidbench.run(SHORT, database=text, progress=False)
    assert not (tmp_path / "x.db").exists()


def test_the_bar_says_what_the_program_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.warns(UserWarning, match="2 trials per map: success rates"):
        avoidbench.run(SHORT, database=tmp_path / "a.db")
    out, err = capsys.readouterr()
    assert out == ""
    assert "2/2" in err and "goals: straight_line 0/2" in err
    assert "trials that did not reach the goal" in err and "warning: 2 trials" not in err
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        avoidbench.run(SHORT, database=tmp_path / "b.db", progress=False)
    assert capsys.readouterr() == ("", "")


def test_the_bar_obeys_no_label(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    planners = {"\x1b[2J": {"flown": 1, "reached_goal": 1}}
    progress = json.dumps({"done": 1, "done_before": 0, "total": 2, "planners": planners})
    fake = fake_program(tmp_path / "program", f"printf '%s\\n' '{progress}' >&2\nexit 9\n")
    monkeypatch.setenv("AVOIDBENCH_PROGRAM", str(fake))
    with pytest.raises(avoidbench.ProgramError):
        avoidbench.run(SHORT)
    err = capsys.readouterr().err
    assert r"goals: \x1b[2J 1/1" in err and "\x1b[2J" not in err and "1/2" in err


INTERRUPTED = """
import json, sys, warnings
import avoidbench
warnings.simplefilter("ignore")
try:
    avoidbench.run(json.loads(sys.argv[1]), database=sys.argv[2], jobs=1)
except KeyboardInterrupt as stop:
    print("interrupted:", stop)
"""


def children_of(parent: int) -> list[int]:
    # Not by `ps`, which hangs where the sanitizers' runtime is loaded before it.
    return [int(word) for file in Path(f"/proc/{parent}/task").glob("*/children") for word in file.read_text().split()]


@pytest.mark.parametrize("is_whole_group", [False, True], ids=["process", "terminal"])
def test_an_interrupt_keeps_what_was_flown(tmp_path: Path, is_whole_group: bool) -> None:
    """By a signal to Python alone (a notebook), and to all of a terminal's foreground group (Ctrl-C)."""
    database = tmp_path / "long.db"
    python = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, json.dumps(LONG), str(database)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    deadline_s = time.monotonic() + 120.0
    while trial_count(database) < 1:
        assert python.poll() is None and time.monotonic() < deadline_s
        time.sleep(0.05)
    programs = children_of(python.pid)
    assert len(programs) == 1
    if is_whole_group:
        os.killpg(python.pid, signal.SIGINT)
    else:
        python.send_signal(signal.SIGINT)
    out, err = python.communicate(timeout=60)
    assert python.returncode == 0, err
    assert "interrupted: stopped; finished trials are kept" in out
    assert "stopped; run the same command again to resume" in err and "ended at once" not in err
    assert not Path(f"/proc/{programs[0]}").exists()
    assert not Path(f"{database}-wal").exists()
    kept = avoidbench.read(database)
    # That which flew was finished and is there, whole; the rest is not.
    assert 1 <= len(kept.trials) < 15
    assert set(kept.trials["outcome"]) <= {"reached_goal", "collided", "timed_out"}
    assert all(len(kept.trajectory(key)) > 0 for key in kept.trials["trial_key"])


def test_a_second_interrupt_ends_at_once(tmp_path: Path) -> None:
    database = tmp_path / "long.db"
    python = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, json.dumps(LONG), str(database)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    while trial_count(database) < 1:
        assert python.poll() is None
        time.sleep(0.05)
    (program,) = children_of(python.pid)
    python.send_signal(signal.SIGINT)
    assert python.stderr is not None
    while "stopping: trials in flight" not in python.stderr.readline():
        assert python.poll() is None
    python.send_signal(signal.SIGINT)
    out, _ = python.communicate(timeout=60)
    assert python.returncode == 0 and "interrupted: stopped; finished trials are kept" in out
    assert not Path(f"/proc/{program}").exists()
    assert len(avoidbench.read(database).trials) >= 1


def test_results_are_read_while_a_run_writes(tmp_path: Path) -> None:
    database = tmp_path / "long.db"
    python = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, json.dumps(LONG), str(database)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        while trial_count(database) < 1:
            assert python.poll() is None
            time.sleep(0.05)
        results, counts = avoidbench.read(database), [0]
        while counts[-1] < 3:
            trials = results.trials
            counts.append(len(trials))
            for key, count in zip(trials["trial_key"], trials["plan_call_count"]):
                assert len(results.calls(key)) == count
                assert results.trajectory(key)["time_s"].is_monotonic_increasing
        assert counts == sorted(counts) and python.poll() is None
    finally:
        python.send_signal(signal.SIGINT)
        python.communicate(timeout=60)
    assert len(results.trials) >= counts[-1]


def fake_program(path: Path, script: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("#!/bin/sh\n" + script)
    path.chmod(0o755)
    return path


def test_where_the_program_is_looked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "build" / "python" / "avoidbench"
    package.mkdir(parents=True)
    monkeypatch.setattr(_location, "__file__", str(package / "_location.py"))
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    monkeypatch.delenv("AVOIDBENCH_PROGRAM", raising=False)
    with pytest.raises(avoidbench.ProgramError) as caught:
        find_program()
    for words in (
        "AVOIDBENCH_PROGRAM",
        str(package / "program/bin/avoidbench"),
        str(tmp_path / "build/avoidbench"),
        "on the PATH",
    ):
        assert words in str(caught.value)
    for place in (tmp_path / "bin", tmp_path / "build", package / "program" / "bin"):  # each before the one before it
        file = fake_program(place / "avoidbench", "exit 0\n")
        if place == tmp_path / "bin":  # a script there may be this package's own
            with pytest.raises(avoidbench.ProgramError):
                find_program()
            file.write_bytes(b"\x7fELF")
        assert find_program() == file
    own = fake_program(tmp_path / "own", "exit 0\n")
    monkeypatch.setenv("AVOIDBENCH_PROGRAM", str(own))
    assert find_program() == own
    own.chmod(0o644)
    with pytest.raises(avoidbench.ProgramError, match="AVOIDBENCH_PROGRAM=.*own: there is no executable program"):
        find_program()


@pytest.mark.parametrize(
    ("script", "message", "exit_code"),
    [
        ("kill -SEGV $$\n", "avoidbench run was ended by SIGSEGV", -signal.SIGSEGV),
        ("exit 7\n", "ended with exit code 7 and printed no message", 7),
        ("echo 'warning: w' >&2; echo 'it broke' >&2; exit 3\n", "^it broke$", 3),
        ("echo '{\"done\": 1}' >&2; exit 75\n", "done", 75),
        ("exit 0\n", "did not say where its results are", None),
    ],
)
def test_a_program_that_fails(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, script: str, message: str, exit_code: int | None
) -> None:
    monkeypatch.setenv("AVOIDBENCH_PROGRAM", str(fake_program(tmp_path / "program", script)))
    with pytest.raises(avoidbench.ProgramError, match=message) as caught:
        avoidbench.run(SHORT, progress=False)
    assert caught.value.exit_code == exit_code
