"""Behaviour tree nodes as written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from skillc_dsl.source import Span
from skillc_dsl.syntax.conditions import Condition
from skillc_dsl.syntax.values import Name, Number, Value


@dataclass(frozen=True, slots=True)
class Block:
    """A node with children and no value of its own."""

    kind: Literal[
        "seq",
        "sel",
        "reactive seq",
        "reactive sel",
        "par all",
        "par any",
        "par race",
        "par lead",
        "try",
        "invert",
        "once",
    ]
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Counted:
    """`retry N { }` or `repeat N { }`."""

    kind: Literal["retry", "repeat"]
    count: Number
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Timeout:
    """`timeout Q { }`"""

    limit: Value
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Wait:
    """`wait Q`"""

    time: Value
    span: Span


@dataclass(frozen=True, slots=True)
class WaitUntil:
    """`wait until condition`"""

    condition: Condition
    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class If:
    """`if condition { } else { }`; `orelse` is None if there is no `else`."""

    condition: Condition
    text: str
    then: tuple[Node, ...]
    orelse: tuple[Node, ...] | None
    span: Span


@dataclass(frozen=True, slots=True)
class While:
    """`while condition max N { }`"""

    condition: Condition
    text: str
    limit: Number
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class For:
    """`for variable in items { }`"""

    variable: Name
    items: Value
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class CheckNode:
    """`check(condition)`"""

    condition: Condition
    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class ApplyPosts:
    """`apply label, ..`"""

    labels: tuple[Name, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Argument:
    """`name: value` in a call; `name` alone is kept as a reference to the same name."""

    name: Name
    value: Value
    span: Span


@dataclass(frozen=True, slots=True)
class CallSkill:
    """`Skill[implementation](argument, ..) -> out`"""

    skill: Name
    implementation: Name | None
    arguments: tuple[Argument, ...]
    out: Name | None
    span: Span


@dataclass(frozen=True, slots=True)
class With:
    """`with call { }`"""

    call: CallSkill
    children: tuple[Node, ...]
    span: Span


Node: TypeAlias = (
    Block | Counted | Timeout | Wait | WaitUntil | If | While | For | CheckNode | ApplyPosts | CallSkill | With
)
