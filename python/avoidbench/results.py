"""Results of sweeps, read from their database."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, SupportsIndex

import pandas as pd

from avoidbench import stored_flight, tables
from avoidbench.comparison import Comparison, compare_files
from avoidbench.database_file import (
    ResultsError,
    SweepChoice,
    all_sweeps,
    chosen_sweeps,
    opened,
    state_of,
    trial_key_of,
)
from avoidbench.notebook import summary_html
from avoidbench.program import ProgramError, run_program
from avoidbench.report_data import read_report


class Text(str):
    """A text that a prompt or notebook shows as it is, with its lines."""

    def __repr__(self) -> str:
        return str(self)


def _listed(words: Sequence[str] | str) -> str:
    return words if isinstance(words, str) else ",".join(words)


def _each(words: Sequence[str] | str) -> list[str]:
    return [words] if isinstance(words, str) else list(words)


def _counted(count: int, word: str) -> str:
    return f"{count} {word}" if count == 1 else f"{count} {word}s"


class Results:
    """The results in one database of `avoidbench run`.

    Everything is read on access, so that results of a running sweep appear. The file is never
    written to. Column names include units; the world frame is ENU, z up, in metres. Undefined
    values are NaN, such as a metric of finished flights for a flight that failed.

    A file may hold several sweeps, and revisions of a sweep whose file was changed. `sweep()`
    chooses one; the default is the latest revision of every sweep.
    """

    def __init__(self, path: str | os.PathLike[str], sweep: str | None = None, revision: int | None = None) -> None:
        """See read(), which is the usual way, and sweep()."""
        self._given = os.fspath(path)
        self._path = Path(path).absolute()
        self._sweep = sweep
        self._revision = revision
        self._known_trials: tuple[object, pd.DataFrame] | None = None
        with opened(self._path) as connection:
            chosen_sweeps(connection, self._path, sweep, revision)

    @property
    def path(self) -> Path:
        """The database, as an absolute path."""
        return self._path

    @property
    def choice(self) -> str:
        """The sweep that is chosen, NAME or NAME@REVISION; "" for the latest revisions of all."""
        if self._sweep is None:
            return ""
        return self._sweep if self._revision is None else f"{self._sweep}@{self._revision}"

    def sweep(self, name: str, revision: int | None = None) -> Results:
        """The results of one sweep, in this revision (default: the latest).

        Raises:
            ResultsError: there is no such sweep or revision.
        """
        return Results(self._given, name, revision)

    def _choice_argument(self) -> list[str]:
        return [f"--sweep={self.choice}"] if self._sweep is not None else []

    @property
    def trials(self) -> pd.DataFrame:
        """The trials, a row each, as `avoidbench export trials` has them, numbers to the last bit.

        Sweep, planner (its label), map, mission with start and goal, outcome and reason, all metrics
        (`metrics` explains them), versions, trial_id (of this file) and trial_key, and a column for
        each field that the sweep varies, by its path: "map.poisson_radius_m", "planner.horizon_m". Lists are
        given as text. Empty if no trial has finished yet.

        Raises:
            ResultsError: a trial of the file is not what was stored.
        """
        state = state_of(self._path)
        if self._known_trials is None or self._known_trials[0] != state:
            with opened(self._path) as connection:
                self._known_trials = (state, tables.read_trials(connection, self._path, self._choices(connection)))
        return self._known_trials[1].copy()

    def _report_arguments(
        self,
        metrics: Sequence[str] | str | None,
        metrics_from: Sequence[str | os.PathLike[str]] | str | os.PathLike[str],
        group_by: Sequence[str] | str,
        where: Sequence[str] | str,
    ) -> list[str]:
        files = [metrics_from] if isinstance(metrics_from, (str, os.PathLike)) else metrics_from
        arguments = ["report", str(self._path), *self._choice_argument()]
        arguments += [f"--metrics={_listed(metrics)}"] if metrics else []
        arguments += [f"--metrics-from={os.fspath(file)}" for file in files if os.fspath(file)]
        arguments += [f"--group-by={_listed(group_by)}"] if group_by else []
        arguments += [f"--where={condition}" for condition in _each(where) if condition]
        return arguments

    def report(
        self,
        format: str = "table",
        *,
        everything: bool = False,
        only: Sequence[str] | str = (),
        metrics: Sequence[str] | str | None = None,
        metrics_from: Sequence[str | os.PathLike[str]] | str | os.PathLike[str] = (),
        group_by: Sequence[str] | str = (),
        where: Sequence[str] | str = (),
    ) -> Text:
        """The report of `avoidbench report`, as text.

        Args:
            format: table, csv, json, markdown or latex.
            everything: every table and warning, and what each column means.
            only: names of the tables to show.
            metrics: names of the metrics to show.
            metrics_from: files with custom metrics, FILE.sql or FILE.py.
            group_by: columns to group trials by, such as "map.poisson_radius_m".
            where: conditions that must all hold, such as "planner = ego, reactive".

        Raises:
            ProgramError: no trial has finished, or an argument is wrong.
        """
        arguments = self._report_arguments(metrics, metrics_from, group_by, where)
        arguments += ["--all"] if everything else []
        arguments += [f"--tables={_listed(only)}"] if only else []
        return Text(run_program([*arguments, f"--format={format}"]).text)

    def table(
        self,
        name: str = "planners",
        *,
        metrics: Sequence[str] | str | None = None,
        metrics_from: Sequence[str | os.PathLike[str]] | str | os.PathLike[str] = (),
        group_by: Sequence[str] | str = (),
        where: Sequence[str] | str = (),
    ) -> pd.DataFrame:
        """One table of the report, with the program's numbers: rates and means with the ends of their
        intervals (success_rate, success_rate_lower, success_rate_upper, …). Each row belongs to one `sweep`.

        Args:
            name: speed, speed_curve, planners, groups, outcomes, pairs, difficulty, flight_time, flight_time_curve,
                maps, environment, or with `group_by` grouped.
            metrics, metrics_from, group_by, where: as for report().

        Raises:
            ProgramError: no trial has finished, or an argument is wrong.
            ResultsError: the report has no such table.
        """
        arguments = self._report_arguments(metrics, metrics_from, group_by, where)
        sweeps = read_report(arguments)
        known = sorted({table for sweep in sweeps for table in sweep["tables"]})
        if name not in known:
            raise ResultsError(f"the report has no table {name}; there are: {', '.join(known)}")
        return tables.report_frame(
            [{"sweep": sweep["sweep"], **row} for sweep in sweeps for row in sweep["tables"].get(name, [])]
        )

    def compare(
        self,
        new: Results | str | os.PathLike[str],
        *,
        exact: bool = False,
        complete: bool = False,
        planner: str | None = None,
        metrics: Sequence[str] | str | None = None,
        alpha: float | None = None,
        min_effect: str | float | None = None,
        tolerances: str | os.PathLike[str] | None = None,
        gate_measured: bool = False,
    ) -> Comparison:
        """Compares new results with these, the base, and reports significant regressions.

        Args:
            new: results, a database, or a table of trials that `compare --bless` wrote.
            exact: no statistics: outcomes, flights and deterministic metrics must be equal to the last bit,
                and no trial may be missing.
            complete: missing trials fail the comparison too.
            planner: only this planner, by its label, or BASE:NEW.
            metrics: in addition to the success rate, or "all".
            alpha: chance of any false alarm in the comparison (0.01).
            min_effect: smallest change that matters, "5%" or a share of the base's mean (0.05).
            tolerances: YAML file with the smallest change by metric.
            gate_measured: metrics measured with the host's clock can fail the comparison too.

        Raises:
            ProgramError: there is nothing to compare, or an argument is wrong.
        """
        if isinstance(new, Results):
            file, theirs = str(new.path), new.choice
        else:
            file, theirs = os.fspath(new), ""
        sweep = None
        if self.choice or theirs:
            # A sweep that only one side chose is the latest revision of the same name on the other.
            name = (self.choice or theirs).split("@")[0]
            sweep = f"{self.choice or name}:{theirs or name}"
        return compare_files(
            str(self._path),
            file,
            sweep=sweep,
            planner=planner,
            exact=exact,
            complete=complete,
            gate_measured=gate_measured,
            metrics=metrics,
            alpha=alpha,
            min_effect=min_effect,
            tolerances=tolerances,
        )

    # What the file holds.

    def _choices(self, connection: Any) -> list[SweepChoice]:
        return chosen_sweeps(connection, self._path, self._sweep, self._revision)

    @property
    def sweeps(self) -> pd.DataFrame:
        """Every revision of every sweep of the file: sweep, revision, is_latest, trial_count (finished
        ones), mission_count (that it asks for, of all maps) and spec_json, with all defaults."""
        with opened(self._path) as connection:
            return tables.read_sweeps(connection)

    @property
    def maps(self) -> pd.DataFrame:
        """The maps of the chosen sweeps, a row each, with their measures (m and 1/m²) and the fields that the
        sweeps vary, by path."""
        with opened(self._path) as connection:
            return tables.read_maps(connection, self._path, self._choices(connection))

    @property
    def missions(self) -> pd.DataFrame:
        """The missions of the chosen sweeps, a row each: start and goal in the world frame, length of
        the shortest path, whether it can be flown (is_valid, invalid_reason)."""
        with opened(self._path) as connection:
            return tables.read_missions(connection, self._choices(connection))

    @property
    def metrics(self) -> pd.DataFrame:
        """The metrics of trials that the file holds: name, unit, better (less, more, neither),
        population (all or finished trials), version, is_measured (with the host's clock), doc, formula,
        source."""
        with opened(self._path) as connection:
            return tables.read_metrics(connection)

    def _read_flight(
        self, trial: str | SupportsIndex, read_one: Callable[[Any, Path, str], pd.DataFrame]
    ) -> pd.DataFrame:
        with opened(self._path) as connection:
            return read_one(connection, self._path, trial_key_of(connection, self._path, trial))

    def trajectory(self, trial: str | SupportsIndex) -> pd.DataFrame:
        """The flown path of a trial: a row a sample, the columns of `avoidbench export trajectory`.

        time_s is simulated; x_m … az_mps2 are position, velocity and acceleration in the world frame
        (ENU, z up); qw … qz turns coordinates of the body (forward, left, up) into those of the world,
        yaw_rad is their heading; rate_…_body_radps are body rates; reference_… is the commanded position
        in the world frame (NaN: none); rotor_power_w; clearance_m from the body's box to the nearest
        surface. No rows if the planner crashed before it flew.

        Args:
            trial: its trial_key or the beginning of it (a str), or its trial_id (an int).

        Raises:
            ResultsError: there is no such trial, or several, or what is stored is damaged.
        """
        return self._read_flight(trial, stored_flight.read_trajectory)

    def calls(self, trial: str | SupportsIndex) -> pd.DataFrame:
        """The planner's calls in a trial: call_index, simulated time_s, status (command, no_plan, gave_up,
        error), command_kind (None: no command), cpu_time_s and wall_time_s as the host measured them, and
        latency_s after which the command acted, if that was measured (NaN: as the sweep says).

        Arguments and errors are those of trajectory().
        """
        return self._read_flight(trial, stored_flight.read_calls)

    def events(self, trial: str | SupportsIndex) -> pd.DataFrame:
        """The contacts with surfaces in a trial: event_index, kind (collision), simulated time_s, speed_mps,
        obstacle_index (-1: ground, walls and others that are not obstacles) and obstacle_kind.

        Arguments and errors are those of trajectory().
        """
        return self._read_flight(trial, stored_flight.read_events)

    def _counts(self) -> str:
        with opened(self._path) as connection:
            choices = self._choices(connection)
            parts = []
            for choice in choices:
                trials, planners, maps = connection.execute(
                    "SELECT count(*), count(DISTINCT t.planner_key), count(DISTINCT t.map_key) FROM "
                    "sweep_trials s JOIN trials t USING (trial_key) WHERE s.sweep = ? AND s.revision = ?",
                    choice,
                ).fetchone()
                several = sum(other.sweep == choice.sweep for other in all_sweeps(connection)) > 1
                name = str(choice) if several else choice.sweep
                parts.append(
                    f"{name}: {_counted(trials, 'trial')} of {_counted(planners, 'planner')} on {_counted(maps, 'map')}"
                )
        return "; ".join(parts) or "no sweep yet"

    def __repr__(self) -> str:
        try:
            return f"<Results {self._given}: {self._counts()}>"
        except (ResultsError, OSError) as error:
            return f"<Results {self._given}: {error}>"

    def _repr_html_(self) -> str:
        """For notebooks: a table by planner, with the rates and intervals of the program's report."""
        try:
            sweeps = read_report(self._report_arguments(None, (), (), ()), warns=False)
            return summary_html(self._given, sweeps, self.metrics)
        except (ProgramError, ResultsError, OSError) as error:
            return summary_html(self._given, [], None, str(error))


def read(path: str | os.PathLike[str]) -> Results:
    """The results in a database of `avoidbench run`, such as results/quick.db. Nothing is written to it.

    Raises:
        FileNotFoundError: there is no such file.
        ResultsError: it is not a database of avoidbench, is of a newer version, or is damaged.
    """
    return Results(path)
