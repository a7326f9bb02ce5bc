"""What read() gives is compared with the program's own exports, number by number."""

from __future__ import annotations

import contextlib
import csv
import hashlib
import io
import json
import math
import re
import runpy
import shutil
import sqlite3
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import avoidbench
import numpy as np
import pandas as pd
import pytest
from avoidbench import database_file
from conftest import TINY, Program, fly

redigest = runpy.run_path(str(Path(__file__).parents[2] / "tests/support/redigest.py"))["redigest"]


@contextlib.contextmanager
def edited(path: Path) -> Iterator[sqlite3.Connection]:
    """To be written to; SQLite's own context manager commits and does not close."""
    with contextlib.closing(sqlite3.connect(path)) as database, database:
        yield database


def is_same(ours: Any, theirs: Any) -> bool:
    """Whether a cell is what the program wrote, to the last bit; its null and empty fields are NaN or None."""
    if theirs is None or theirs == "":
        return ours is None or ours == "" or (isinstance(ours, float) and math.isnan(ours))
    if isinstance(theirs, str) and not isinstance(ours, str):
        return float(ours) == float(theirs)
    return bool(ours == theirs)


def assert_same(ours: pd.DataFrame, theirs: list[dict[str, Any]], but: tuple[str, ...] = ()) -> None:
    assert len(theirs) > 0
    assert len(ours) == len(theirs)
    assert [name for name in ours.columns if name not in but] == [name for name in theirs[0] if name not in but]
    for (_, row), their in zip(ours.iterrows(), theirs):
        for name, value in their.items():
            assert name in but or is_same(row[name], value), (name, row[name], value)


def rows_of_csv(data: bytes) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(data.decode(), newline="")))


def rows_of_jsonl(data: bytes) -> list[dict[str, Any]]:
    return [json.loads(line) for line in data.decode().split("\n") if line]


@pytest.fixture()
def tiny(tiny_db: Path) -> avoidbench.Results:
    return avoidbench.read(tiny_db)


@pytest.fixture()
def odd(odd_db: Path) -> avoidbench.Results:
    return avoidbench.read(odd_db)


@pytest.fixture()
def copy_db(tiny_db: Path, tmp_path: Path) -> Path:
    return Path(shutil.copy(tiny_db, tmp_path / "copy.db"))


def test_trials_are_those_of_the_programs_export(tiny: avoidbench.Results, program: Program) -> None:
    assert_same(tiny.trials, rows_of_jsonl(program("export", "trials", tiny.path, "--format", "jsonl")))
    assert_same(tiny.trials, rows_of_csv(program("export", "trials", tiny.path)))
    assert tiny.trials["is_finished"].dtype == bool
    assert tiny.trials["map_seed"].dtype == np.uint64
    assert tiny.trials["collision_speed_mps"].dtype == np.float64


def test_causes_are_texts(copy_db: Path, program: Program) -> None:
    assert set(avoidbench.read(copy_db).trials["cause"]) == {""}, "none is told"
    program("explain", copy_db)
    results = avoidbench.read(copy_db)
    assert_same(results.trials, rows_of_csv(program("export", "trials", copy_db)))
    failed = ~results.trials["is_finished"]
    assert failed.any() and all(results.trials.loc[failed, "cause"] != "")
    assert set(results.trials.loc[~failed, "cause"]) <= {""}
    with edited(copy_db) as database:
        database.execute("UPDATE explanations SET cause = 'tracking' || cause")
    with pytest.raises(avoidbench.ResultsError, match="table explanations, row .*row_digest"):
        _ = avoidbench.read(copy_db).trials


def test_trials_of_axes_revisions_and_odd_labels(odd: avoidbench.Results, program: Program) -> None:
    for chosen, name in (
        (odd, ""),
        (odd.sweep("odd"), "odd"),
        (odd.sweep("odd", 1), "odd@1"),
        (odd.sweep("odd", 2), "odd@2"),
        (odd.sweep("other"), "other"),
    ):
        options = ["--sweep", name] if name else []
        theirs = rows_of_jsonl(program("export", "trials", odd.path, "--format", "jsonl", *options))
        assert_same(chosen.trials, theirs)
    first = odd.sweep("odd", 1).trials
    assert len(first) == 4
    assert set(first["map_seed"]) == {2**64 - 1}
    assert set(first["planner"]) == {"=a+b"}
    assert first["vehicle.mass_kg"].dtype == np.float64
    assert set(first["wind.mean_world_mps"]) == {"[0.0,0.0,0.0]", "[4.0,0.0,0.0]"}
    assert len(odd.sweep("odd").trials) == 1


