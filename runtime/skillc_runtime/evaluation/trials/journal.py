"""The file of trials in a folder, a heading and a line for each trial, with which an interrupted series is resumed."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from types import TracebackType
from typing import BinaryIO, TypeVar

import msgspec

from skillc_runtime.evaluation.trials.trial import Trial, TrialDisturbance
from skillc_runtime.platforms.file_locks import try_lock

FILE = "trials.jsonl"
FORMAT = 7


class Heading(msgspec.Struct, frozen=True, kw_only=True):
    """What all trials in a folder have in common; trials that differ in it cannot be compared."""

    format: int = FORMAT
    task: str
    disturbance: TrialDisturbance
    skillc: str
    library: str
    scene: str


Record = TypeVar("Record", Heading, Trial)


class JournalError(ValueError):
    """Trials cannot be added to a folder; the message has the reason and a remedy."""


class TrialJournal:
    """The file of trials in a folder, for one writer at a time; use it in a `with` statement."""

    def __init__(self, folder: Path, heading: Heading) -> None:
        """Open or create the file; JournalError for another heading, a second writer or a damaged file."""
        self.path = folder / FILE
        folder.mkdir(parents=True, exist_ok=True)
        self._file: BinaryIO = self.path.open("a+b")
        try:
            self._lock()
            self._trials = self._resume(heading)
        except BaseException:
            self._file.close()
            raise

    @property
    def trials(self) -> tuple[Trial, ...]:
        """The trials in the file, ordered by seed."""
        return tuple(self._trials[seed] for seed in sorted(self._trials))

    def add(self, trial: Trial) -> None:
        """Append a trial; it is on disk when this returns."""
        self._write(trial)
        self._trials[trial.seed] = trial

    def __enter__(self) -> TrialJournal:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()

    def _lock(self) -> None:
        if not try_lock(self._file.fileno()):
            raise JournalError(f"another process is adding trials to {self.path.parent}; take another folder")

    def _resume(self, heading: Heading) -> dict[int, Trial]:
        """Read the file; an incomplete last line is removed."""
        self._file.seek(0)
        content = self._file.read()
        complete = content[: content.rfind(b"\n") + 1]
        if len(complete) < len(content):
            self._file.truncate(len(complete))
        if not complete:
            self._write(heading)
            return {}
        first, *lines = complete.splitlines()
        self._compare(self._decode(first, 1, Heading), heading)
        trials = (self._decode(line, number, Trial) for number, line in enumerate(lines, 2))
        return {trial.seed: trial for trial in trials}

    def _compare(self, existing: Heading, expected: Heading) -> None:
        for field in Heading.__struct_fields__:
            before, now = getattr(existing, field), getattr(expected, field)
            if before != now:
                raise JournalError(
                    f"the trials in {self.path.parent} are of another {field}: {before}, now it is {now}; "
                    "take another folder, or remove this one"
                )

    def _decode(self, line: bytes, number: int, kind: type[Record]) -> Record:
        try:
            return msgspec.json.decode(line, type=kind)
        except msgspec.DecodeError as error:
            raise JournalError(f"{self.path}, line {number}, is not a record of trials: {error}") from error

    def _write(self, record: Heading | Trial) -> None:
        self._file.write(msgspec.json.encode(record) + b"\n")
        self._file.flush()
        os.fsync(self._file.fileno())


def find_missing_seeds(seeds: Iterable[int], trials: Iterable[Trial]) -> tuple[int, ...]:
    """Return the seeds that have no trial yet."""
    done = {trial.seed for trial in trials}
    return tuple(seed for seed in seeds if seed not in done)
