"""Opens a database of results for reading, and finds sweeps and trials in it."""

from __future__ import annotations

import contextlib
import operator
import os
import re
import sqlite3
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple, SupportsIndex

# Of lib/bench/store/schema.sql.
APPLICATION_ID = 1635140206
SCHEMA_VERSION = 1

_LOCK_TIMEOUT_S = 10.0
_LEAST_SQLITE = (3, 37, 0)  # reads STRICT tables
_LEAST_KEY_DIGITS = 4
_SHOWN_KEY_DIGITS = 12


class ResultsError(ValueError):
    """A file without readable results, or a sweep or trial that it does not have."""


class SweepChoice(NamedTuple):
    """One revision of a sweep."""

    sweep: str
    revision: int

    def __str__(self) -> str:
        return f"{self.sweep}@{self.revision}"


def damaged(path: Path, table: str, key: str, what: str) -> ResultsError:
    return ResultsError(f"{path}: damaged: table {table}, row {key[:_SHOWN_KEY_DIGITS]}: {what}")


def _connect(path: Path) -> sqlite3.Connection:
    """A connection that can't write. Without a folder for SQLite's files beside a database of a
    run that was killed, and no such files there, the file is read alone, as the program does."""
    uri = path.as_uri() + "?mode=ro"
    connection = sqlite3.connect(uri, uri=True, timeout=_LOCK_TIMEOUT_S, isolation_level=None)
    try:
        connection.execute("SELECT count(*) FROM sqlite_schema").fetchone()
    except sqlite3.OperationalError as error:
        connection.close()
        is_unopened = any(word in str(error) for word in ("unable to open", "readonly"))
        if not is_unopened or Path(f"{path}-wal").exists():
            raise
        return sqlite3.connect(uri + "&immutable=1", uri=True, isolation_level=None)
    except sqlite3.Error:
        connection.close()
        raise
    return connection


def _check_log(path: Path) -> None:
    """Refuses the log of another file, which SQLite would take by its name. The program compares more of the two; here
    it is enough that a file which ended well has no log: SQLite deletes it before it writes 1 there."""
    log = Path(f"{path}-wal")
    if not log.exists() or log.stat().st_size == 0:
        return
    with path.open("rb") as file:
        header = file.read(20)
    if header[18:20] == b"\x01\x01" and log.exists():
        raise ResultsError(
            f"{path}: next to it is {log.name}, the log of another file of that name, from a run that was "
            f"killed: move it away if {path.name} is the file that you want"
        )


def _check_identity(connection: sqlite3.Connection, path: Path) -> None:
    objects, application, version = connection.execute(
        "SELECT (SELECT count(*) FROM sqlite_schema), (SELECT application_id FROM "
        "pragma_application_id), (SELECT user_version FROM pragma_user_version)"
    ).fetchone()
    if objects == 0:
        raise ResultsError(f"{path}: an empty file: it holds no results")
    if application != APPLICATION_ID:
        raise ResultsError(f"{path}: not a database of avoidbench, but of another program")
    if version != SCHEMA_VERSION:
        newer = "use the newer avoidbench that made it, or " if version > SCHEMA_VERSION else ""
        raise ResultsError(
            f"{path}: its schema version (PRAGMA user_version) is {version}; this avoidbench "
            f"reads version {SCHEMA_VERSION}: {newer}fly its sweep again into another file"
        )