def test_trials_of_planners_with_several_parameters(tmp_path: Path, program: Program) -> None:
    planners = [{"plugin": "reactive", "label": f"h{h}", "parameters": {"lookahead_m": h}} for h in (3.0, 5.0)]
    sweep = {
        **TINY,
        "trials": 1,
        "planners": planners,
        "axes": {"latency.mode": ["fixed", "zero"], "mission.return_to_start": [True, False]},
    }
    results = fly(sweep, tmp_path / "varied.db")
    assert_same(results.trials, rows_of_jsonl(program("export", "trials", results.path, "--format", "jsonl")))
    assert set(results.trials["planner.lookahead_m"]) == {3.0, 5.0}
    assert set(results.trials["latency.mode"]) == {"fixed", "zero"}
    assert set(results.trials["mission.return_to_start"]) == {0, 1}


def test_a_changed_table_does_not_change_the_next_one(tiny: avoidbench.Results) -> None:
    trials = tiny.trials
    trials["path_length_m"] = 0.0
    assert (tiny.trials["path_length_m"] > 0.0).all()


def test_trajectories_are_those_of_the_programs_export(tiny: avoidbench.Results, program: Program) -> None:
    for key, identity in zip(tiny.trials["trial_key"], tiny.trials["trial_id"]):
        ours = tiny.trajectory(key)
        theirs = rows_of_csv(program("export", "trajectory", tiny.path, key))
        assert_same(ours, theirs, but=("yaw_rad",))
        yaw_rad = [float(row["yaw_rad"]) for row in theirs]
        np.testing.assert_allclose(ours["yaw_rad"], yaw_rad, rtol=0, atol=1e-15)
        assert ours.equals(tiny.trajectory(key[:9])) and ours.equals(tiny.trajectory(identity))
        assert all(dtype == np.float64 for dtype in ours.dtypes)


def test_calls_are_those_of_the_programs_export(
    tiny: avoidbench.Results, odd: avoidbench.Results, program: Program
) -> None:
    for results in (tiny, odd):
        for key in results.trials["trial_key"]:
            assert_same(
                results.calls(key).drop(columns="latency_s"), rows_of_csv(program("export", "calls", results.path, key))
            )
    assert tiny.calls(1)["latency_s"].isna().all()


def test_measured_latency_is_that_of_the_view(odd: avoidbench.Results) -> None:
    key = odd.sweep("odd").trials["trial_key"][0]
    with edited(odd.path) as database:
        theirs = [
            row[0]
            for row in database.execute(
                "SELECT latency_s FROM plan_call_table WHERE trial_key = ? ORDER BY call_index", (key,)
            )
        ]
    assert list(odd.calls(key)["latency_s"]) == theirs
    assert min(theirs) >= 0.0


def test_events_are_those_stored(tiny: avoidbench.Results) -> None:
    assert tiny.trials["collision_count"].sum() == 2
    for _, trial in tiny.trials.iterrows():
        events = tiny.events(trial["trial_key"])
        assert len(events) == trial["collision_count"]
        if len(events) > 0:
            assert events["speed_mps"][0] == trial["collision_speed_mps"]
            assert f"{events['obstacle_kind'][0]} {events['obstacle_index'][0]}" in trial["reason"]
            assert events["time_s"][0] == trial["end_time_s"]


