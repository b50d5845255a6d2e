"""The series of trials in the database of a server."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator

import msgspec

from skillc.contract.trials import SeriesState, TrialSeries, TrialsRequest
from skillc.services.tasks.assignments import write_call
from skillc_runtime.evaluation.trials.judging import judge_series
from skillc_runtime.evaluation.trials.series import Series
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.evaluation.trials.verdict import find_unmet_criteria

SERIES = """
CREATE TABLE trial_series (
    number  INTEGER PRIMARY KEY AUTOINCREMENT,
    id      TEXT NOT NULL UNIQUE,
    cell    TEXT NOT NULL,
    request BLOB NOT NULL,                     -- a TrialsRequest as JSON
    state   TEXT NOT NULL,                     -- a SeriesState
    reason  TEXT NOT NULL                      -- why it is in this state; empty if that is clear
)
"""
TRIALS = """
CREATE TABLE trials (
    series  TEXT NOT NULL,                     -- the id of a series
    seed    INTEGER NOT NULL,
    passed  INTEGER NOT NULL,                  -- whether all criteria are met
    trial   BLOB NOT NULL,                     -- a Trial as JSON
    PRIMARY KEY (series, seed)
)
"""
KEPT = 50
"""How many series that have ended are kept."""
COLUMNS = """
SELECT id, cell, request, state, reason, (SELECT count(*) FROM trials WHERE series = id),
    (SELECT coalesce(sum(passed), 0) FROM trials WHERE series = id) FROM trial_series
"""


class TrialStore:
    """The series of a server. What a method has changed is durable when it returns."""

    def __init__(self, database: sqlite3.Connection) -> None:
        """Note of the series that another process has not finished that they are interrupted."""
        self._database = database
        query = "UPDATE trial_series SET state = 'interrupted', reason = ? WHERE state IN ('waiting', 'going on')"
        database.execute(query, ("the server has ended",))

    def add(self, name: str, cell: str, request: TrialsRequest) -> None:
        """Add a series that waits; the oldest ones that have ended are forgotten."""
        query = "INSERT INTO trial_series (id, cell, request, state, reason) VALUES (?, ?, ?, 'waiting', '')"
        self._database.execute(query, (name, cell, msgspec.json.encode(request)))
        ended = "SELECT id FROM trial_series WHERE state IN ('ended', 'interrupted') ORDER BY number DESC"
        for (old,) in self._database.execute(f"{ended} LIMIT -1 OFFSET ?", (KEPT,)).fetchall():
            self.remove(old)

    def find(self, name: str) -> TrialSeries | None:
        """Return a series; None if there is none of this id."""
        return next(_read(self._database.execute(f"{COLUMNS} WHERE id = ?", (name,))), None)

    def list(self, cell: str) -> tuple[TrialSeries, ...]:
        """Return the series of a cell, the first one first."""
        return tuple(_read(self._database.execute(f"{COLUMNS} WHERE cell = ? ORDER BY number", (cell,))))

    def judge(self, series: TrialSeries) -> Series:
        """Return the trials of a series that are done, judged."""
        rows = self._database.execute("SELECT trial FROM trials WHERE series = ?", (series.id,))
        trials = [msgspec.json.decode(trial, type=Trial) for (trial,) in rows]
        request = series.request
        task = write_call(request.task, request.arguments) if request.arguments else request.task
        return judge_series(task, request.disturb, request.number, trials)

    def add_trial(self, series: TrialSeries, trial: Trial) -> None:
        """Add a trial to a series."""
        passed = not find_unmet_criteria(trial, series.request.disturb)
        row = (series.id, trial.seed, passed, msgspec.json.encode(trial))
        self._database.execute("INSERT INTO trials (series, seed, passed, trial) VALUES (?, ?, ?, ?)", row)

    def set_state(self, name: str, state: SeriesState, reason: str = "") -> None:
        """Note how far a series is, and why."""
        self._database.execute("UPDATE trial_series SET state = ?, reason = ? WHERE id = ?", (state, reason, name))

    def remove(self, name: str) -> None:
        """Remove a series with its trials, if it exists."""
        self._database.execute("DELETE FROM trial_series WHERE id = ?", (name,))
        self._database.execute("DELETE FROM trials WHERE series = ?", (name,))


def _read(rows: Iterable[tuple[str, str, bytes, SeriesState, str, int, int]]) -> Iterator[TrialSeries]:
    for name, cell, request, state, reason, done, passed in rows:
        wanted = msgspec.json.decode(request, type=TrialsRequest)
        yield TrialSeries(id=name, cell=cell, request=wanted, state=state, reason=reason, done=done, passed=passed)