@contextlib.contextmanager
def opened(path: Path) -> Iterator[sqlite3.Connection]:
    """The database, for reading only, as a consistent snapshot even while a run writes to it.

    Raises:
        FileNotFoundError: there is no such file.
        ResultsError: it is not a database of avoidbench, is of a newer version, or is damaged.
    """
    if not path.exists():
        raise FileNotFoundError(f"{path}: no such file")
    if not path.is_file():
        raise ResultsError(f"{path}: not a file, but a folder or the like")
    if sqlite3.sqlite_version_info < _LEAST_SQLITE:
        raise ResultsError(
            f"this Python has SQLite {sqlite3.sqlite_version}, which can't read tables of avoidbench: "
            "3.37 or newer is needed"
        )
    _check_log(path)
    connection: sqlite3.Connection | None = None
    try:
        connection = _connect(path)
        connection.execute("PRAGMA trusted_schema = OFF")
        connection.execute("BEGIN")
        _check_identity(connection, path)
        yield connection
    except sqlite3.Error as error:
        if "not a database" in str(error):
            raise ResultsError(f"{path}: not a database of avoidbench: it is not an SQLite file") from error
        raise ResultsError(f"{path}: can't be read: {error}") from error
    finally:
        if connection is not None:
            connection.close()


def state_of(path: Path) -> tuple[tuple[int, int, int], ...]:
    """Differs when the file's contents may have changed: inode, size and time of it and its log."""
    states = []
    for file in (path, Path(f"{path}-wal")):
        with contextlib.suppress(FileNotFoundError):
            found = os.stat(file)
            states.append((found.st_ino, found.st_size, found.st_mtime_ns))
    return tuple(states)


def all_sweeps(connection: sqlite3.Connection) -> list[SweepChoice]:
    """Every revision of every sweep, by name and revision."""
    rows = connection.execute("SELECT sweep, revision FROM sweeps ORDER BY sweep, revision")
    return [SweepChoice(*row) for row in rows]


def chosen_sweeps(
    connection: sqlite3.Connection, path: Path, sweep: str | None, revision: int | None
) -> list[SweepChoice]:
    """The chosen revision; default: the latest, and without a name that of every sweep.

    Raises:
        ResultsError: there is none of this name or number.
    """
    known = all_sweeps(connection)
    latest = {choice.sweep: choice for choice in known}
    if sweep is None:
        return list(latest.values())
    if sweep not in latest:
        raise ResultsError(f"{path}: no sweep {sweep}; there are: {', '.join(latest) or 'none'}")
    if revision is None:
        return [latest[sweep]]
    if SweepChoice(sweep, revision) not in known:
        numbers = ", ".join(str(choice.revision) for choice in known if choice.sweep == sweep)
        raise ResultsError(f"{path}: sweep {sweep} has no revision {revision}; there are: {numbers}")
    return [SweepChoice(sweep, revision)]


def trial_key_of(connection: sqlite3.Connection, path: Path, trial: str | SupportsIndex) -> str:
    """The key of one trial, given by the beginning of its key, or as a number by its trial_id.

    Raises:
        ResultsError: there is none, or more than one.
    """
    if not isinstance(trial, str):
        found = connection.execute("SELECT trial_key FROM trials WHERE rowid = ?", (operator.index(trial),)).fetchone()
        if found is None:
            raise ResultsError(f"{path}: no trial with trial_id {trial}")
        return str(found[0])
    if not re.fullmatch(f"[0-9a-f]{{{_LEAST_KEY_DIGITS},64}}", trial):
        raise ResultsError(
            f"{trial!r} is not a trial: name it by the first {_LEAST_KEY_DIGITS} "
            "or more digits of its trial_key (a str), or by its trial_id (an int)"
        )
    keys = [
        str(row[0])
        for row in connection.execute(
            "SELECT trial_key FROM trials WHERE trial_key >= ? AND trial_key < ? ORDER BY trial_key LIMIT 4",
            (trial, trial + "g"),
        )
    ]
    if not keys:
        raise ResultsError(f"{path}: no trial whose key begins with {trial!r}")
    if len(keys) > 1:
        shown = ", ".join(key[: max(_SHOWN_KEY_DIGITS, len(trial) + 4)] for key in keys[:3])
        raise ResultsError(
            f"{path}: several trials have a key that begins with {trial!r}: {shown}" + (", …" if len(keys) > 3 else "")
        )
    return keys[0]