def test_maps_and_missions_are_those_of_the_trials_and_the_report(
    tiny: avoidbench.Results, odd: avoidbench.Results
) -> None:
    shared = [
        "traversability",
        "traversability_normalized_ratio",
        "relative_gap_size",
        "obstacle_density_1pm2",
        "map_seed",
        "generator",
    ]
    places = [f"{end}_{axis}_m" for end in ("start", "goal") for axis in "xyz"] + ["reference_length_m"]
    for results in (tiny, odd.sweep("odd"), odd.sweep("other")):
        trials = results.trials
        maps = results.maps.set_index("map_key")
        varied = [name for name in trials.columns if name.startswith("map.")]
        missions = results.missions.set_index(["map_key", "mission_index"])
        assert set(maps.index) == set(trials["map_key"])
        for _, trial in trials.iterrows():
            assert all(maps.loc[trial["map_key"], name] == trial[name] for name in shared + varied)
            mission = missions.loc[(trial["map_key"], trial["mission_index"])]
            assert all(mission[name] == trial[name] for name in places)
            assert mission["is_valid"]
        reported = results.table("maps")
        assert list(reported["traversability"]) == list(results.maps["traversability"])
    assert odd.maps["map_seed"].max() == 2**64 - 1


def test_metrics_are_those_that_the_program_defines(tiny: avoidbench.Results, program: Program) -> None:
    theirs = {row["name"]: row for row in json.loads(program("metrics", "--format", "json")) if row["of"] == "trial"}
    assert list(tiny.metrics["name"]) == list(theirs)
    for _, metric in tiny.metrics.iterrows():
        for name in ("unit", "better", "version", "doc", "formula", "source"):
            # The program adds to what is measured that it is.
            assert theirs[metric["name"]][name] in (metric[name], f"{metric[name]} Measured: differs from run to run.")
    assert set(tiny.metrics["name"]) <= set(tiny.trials.columns)


def test_sweeps(odd: avoidbench.Results) -> None:
    sweeps = odd.sweeps
    assert [
        tuple(row) for row in sweeps[["sweep", "revision", "is_latest", "trial_count", "mission_count"]].values
    ] == [("odd", 1, False, 4, 1), ("odd", 2, True, 1, 1), ("other", 1, True, 1, 1)]
    assert [len(json.loads(spec)["axes"]) for spec in sweeps["spec_json"]] == [2, 1, 0]
    assert odd.sweep("odd", 1).choice == "odd@1"
    assert "odd@2: 1 trial of 1 planner on 1 map; other: 1 trial" in repr(odd)


def test_reports_are_the_programs_own(tiny: avoidbench.Results, odd: avoidbench.Results, program: Program) -> None:
    for format in ("table", "csv", "json", "markdown", "latex"):
        assert tiny.report(format) == program("report", tiny.path, "--format", format).decode()
    assert tiny.report(everything=True) == program("report", tiny.path, "--all").decode()
    assert (
        tiny.report(where="planner = reactive", only=["planners", "maps"], metrics=["path_length_m"])
        == program(
            "report",
            tiny.path,
            "--where",
            "planner = reactive",
            "--tables",
            "planners,maps",
            "--metrics",
            "path_length_m",
        ).decode()
    )
    assert odd.sweep("odd", 1).report() == program("report", odd.path, "--sweep", "odd@1").decode()
    assert repr(tiny.report()) == str(tiny.report())


def test_tables_have_the_numbers_of_the_report(
    tiny: avoidbench.Results, odd: avoidbench.Results, program: Program
) -> None:
    (report,) = json.loads(program("report", tiny.path, "--format", "json"))
    cells = rows_of_csv(program("report", tiny.path, "--format", "csv"))
    infinite = {(cell["table"], cell["planner"], cell["name"]) for cell in cells if cell["value"] == "inf"}
    # One planner never reached the goal: that is a time, not one that is not known.
    assert ("flight_time", "straight_line", "time_to_goal_25pct_s") in infinite
    for name, rows in report["tables"].items():
        for row in rows:
            row.update({key: math.inf for key in row if (name, row.get("planner"), key) in infinite})
        if rows:
            assert_same(tiny.table(name), [{"sweep": "tiny", **row} for row in rows])
    grouped = tiny.table("grouped", group_by=["planner", "outcome"], metrics="path_length_m")
    assert sorted(grouped["path_length_m"]) == sorted(tiny.trials.groupby("planner")["path_length_m"].mean())
    assert list(odd.table()["sweep"]) == ["odd", "other"]
    with pytest.raises(avoidbench.ResultsError, match="no table nonsense; there are: .*planners"):
        tiny.table("nonsense")


