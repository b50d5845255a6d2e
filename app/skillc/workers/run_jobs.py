"""What a worker can be asked about runs that are recorded, also while they go on, and what it answers."""

from __future__ import annotations

from typing import TypeAlias

import msgspec

from skillc_rdf.vocabulary.types import Position
from skillc_runtime.recording.signals.signal import Signal


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


RunJob: TypeAlias = ShowTree | ExplainRun | ReadSignals | CompareRuns


class ExplainedCall(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A call, explained as `skillc why RUN NUMBER` does, with those inside it after it.

    `node` is the one in the tree and the events, 0 if the call never started. `source` is the place of the call,
    `implementation_source` that of the implementation that it chose last.
    """

    number: str
    skill: str
    status: str
    lines: tuple[str, ...]
    node: int = 0
    source: Position | None = None
    implementation_source: Position | None = None


class ChainedFailure(msgspec.Struct, frozen=True):
    """A link of the chain that leads from the outermost call that failed to the cause, with its place."""

    name: str
    message: str
    source: Position


class RunExplanation(msgspec.Struct, frozen=True):
    """Why a run, up to its event `sequence`, did what it did: `lines` as `skillc why` prints them, and each call.

    `answer` has the lines for a question, none without.
    """

    sequence: int
    lines: tuple[str, ...]
    chain: tuple[ChainedFailure, ...]
    calls: tuple[ExplainedCall, ...]
    answer: tuple[str, ...]


class SignalRows(msgspec.Struct, frozen=True):
    """Signals at the times `time_s` of the cell; each of `signals` has its column in `columns`, null where unknown.

    `every_s` is how far apart these rows are at least. `more` if there are later ones.
    """

    time_s: tuple[float, ...]
    signals: tuple[Signal, ...]
    columns: tuple[tuple[float | None, ...], ...]
    every_s: float
    more: bool
