"""The history of a run, as a value for explanations: its attempts, their steps, the calls in these, the failures."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from skillc_rdf.vocabulary.types import Position
from skillc_runtime.recording.failure import Failure, Rejection
from skillc_runtime.recording.known_facts import KnownFact
from skillc_runtime.recording.reasons import ParameterReason, UntriedImplementation
from skillc_runtime.world.state.labelled import LabelledFact, LabelledValue


class _Part(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Times are in s of the cell's clock."""


class RecordedFact(_Part, frozen=True, kw_only=True):
    """A fact at one time; `since` and `by` are when and by what it was written, if that was during the run.

    `known` is its evidence: sensed, reported or assumed; empty if unknown.
    """

    fact: LabelledFact
    since: float | None = None
    by: str = ""
    known: str = ""


class FailedNode(_Part, frozen=True, kw_only=True):
    """A node in a chain of failures, a call or the innermost node; `message` is its reason."""

    kind: str
    name: str
    source: Position
    message: str


class EarlierStart(_Part, frozen=True, kw_only=True):
    """How an earlier start of the same call ended."""

    ended: float
    status: str
    message: str = ""


class RecordedCall(_Part, frozen=True, kw_only=True):
    """A call of a skill at its last start, or a step of a plan that was never called.

    `number` is the number of the step; for a call inside it, followed by its index there, for example `2.1`. `node` is
    its number in the events, 0 if it was never called. `status`
    is success, failure, halted, running, skipped (its postconditions already held) or not started. `source` is the
    place of the call, or of the skill for a planned step; `implementation_source` that of the implementation chosen
    last. `beside` are the steps that ran at the same time. `planned` if a planner bound its arguments, `fixed` if the
    call names its implementation. `unset` are the parameters that could not be inferred. `starts` is the number of
    starts, `chain` leads from this call to the node that failed.
    """

    number: str
    skill: str
    status: str
    source: Position | None
    node: int = 0
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
    facts: tuple[RecordedFact, ...] = ()
    starts: int = 1
    earlier: tuple[EarlierStart, ...] = ()
    beside: tuple[str, ...] = ()
    calls: tuple[RecordedCall, ...] = ()

    @property
    def all(self) -> Iterator[RecordedCall]:
        """This call and the calls inside it, outermost first."""
        yield self
        for call in self.calls:
            yield from call.all


class Attempt(_Part, frozen=True, kw_only=True):
    """A plan and the outcome of its steps; a body that was given has no `planner`.

    `quality` is how good the plan is known to be, `replaces` why the previous plan was abandoned.
    """

    steps: tuple[RecordedCall, ...]
    planner: str = ""
    optimal: str = ""
    quality: str = ""
    cost: float | None = None
    replaces: str = ""


class RunHistory(_Part, frozen=True, kw_only=True):
    """A run. `status` is empty if the recording ends before the task does; `last` is the time of the last event.

    `known` are the facts that a success rests on, `verified` is whether none of them is only assumed; None if unknown.
    `false_claims` are sentences about what the world model claimed at its end that was not so in the simulator.
    `chain` leads from the outermost call to the node that failed.
    """

    task: str
    status: str = ""
    verified: bool | None = None
    known: tuple[KnownFact, ...] = ()
    false_claims: tuple[str, ...] = ()
    library: str = ""
    hash: str = ""
    format: int = 1
    last: float = 0.0
    failure: Failure | None = None
    chain: tuple[FailedNode, ...] = ()
    attempts: tuple[Attempt, ...] = ()

    @property
    def calls(self) -> Iterator[RecordedCall]:
        """All calls of all attempts."""
        for attempt in self.attempts:
            for step in attempt.steps:
                yield from step.all