def test_infinite_means_are_infinite(copy_db: Path) -> None:
    with edited(copy_db) as database:
        database.execute("UPDATE trials SET min_clearance_m = 9e999 WHERE outcome = 'reached_goal'")
        redigest(database)
    results = avoidbench.read(copy_db)
    means = results.table(metrics=["path_length_m", "min_clearance_m"])
    assert list(means["min_clearance_m"]) == [math.inf, 0.0]
    assert list(means["path_length_m"]) == list(results.table(metrics="path_length_m")["path_length_m"])
    assert sorted(results.trials["min_clearance_m"]) == [0.0, 0.0, math.inf, math.inf]
    grouped = results.table("grouped", group_by=["planner", "outcome"], metrics="min_clearance_m")
    assert grouped.set_index("planner")["min_clearance_m"]["reactive"] == math.inf


def test_metrics_of_ones_own(tiny: avoidbench.Results, tmp_path: Path) -> None:
    file = tmp_path / "twice.sql"
    file.write_text(
        "-- twice_m: Twice the path [m]; less is better\n"
        "SELECT trial_key, 2 * path_length_m AS twice_m FROM trial_table\n"
    )
    means = tiny.table(metrics=["twice_m", "path_length_m"], metrics_from=file)
    assert list(means["twice_m"]) == list(2 * means["path_length_m"])


def test_notebooks_show_the_rates_of_the_report(tiny: avoidbench.Results, odd: avoidbench.Results) -> None:
    shown, text = tiny._repr_html_(), tiny.report()
    for rate in re.findall(r"\d\.\d\d \[\d\.\d\d, \d\.\d\d\]", text):
        assert rate in shown
    assert '<td style="text-align:left">reactive</td>' in shown
    assert "Sweep odd" in odd._repr_html_() and "Sweep other" in odd._repr_html_()
    assert repr(tiny) == f"<Results {tiny.path}: tiny: 4 trials of 2 planners on 1 map>"


def test_notebooks_get_no_markup_of_others(copy_db: Path) -> None:
    with edited(copy_db) as database:
        database.execute("UPDATE trials SET outcome = '<script>' WHERE rowid = 1")
    shown = avoidbench.read(copy_db)._repr_html_()
    assert "<script" not in shown and "damaged" in shown


