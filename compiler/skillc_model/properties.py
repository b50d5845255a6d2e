"""Properties that `verify` lines require of every execution of an implementation."""

from __future__ import annotations

from typing import Literal as OneOf
from typing import TypeAlias

import msgspec

from skillc_dsl.position import Position
from skillc_model.conditions import Condition, Expression, Operator


class Runs(msgspec.Struct, frozen=True, tag="runs"):
    """A skill runs: forbidden runs count from the start of the skill, required runs once it has succeeded."""

    skill: str


class ConditionEvent(msgspec.Struct, frozen=True, tag="is"):
    """A condition holds."""

    condition: Condition


class Measures(msgspec.Struct, frozen=True, tag="measures"):
    """The contact force on an arm of the implementation, in N, compared with a limit in N."""

    quantity: OneOf["force"]
    operator: Operator
    limit: Expression


VerifyEvent: TypeAlias = Runs | ConditionEvent | Measures


class Property(msgspec.Struct, frozen=True, kw_only=True):
    """`never first`, `never first outside second`, `first before second`, `after first eventually second`."""

    pattern: OneOf["never", "outside", "before", "eventually"]
    first: VerifyEvent
    second: VerifyEvent | None = None
    text: str
    source: Position
