"""What happened in a run, as a value to explain it from: attempts, their steps, the calls in them, why each failed."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from skillc_rdf.vocabulary.types import Position
from skillc_runtime.recording.failure import Failure, Rejection
from skillc_runtime.recording.known import KnownFact
from skillc_runtime.recording.reasons import ParameterReason, UntriedImplementation
from skillc_runtime.world.state.labelled import LabelledFact, LabelledValue


class _Part(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Times are in seconds of the cell's clock."""


class Fact(_Part, frozen=True, kw_only=True):
    """A fact at some moment; `since` and `by` say when it was written and by whom, where that was during the run.

    `known` says how it is known: sensed, reported or assumed; empty where that is not known.
    """

    fact: LabelledFact
    since: float | None = None
    by: str = ""
    known: str = ""


class FailedNode(_Part, frozen=True, kw_only=True):
    """One of those who failed together: a call, or the innermost node; `message` says what it gave as the reason."""

    kind: str
    name: str
    source: Position
    message: str


class EarlierStart(_Part, frozen=True, kw_only=True):
    """How an earlier start of the same call ended."""

    ended: float
    status: str
    message: str = ""


class Call(_Part, frozen=True, kw_only=True):
    """A call of a skill at its last start, or a step of a plan that was never called.

    `number` is that of the step, followed for a call inside it by its place there, as `2.1`. `status` is one of
    success, failure, halted, running, skipped (what it is for held already), not started. `source` is the place of the
    call, of a planned step that of the skill; `implementation_source` that of the implementation chosen last. `beside`
    are the steps that ran at the same time. `planned` tells that a planner bound its arguments, `fixed` that the call
    names its implementation. `unset` are parameters that were to be found in the world and were not. `starts` counts
    the starts, `chain` leads from this call to what failed.
    """

    number: str
    skill: str
    status: str
    source: Position | None
    implementation: str = ""
    implementation_source: Position | None = None
    started: float | None = None
    ended: float | None = None
    bindings: dict[str, LabelledValue] = {}
    determined: tuple[ParameterReason, ...] = ()
    unset: tuple[str, ...] = ()
    planned: bool = False
    fixed: bool = False
    untried: tuple[UntriedImplementation, ...] = ()
    rejected: tuple[Rejection, ...] = ()
    failure: Failure | None = None
    chain: tuple[FailedNode, ...] = ()
    facts: tuple[Fact, ...] = ()
    starts: int = 1
    earlier: tuple[EarlierStart, ...] = ()
    beside: tuple[str, ...] = ()
    calls: tuple[Call, ...] = ()

    @property
    def all(self) -> Iterator[Call]:
        """This call and those inside it, outermost first."""
        yield self
        for call in self.calls:
            yield from call.all


class Attempt(_Part, frozen=True, kw_only=True):
    """A plan and what became of its steps; a body that was given has no `planner`.

    `quality` says how good the plan is known to be, `replaces` says why the plan before it was given up.
    """

    steps: tuple[Call, ...]
    planner: str = ""
    optimal: str = ""
    quality: str = ""
    cost: float | None = None
    replaces: str = ""


class Story(_Part, frozen=True, kw_only=True):
    """A run. `status` is empty where the recording ends before the task does; `last` is the time of the last event.

    `known` are the facts that a success rests on, `verified` tells whether none of them is only assumed; None where
    that is not known.
    """

    task: str
    status: str = ""
    verified: bool | None = None
    known: tuple[KnownFact, ...] = ()
    library: str = ""
    hash: str = ""
    format: int = 1
    last: float = 0.0
    failure: Failure | None = None
    chain: tuple[FailedNode, ...] = ()
    attempts: tuple[Attempt, ...] = ()

    @property
    def calls(self) -> Iterator[Call]:
        """All calls of all attempts."""
        for attempt in self.attempts:
            for step in attempt.steps:
                yield from step.all