def test_comparisons(
    tiny: avoidbench.Results, odd: avoidbench.Results, copy_db: Path, tmp_path: Path, program: Program
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        same = tiny.compare(copy_db)
        assert same.passed and str(same.text).startswith("No regression")
        theirs = json.loads(program("compare", tiny.path, copy_db, "--format", "json"))
        assert same.data == theirs
        assert_same(same.metrics, theirs["metrics"])
        exact = tiny.sweep("tiny", 1).compare(avoidbench.read(copy_db), exact=True)
        assert exact.passed and exact.differences.empty and exact.metrics.empty
        other = tiny.compare(copy_db, exact=True, planner="reactive:straight_line")
        assert not other.passed and len(other.differences) > 0
        table = tmp_path / "blessed.csv"
        program("compare", tiny.path, "--bless", table)
        assert tiny.sweep("tiny", 1).compare(table, exact=True, metrics="all").passed
        assert odd.sweep("odd", 1).compare(odd.sweep("odd", 2), min_effect=0.1, alpha=0.05).passed
        assert not odd.sweep("odd", 1).compare(odd.sweep("odd", 2), complete=True).passed
    with pytest.raises(avoidbench.ProgramError, match="which sweep"):
        tiny.compare(odd)


def test_files_that_are_no_results(tmp_path: Path, copy_db: Path) -> None:
    with pytest.raises(FileNotFoundError, match="nowhere.db: no such file"):
        avoidbench.read(tmp_path / "nowhere.db")
    with pytest.raises(avoidbench.ResultsError, match="folder"):
        avoidbench.read(tmp_path)
    text = tmp_path / "text.db"
    text.write_text("sweep: tiny\n" * 500)
    with pytest.raises(avoidbench.ResultsError, match="not an SQLite file"):
        avoidbench.read(text)
    empty = tmp_path / "empty.db"
    empty.touch()
    with pytest.raises(avoidbench.ResultsError, match="empty file"):
        avoidbench.read(empty)
    foreign = tmp_path / "foreign.db"
    with edited(foreign) as database:
        database.execute("CREATE TABLE trials (trial_key TEXT)")
    with pytest.raises(avoidbench.ResultsError, match="of another program"):
        avoidbench.read(foreign)
    with edited(copy_db) as database:
        database.execute(f"PRAGMA user_version = {database_file.SCHEMA_VERSION + 1}")
    with pytest.raises(avoidbench.ResultsError, match="use the newer avoidbench"):
        avoidbench.read(copy_db)


def test_the_schema_is_that_of_the_program() -> None:
    schema = Path(__file__).parents[2] / "lib" / "bench" / "store" / "schema.sql"
    if not schema.exists():
        pytest.skip("the package is tested apart from its repository")
    text = schema.read_text()
    assert f"PRAGMA application_id = {database_file.APPLICATION_ID};" in text
    assert f"PRAGMA user_version = {database_file.SCHEMA_VERSION};" in text


def test_trials_that_are_not_there(tiny: avoidbench.Results, odd: avoidbench.Results) -> None:
    key = tiny.trials["trial_key"][0]
    for wrong, message in (
        ("ffffffff", "no trial whose key begins with 'ffffffff'"),
        (key[:3], "is not a trial"),
        (key[:8] + "%", "is not a trial"),
        (key.upper(), "is not a trial"),
        ("", "is not a trial"),
        (99, "no trial with trial_id 99"),
    ):
        with pytest.raises(avoidbench.ResultsError, match=message):
            tiny.trajectory(wrong)
    with pytest.raises(avoidbench.ResultsError, match="no sweep nope; there are: odd, other"):
        odd.sweep("nope")
    with pytest.raises(avoidbench.ResultsError, match="no revision 3; there are: 1, 2"):
        odd.sweep("odd", 3)


def test_an_ambiguous_beginning(copy_db: Path) -> None:
    with edited(copy_db) as database:
        for rowid in (1, 2):
            database.execute(
                "UPDATE trials SET trial_key = 'abcdef' || ? || substr(trial_key, 8) WHERE rowid = ?", (rowid, rowid)
            )
    with pytest.raises(avoidbench.ResultsError, match="several trials have a key that begins with 'abcdef': abcdef1"):
        avoidbench.read(copy_db).events("abcdef")


@pytest.mark.parametrize(
    ("change", "read_it", "message"),
    [
        ("UPDATE trajectories SET samples = zeroblob(length(samples))", "trajectory", "unpacked"),
        ("UPDATE trajectories SET sample_count = sample_count - 1", "trajectory", "flight_digest"),
        ("UPDATE plan_calls SET calls_json = replace(calls_json, '[0.0,', '[0.25,')", "calls", "calls_digest"),
        ("UPDATE plan_calls SET calls_json = '[[1]]'", "calls", "no list of plan calls"),
        ("UPDATE events SET speed_mps = speed_mps + 1", "events", "flight_digest"),
        ("DELETE FROM events", "trajectory", "flight_digest"),
    ],
)
def test_damage_is_an_error(copy_db: Path, change: str, read_it: str, message: str) -> None:
    with edited(copy_db) as database:
        database.execute(change)
    with pytest.raises(avoidbench.ResultsError, match=f"damaged: table .*{message}"):
        getattr(avoidbench.read(copy_db), read_it)(1)


def test_a_changed_number_is_an_error(copy_db: Path) -> None:
    with edited(copy_db) as database:
        database.execute("UPDATE trials SET path_length_m = path_length_m + 1e-9 WHERE rowid = 1")
    with pytest.raises(avoidbench.ResultsError, match="table trials, row .*not those that were stored .row_digest"):
        _ = avoidbench.read(copy_db).trials


@pytest.mark.parametrize("version", [-1, 0])
def test_another_schema_version_is_an_error(copy_db: Path, version: int) -> None:
    with edited(copy_db) as database:
        database.execute(f"PRAGMA user_version = {version}")
    with pytest.raises(avoidbench.ResultsError, match=rf"its schema version \(PRAGMA user_version\) is {version}; "):
        avoidbench.read(copy_db)


@pytest.mark.parametrize("spec", ["{}}", "[]", '{"axes": [1]}', '{"planners": [{"parameters": [{}]}]}'])
def test_a_sweep_without_its_spec_is_an_error(copy_db: Path, spec: str) -> None:
    with edited(copy_db) as database:
        database.execute("UPDATE sweeps SET spec_json = ?", (spec,))
    for read_it in ("trials", "maps"):
        with pytest.raises(avoidbench.ResultsError, match="table sweeps: spec_json is not the spec of a sweep"):
            getattr(avoidbench.read(copy_db), read_it)


def test_a_digest_that_was_taken_out_is_an_error(copy_db: Path) -> None:
    with edited(copy_db) as database:
        database.execute("UPDATE trials SET row_digest = NULL, flight_digest = NULL")
    with pytest.raises(avoidbench.ResultsError, match="it has no row_digest"):
        _ = avoidbench.read(copy_db).trials
    with pytest.raises(avoidbench.ResultsError, match="flight_digest"):
        avoidbench.read(copy_db).trajectory(1)


def test_the_log_of_another_file_is_an_error(copy_db: Path) -> None:
    running = copy_db.with_name("running.db")
    with contextlib.closing(sqlite3.connect(running, isolation_level=None)) as other:
        other.execute("PRAGMA journal_mode = WAL")
        other.execute("CREATE TABLE t (x)")
        log = Path(f"{running}-wal").read_bytes()
    Path(f"{copy_db}-wal").write_bytes(log)
    before = copy_db.read_bytes()
    with pytest.raises(avoidbench.ResultsError, match="the log of another file"):
        avoidbench.read(copy_db)
    assert copy_db.read_bytes() == before


def test_reading_changes_no_byte(copy_db: Path) -> None:
    digest = hashlib.sha256(copy_db.read_bytes()).hexdigest()
    results = avoidbench.read(copy_db)
    for read_it in ("trials", "maps", "missions", "metrics", "sweeps"):
        assert len(getattr(results, read_it)) > 0
    for read_one in (results.trajectory, results.calls, results.events):
        read_one(1)
    results.report(), results.table(), results._repr_html_(), repr(results)
    assert hashlib.sha256(copy_db.read_bytes()).hexdigest() == digest
    assert [file.name for file in copy_db.parent.iterdir()] == [copy_db.name]


def test_a_writer_beside_readers(copy_db: Path) -> None:
    results = avoidbench.read(copy_db)
    before = results.trials
    writer = sqlite3.connect(copy_db, isolation_level=None)
    writer.execute("PRAGMA journal_mode = WAL")
    writer.execute("BEGIN IMMEDIATE")
    writer.execute("DELETE FROM sweep_trials WHERE trial_key = ?", (before["trial_key"][0],))
    assert results.trials.equals(before) and len(results.trajectory(1)) > 0
    writer.execute("COMMIT")
    assert len(results.trials) == len(before) - 1
    assert "3 trials" in repr(results)
    writer.close()


def test_a_file_that_goes_away(copy_db: Path) -> None:
    results = avoidbench.read(copy_db)
    copy_db.unlink()
    with pytest.raises(FileNotFoundError):
        _ = results.maps
    assert "no such file" in repr(results) and "no such file" in results._repr_html_()


def test_a_sweep_without_trials_yet(copy_db: Path) -> None:
    with edited(copy_db) as database:
        for table in ("sweep_trials", "trajectories", "plan_calls", "events", "trials"):
            database.execute(f"DELETE FROM {table}")
    results = avoidbench.read(copy_db)
    assert results.trials.empty and "path_length_m" in results.trials and len(results.missions) == 2
    assert "no finished trial" in results._repr_html_()
    with pytest.raises(avoidbench.ProgramError, match="no finished trial"):
        results.report()
