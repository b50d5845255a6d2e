"""What a worker can be asked about runs that are recorded, also while they go on, and what it answers."""

from __future__ import annotations

from typing import TypeAlias

import msgspec


class RunFiles(msgspec.Struct, frozen=True):
    """Where a run is: its events in the journal of its cell, the rest in its recording, if there is one."""

    operation: str
    journal: str
    recording: str


class ShowTree(msgspec.Struct, frozen=True, tag="tree"):
    """Show the tree of a run, with the library in its recording."""

    run: RunFiles


class ExplainRun(msgspec.Struct, frozen=True, tag="why"):
    """Explain a run; a question is one of `skillc why`, or empty."""

    run: RunFiles
    question: str


class ReadSignals(msgspec.Struct, frozen=True, tag="signals"):
    """Read signals whose columns contain one of `match`, after a time, `every_s` apart at least; times in s."""

    run: RunFiles
    match: tuple[str, ...]
    after_s: float
    until_s: float
    every_s: float


class CompareRuns(msgspec.Struct, frozen=True, tag="compare"):
    """Compare two runs; one that goes on as far as it is."""

    first: RunFiles
    second: RunFiles


RunQuestion: TypeAlias = ShowTree | ExplainRun | ReadSignals | CompareRuns
