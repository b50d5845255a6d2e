"""The jobs in the database of a server, with their logs and results."""

from __future__ import annotations

import sqlite3
import time
from collections.abc import Iterator

import msgspec
from msgspec import structs

from skillc.cells.database import transaction
from skillc.contract.job import ONGOING, Job, JobEvent, JobOutcome, JobState

JOBS = """
CREATE TABLE jobs (
    number INTEGER PRIMARY KEY AUTOINCREMENT,
    id     TEXT NOT NULL UNIQUE,
    kind   TEXT NOT NULL,
    state  TEXT NOT NULL,                      -- a JobState
    job    BLOB NOT NULL,                      -- a Job as JSON
    result BLOB                                -- a JobOutcome as JSON, once there is one
)
"""
JOB_EVENTS = """
CREATE TABLE job_events (
    job      TEXT NOT NULL,                    -- the id of a job
    sequence INTEGER NOT NULL,
    event    BLOB NOT NULL,                    -- a JobEvent as JSON
    part     BLOB,                             -- what was done then of a job that is done in parts, as JSON
    PRIMARY KEY (job, sequence)
)
"""
SERIES = (
    "CREATE TABLE trial_series (number INTEGER PRIMARY KEY, id TEXT, cell TEXT, request BLOB, state TEXT, reason TEXT)"
)
TRIALS = "CREATE TABLE trials (series TEXT, seed INTEGER, passed INTEGER, trial BLOB, PRIMARY KEY (series, seed))"
"""What older formats had of what are jobs now."""
KEPT = 50
"""How many jobs of a kind that go on no more are kept."""


class JobStore:
    """The jobs of a server. What a method has changed is durable when it returns."""

    def __init__(self, database: sqlite3.Connection) -> None:
        """Note of the jobs that another process has not finished that they are interrupted."""
        self._database = database
        for each in self.list():
            if each.state in ONGOING:
                self.put(structs.replace(each, state="interrupted", reason="the server has ended"), "interrupted")

    def put(self, job: Job, message: str, part: bytes | None = None, outcome: JobOutcome | None = None) -> None:
        """Write how far a job is, a line of its log, and the part of it or the outcome that there is now, if any."""
        kind = str(type(job.request).__struct_config__.tag)
        result = None if outcome is None else msgspec.json.encode(outcome)
        with transaction(self._database):
            self._database.execute(
                "INSERT INTO jobs (id, kind, state, job, result) VALUES (?, ?, ?, ?, ?) ON CONFLICT (id) DO UPDATE "
                "SET state = excluded.state, job = excluded.job, result = coalesce(excluded.result, result)",
                (job.id, kind, job.state, msgspec.json.encode(job), result),
            )
            query = "SELECT coalesce(max(sequence), 0) + 1 FROM job_events WHERE job = ?"
            (sequence,) = self._database.execute(query, (job.id,)).fetchone()
            event = JobEvent(
                sequence=sequence, wall_time_ns=time.time_ns(), state=job.state, done=job.done, message=message
            )
            self._database.execute(
                "INSERT INTO job_events (job, sequence, event, part) VALUES (?, ?, ?, ?)",
                (job.id, sequence, msgspec.json.encode(event), part),
            )

    def find(self, name: str) -> Job | None:
        """Return a job; None if there is none of this id."""
        return next(self._read("WHERE id = ?", name), None)

    def list(self, cell: str | None = None) -> tuple[Job, ...]:
        """Return the jobs for a cell, or all, the first one first."""
        return tuple(each for each in self._read("ORDER BY number") if cell in (None, each.cell))

    def list_old(self) -> tuple[str, ...]:
        """Return the ids of the jobs that go on no more, but for the last ones of each kind."""
        query = (
            "SELECT id FROM (SELECT id, row_number() OVER (PARTITION BY kind ORDER BY number DESC) AS place FROM jobs "
            "WHERE state NOT IN (?, ?)) WHERE place > ?"
        )
        return tuple(name for (name,) in self._database.execute(query, (*ONGOING, KEPT)))

    def events(self, name: str, after: int = 0) -> tuple[JobEvent, ...]:
        """Return the lines of the log of a job after a number."""
        query = "SELECT event FROM job_events WHERE job = ? AND sequence > ? ORDER BY sequence"
        return tuple(
            msgspec.json.decode(each, type=JobEvent) for (each,) in self._database.execute(query, (name, after))
        )

    def parts(self, name: str) -> tuple[bytes, ...]:
        """Return the parts of a job that are done, as JSON."""
        query = "SELECT part FROM job_events WHERE job = ? AND part IS NOT NULL ORDER BY sequence"
        return tuple(part for (part,) in self._database.execute(query, (name,)))

    def find_outcome(self, name: str) -> JobOutcome | None:
        """Return the outcome of a job; None if there is none yet."""
        found = self._database.execute("SELECT result FROM jobs WHERE id = ?", (name,)).fetchone()
        return None if found is None or found[0] is None else msgspec.json.decode(found[0], type=JobOutcome)

    def remove(self, name: str) -> None:
        """Remove a job with its log, if it exists."""
        with transaction(self._database):
            self._database.execute("DELETE FROM jobs WHERE id = ?", (name,))
            self._database.execute("DELETE FROM job_events WHERE job = ?", (name,))

    def _read(self, rest: str, *values: str) -> Iterator[Job]:
        rows = self._database.execute(f"SELECT job FROM jobs {rest}", values).fetchall()
        return (msgspec.json.decode(job, type=Job) for (job,) in rows)


def add_jobs(database: sqlite3.Connection) -> None:
    """Make jobs of the series of trials of a database in which there was nothing else that is kept."""
    database.execute(JOBS)
    database.execute(JOB_EVENTS)
    for name, cell, request, state, reason in database.execute(
        "SELECT id, cell, request, state, reason FROM trial_series ORDER BY number"
    ).fetchall():
        rows = database.execute("SELECT passed, trial FROM trials WHERE series = ? ORDER BY rowid", (name,)).fetchall()
        wanted = {**msgspec.json.decode(request), "kind": "trials", "cell": cell}
        states: dict[str, JobState] = {"going on": "running"}
        job = {
            "id": name,
            "cell": cell,
            "owner": "",
            "request": wanted,
            "state": states.get(state, state) if not reason or state != "ended" else "failed",
            "reason": reason,
            "done": len(rows),
            "failed": sum(not passed for passed, _ in rows),
            "wanted": wanted.get("number", 50),
        }
        query = "INSERT INTO jobs (id, kind, state, job) VALUES (?, 'trials', ?, ?)"
        database.execute(query, (name, job["state"], msgspec.json.encode(job)))
        for number, (passed, trial) in enumerate(rows, 1):
            event = JobEvent(
                sequence=number, wall_time_ns=0, state="running", done=number, message="passed" if passed else "failed"
            )
            query = "INSERT INTO job_events (job, sequence, event, part) VALUES (?, ?, ?, ?)"
            database.execute(query, (name, number, msgspec.json.encode(event), trial))
    database.execute("DROP TABLE trial_series")
    database.execute("DROP TABLE trials")
