"""Members of skills and implementations as written."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.source import Span
from skillc_dsl.syntax.conditions import Condition, Number, Quantity, Text, Value
from skillc_dsl.syntax.names import Name, TypeName
from skillc_dsl.syntax.nodes import CallSkill, Node

Direction: TypeAlias = Literal["in", "opt", "infer", "out"]
RequirementKind: TypeAlias = Literal["pre", "hold", "post", "possible", "outcome"]
PausePlace: TypeAlias = Literal["anywhere", "between steps", "never"]


class Range(msgspec.Struct, frozen=True):
    """`range low .. high`"""

    low: Value
    high: Value
    span: Span


class Parameter(msgspec.Struct, frozen=True):
    """`in name: Type = default range a .. b`; `any` for `infer any`.

    `some` if it is what a `post some` is on, which is read as `infer any` with what is said of it.
    """

    direction: Direction
    any: bool
    name: Name
    type: TypeName
    default: Value | None
    range: Range | None
    doc: str
    span: Span
    some: bool = False


class Refinement(msgspec.Struct, frozen=True):
    """`refine name: Type = default range a .. b`"""

    name: Name
    type: TypeName
    default: Value | None
    range: Range | None
    span: Span


class Requirement(msgspec.Struct, frozen=True):
    """`pre|hold|post [sensed] [label:] condition [tolerance N]` or `outcome label: condition [likely N]`.

    `post possible condition` is of a kind of its own: what may be so afterwards.

    `text` is the condition as written, in one line. An outcome is sensed.
    """

    kind: RequirementKind
    sensed: bool
    label: Name | None
    condition: Condition
    text: str
    span: Span
    likely: Number | None = None
    tolerance: Number | Quantity | None = None


class TakenOver(msgspec.Struct, frozen=True):
    """`pre of Skill(argument, ..)`"""

    call: CallSkill
    span: Span


class Senses(msgspec.Struct, frozen=True):
    """`senses thing.property`"""

    value: Value
    span: Span


class Duration(msgspec.Struct, frozen=True):
    """`duration value`"""

    value: Value
    span: Span


class Cost(msgspec.Struct, frozen=True):
    """`cost value`"""

    value: Value
    span: Span


class DeviceUse(msgspec.Struct, frozen=True):
    """`uses parameter` or `shares parameter`."""

    kind: Literal["uses", "shares"]
    parameter: Name
    span: Span


class Pause(msgspec.Struct, frozen=True):
    """`pause anywhere|between steps|never [keep value]`"""

    where: PausePlace
    keep: Value | None
    span: Span


class Flag(msgspec.Struct, frozen=True):
    """A word of `descriptions.members.FLAGS`, alone on its line."""

    flag: str
    span: Span


class Let(msgspec.Struct, frozen=True):
    """`let name = value`"""

    name: Name
    value: Value
    span: Span


class Output(msgspec.Struct, frozen=True):
    """`out name = value`"""

    name: Name
    value: Value
    span: Span


class Prefer(msgspec.Struct, frozen=True):
    """`prefer N`"""

    value: Number
    span: Span


class RunPython(msgspec.Struct, frozen=True):
    """`run python "module:Class"`"""

    target: Text
    span: Span


class Body(msgspec.Struct, frozen=True):
    """`do node`"""

    node: Node
    span: Span


class VerifyEvent(msgspec.Struct, frozen=True):
    """What a `verify` property refers to: a called skill (a name) or a condition."""

    what: Name | Condition
    span: Span


class Verify(msgspec.Struct, frozen=True):
    """`never A [outside B]`, `A before B` or `after A eventually B`."""

    pattern: Literal["never", "outside", "before", "eventually"]
    first: VerifyEvent
    second: VerifyEvent | None
    span: Span
