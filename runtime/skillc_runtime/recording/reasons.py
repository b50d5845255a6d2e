"""Why a call has the parameters it has, and what it came to grief on: the reasons that events carry."""

from __future__ import annotations

from typing import Literal

import msgspec

from skillc_rdf.vocabulary.types import Position
from skillc_runtime.recording.failure import Rejection
from skillc_runtime.world.state.labelled import LabelledFact, LabelledIri, LabelledValue


class DecidingCondition(msgspec.Struct, frozen=True, kw_only=True):
    """A condition as its author wrote it, with the facts that decided it."""

    text: str
    source: Position
    facts: tuple[LabelledFact, ...]


class ParameterReason(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What a parameter stands for where that is more than an argument of the call.

    `how` says who decided: the caller, the parameter's default, or the world through the conditions. `others` are the
    individuals that would have done as well, which `infer any` passed over.
    """

    parameter: str
    how: Literal["passed", "default", "inferred"]
    conditions: tuple[DecidingCondition, ...] = ()
    others: tuple[LabelledIri, ...] = ()


class UntriedImplementation(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """An implementation that ranks after the one chosen; `reason` says why it would not have fitted, if so."""

    implementation: str
    source: Position
    reason: str = ""


class FailedCallContext(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What a call that failed had: its arguments, the implementations that did not do, the facts.

    `unset` are the parameters that were to be found in the world. The facts are those that its conditions read, at
    that moment.
    """

    arguments: dict[str, LabelledValue] = {}
    unset: tuple[str, ...] = ()
    rejected: tuple[Rejection, ...] = ()
    facts: tuple[LabelledFact, ...] = ()
