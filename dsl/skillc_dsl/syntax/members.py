"""Members of skills and implementations as written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from skillc_dsl.source import Span
from skillc_dsl.syntax.conditions import Condition
from skillc_dsl.syntax.nodes import Node
from skillc_dsl.syntax.values import Name, Number, Text, TypeName, Value

Direction: TypeAlias = Literal["in", "opt", "infer", "out"]
PausePlace: TypeAlias = Literal["anywhere", "between steps", "never"]


@dataclass(frozen=True, slots=True)
class Range:
    """`range low .. high`"""

    low: Value
    high: Value
    span: Span


@dataclass(frozen=True, slots=True)
class Parameter:
    """`in name: Type = default range a .. b`; `any` for `infer any`."""

    direction: Direction
    any: bool
    name: Name
    type: TypeName
    default: Value | None
    range: Range | None
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class Refinement:
    """`refine name: Type = default range a .. b`"""

    name: Name
    type: TypeName
    default: Value | None
    range: Range | None
    span: Span


@dataclass(frozen=True, slots=True)
class Requirement:
    """`pre|hold|post [sensed] [label:] condition`; `text` is the condition as written, in one line."""

    kind: Literal["pre", "hold", "post"]
    sensed: bool
    label: Name | None
    condition: Condition
    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Duration:
    """`duration value`"""

    value: Value
    span: Span


@dataclass(frozen=True, slots=True)
class DeviceUse:
    """`uses parameter` or `shares parameter`."""

    kind: Literal["uses", "shares"]
    parameter: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Pause:
    """`pause anywhere|between steps|never [keep value]`"""

    where: PausePlace
    keep: Value | None
    span: Span


@dataclass(frozen=True, slots=True)
class Flag:
    """`scoped`, `noplan`, `fallback` or `endless`, alone on its line."""

    flag: Literal["scoped", "noplan", "fallback", "endless"]
    span: Span


@dataclass(frozen=True, slots=True)
class Let:
    """`let name = value`"""

    name: Name
    value: Value
    span: Span


@dataclass(frozen=True, slots=True)
class Prefer:
    """`prefer N`"""

    value: Number
    span: Span


@dataclass(frozen=True, slots=True)
class RunPython:
    """`run python "module:Class"`"""

    target: Text
    span: Span


@dataclass(frozen=True, slots=True)
class Body:
    """`do node`"""

    node: Node
    span: Span


@dataclass(frozen=True, slots=True)
class Event:
    """What a `verify` property refers to: a called skill (a name) or a condition."""

    what: Name | Condition
    span: Span


@dataclass(frozen=True, slots=True)
class Verify:
    """`never A [outside B]`, `A before B` or `after A eventually B`."""

    pattern: Literal["never", "outside", "before", "eventually"]
    first: Event
    second: Event | None
    span: Span
