"""Behaviour tree nodes as written."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.source import Span
from skillc_dsl.syntax.conditions import Condition
from skillc_dsl.syntax.values import Name, Number, Value


class Block(msgspec.Struct, frozen=True):
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


class Counted(msgspec.Struct, frozen=True):
    """`retry N { }` or `repeat N { }`."""

    kind: Literal["retry", "repeat"]
    count: Number
    children: tuple[Node, ...]
    span: Span


class Timeout(msgspec.Struct, frozen=True):
    """`timeout Q { }`"""

    limit: Value
    children: tuple[Node, ...]
    span: Span


class Wait(msgspec.Struct, frozen=True):
    """`wait Q`"""

    time: Value
    span: Span


class WaitUntil(msgspec.Struct, frozen=True):
    """`wait until condition`"""

    condition: Condition
    text: str
    span: Span


class If(msgspec.Struct, frozen=True):
    """`if condition { } else { }`; `orelse` is None if there is no `else`."""

    condition: Condition
    text: str
    then: tuple[Node, ...]
    orelse: tuple[Node, ...] | None
    span: Span


class While(msgspec.Struct, frozen=True):
    """`while condition max N { }`"""

    condition: Condition
    text: str
    limit: Number
    children: tuple[Node, ...]
    span: Span


class For(msgspec.Struct, frozen=True):
    """`for variable in items { }`"""

    variable: Name
    items: Value
    children: tuple[Node, ...]
    span: Span


class CheckNode(msgspec.Struct, frozen=True):
    """`check(condition)`"""

    condition: Condition
    text: str
    span: Span


class ApplyPosts(msgspec.Struct, frozen=True):
    """`apply label, ..`"""

    labels: tuple[Name, ...]
    span: Span


class Argument(msgspec.Struct, frozen=True):
    """`name: value` in a call; `name` alone is kept as a reference to the same name."""

    name: Name
    value: Value
    span: Span


class CallSkill(msgspec.Struct, frozen=True):
    """`Skill[implementation](argument, ..) -> out`"""

    skill: Name
    implementation: Name | None
    arguments: tuple[Argument, ...]
    out: Name | None
    span: Span


class With(msgspec.Struct, frozen=True):
    """`with call { }`"""

    call: CallSkill
    children: tuple[Node, ...]
    span: Span


Node: TypeAlias = (
    Block | Counted | Timeout | Wait | WaitUntil | If | While | For | CheckNode | ApplyPosts | CallSkill | With
)
