"""The history of a run, as a value for explanations: its attempts, their steps, the calls in these, the failures."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf

import msgspec

from skillc_dsl.position import Position
from skillc_runtime.recording.failure import Failure, Rejection
from skillc_runtime.recording.known_facts import KnownFact
from skillc_runtime.recording.reasons import Highlight, ParameterReason, UntriedImplementation, WrittenExpression
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.labels.labelled import LabelledFact, LabelledIri, LabelledValue


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


class LoopRound(_Part, frozen=True):
    """The round of a loop in which a call was made, from 1; `loop` is its node, for example `retry 3`."""

    loop: str
    number: int

    def __str__(self) -> str:
        return f"round {self.number} of {self.loop}"


class RecordedCall(_Part, frozen=True, kw_only=True):
    """One call of a skill, or a step that was never called; a call that is made again is another one.

    `number` is the number of the step; for a call inside it, followed by its index there, for example `2.1`. `node` is
    its number in the events, 0 if it was never called. `rounds` are those of the loops around it in the same body, the
    outermost first. `status` is success, failure, halted, running, skipped (its postconditions already held) or not
    started. `source` is the place of the call, or of the skill for a planned step; `implementation_source` that of the
    implementation chosen last. `until` is when the scope ended that it opened with `with`. `beside` are the steps that
    ran at the same time. `planned` if a planner bound its arguments, `fixed` if the call names its implementation.
    `unset` are the parameters that could not be inferred. `chain` leads from this call to the node that failed.
    `expressions` are those of its arguments and defaults, by parameter, and `written` the facts on which these rest
    that were written during the run; `found` are facts of its individuals that it sensed, as it ended, if it is one
    of a primitive; `outputs` are its outputs, of which `out` is the name that gets the first.
    `activity` and `highlights` are those of a primitive.
    """

    number: str
    skill: str
    status: str
    source: Position | None
    node: int = 0
    implementation: str = ""
    implementation_source: Position | None = None
    rounds: tuple[LoopRound, ...] = ()
    started: float | None = None
    ended: float | None = None
    until: float | None = None
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
    expressions: dict[str, WrittenExpression] = {}
    out: str = ""
    outputs: dict[str, LabelledValue] = {}
    written: tuple[RecordedFact, ...] = ()
    found: tuple[RecordedFact, ...] = ()
    activity: str = ""
    highlights: tuple[Highlight, ...] = ()
    beside: tuple[str, ...] = ()
    calls: tuple[RecordedCall, ...] = ()

    @property
    def has_run(self) -> bool:
        """Whether it was called, and has chosen an implementation."""
        return bool(self.implementation)

    @property
    def others(self) -> tuple[Rejection, ...]:
        """The rejected implementations without the one that was chosen last, whose failure is that of the call."""
        return tuple(each for each in self.rejected if each.implementation != self.implementation)

    @property
    def individuals(self) -> tuple[str, ...]:
        """The IRIs of the individuals that the parameters stand for, in the order of the parameters."""
        return tuple(value.iri for value in self.bindings.values() if isinstance(value, LabelledIri))

    @property
    def all(self) -> Iterator[RecordedCall]:
        """This call and the calls inside it, outermost first."""
        yield self
        for call in self.calls:
            yield from call.all


class RecordedNote(_Part, frozen=True, kw_only=True):
    """What a run told its users, and when, in s of the cell."""

    time: float
    message: str


class RecordedAttempt(_Part, frozen=True, kw_only=True):
    """A plan and its steps in order of time, or those of a body that was given, which has no `planner`.

    Steps that were not started come last. `planned` is how many steps the plan has.
    `quality` is how good the plan is known to be, `space` what is known of it in space, None if nobody has looked;
    `replaces` is why the previous plan was abandoned, or what was `sensed` that decides how a policy goes on.
    `notes` are what the run noted meanwhile, without effect on it.
    """

    steps: tuple[RecordedCall, ...]
    planned: int = 0
    planner: str = ""
    optimal: str = ""
    quality: str = ""
    space: SpaceClaim | None = None
    cost: float | None = None
    replaces: str = ""
    sensed: bool = False
    notes: tuple[RecordedNote, ...] = ()


class RunHistory(_Part, frozen=True, kw_only=True):
    """A run. `status` is empty if the recording ends before the task does; `last` is the time of the last event.

    `scene` is the file of its scene, empty if there is none. `known` are the facts that a success rests on, `verified`
    is whether none of them is only assumed; None if unknown. `false_claims` are sentences about what the world model
    claimed at its end that was not so in the simulator. `chain` leads from the outermost call to the node that failed.
    `pauses` are when it was paused and resumed, the latter None if it never went on. Arms and bases had the share
    `speed` of their speeds.
    """

    task: str
    speed: float = 1.0
    status: str = ""
    verified: bool | None = None
    known: tuple[KnownFact, ...] = ()
    false_claims: tuple[str, ...] = ()
    library: str = ""
    hash: str = ""
    scene: str = ""
    format: int = 1
    last: float = 0.0
    failure: Failure | None = None
    chain: tuple[FailedNode, ...] = ()
    attempts: tuple[RecordedAttempt, ...] = ()
    pauses: tuple[tuple[float, float | None], ...] = ()

    @property
    def paused(self) -> tuple[tuple[float, float], ...]:
        """When it was paused and resumed, in s; the end is inf if it never went on."""
        return tuple((start, inf if end is None else end) for start, end in self.pauses)

    @property
    def steps(self) -> Iterator[RecordedCall]:
        """The steps of all attempts."""
        for attempt in self.attempts:
            yield from attempt.steps

    @property
    def calls(self) -> Iterator[RecordedCall]:
        """The steps of all attempts with all calls inside them."""
        for step in self.steps:
            yield from step.all
