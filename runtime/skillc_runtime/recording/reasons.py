"""What events say of calls: why a parameter has its value, the context of a failure, the moments to show."""

from __future__ import annotations

from typing import Literal

import msgspec

from skillc_dsl.position import Position
from skillc_runtime.recording.failure import Rejection
from skillc_runtime.world.state.labels.labelled import LabelledFact, LabelledIri, LabelledValue


class DecidingCondition(msgspec.Struct, frozen=True, kw_only=True):
    """A condition as written in the source, with the facts that decided it."""

    text: str
    source: Position
    facts: tuple[LabelledFact, ...]


class ParameterReason(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Why a parameter that is not simply an argument of the call has its value.

    `how` is where the value comes from: the caller, the default, or inference from the conditions. `others` are the
    other individuals that `infer any` could have chosen.
    """

    parameter: str
    how: Literal["passed", "default", "inferred"]
    conditions: tuple[DecidingCondition, ...] = ()
    others: tuple[LabelledIri, ...] = ()


class Highlight(msgspec.Struct, frozen=True):
    """What `what` is, for example `pressed`, when a call begins or ends successfully: a moment to show in a report."""

    when: Literal["begins", "ends"]
    what: LabelledIri
    word: str


class WrittenExpression(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """An expression as text in the syntax of the language, and where it stands.

    `facts` are those that it reads, `names` the names of the enclosing body in it.
    """

    text: str
    source: Position
    facts: tuple[LabelledFact, ...] = ()
    names: tuple[NameInExpression, ...] = ()


class NameInExpression(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A name of the enclosing body in an expression, and how it gets its value.

    It is a `parameter` of the body, a `let` with its `expression`, an item of a `loop` over the `expression`, the
    `output` of a call, or `given` as an argument of the task. `value` is that of the argument or the item, if known.
    """

    name: str
    how: Literal["parameter", "let", "loop", "output", "given"]
    expression: WrittenExpression | None = None
    value: LabelledValue | None = None


class UntriedImplementation(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """An implementation that ranks after the chosen one; `reason` is why it could not start, empty if it could."""

    implementation: str
    source: Position
    reason: str = ""


class FailedCallContext(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """The context of a failed call: its arguments, the rejected implementations, and the facts.

    `unset` are the parameters that could not be inferred. `facts` are those that its conditions read, at the time of
    the failure.
    """

    arguments: dict[str, LabelledValue] = {}
    unset: tuple[str, ...] = ()
    rejected: tuple[Rejection, ...] = ()
    facts: tuple[LabelledFact, ...] = ()
