"""Behaviour tree nodes as written."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.descriptions.nodes import DECORATOR_OF
from skillc_dsl.descriptions.rows import Decorator as DecoratorRow
from skillc_dsl.source import Span
from skillc_dsl.syntax.conditions import Condition, Message, Value
from skillc_dsl.syntax.names import Name


class Block(msgspec.Struct, frozen=True):
    """A node with several children and no value of its own."""

    kind: Literal["seq", "sel", "reactive seq", "reactive sel", "par all", "par any", "par race", "par lead"]
    children: tuple[Node, ...]
    span: Span


class Decorator(msgspec.Struct, frozen=True):
    """`WORD SLOT .. { }`: a node of `descriptions.nodes.DECORATORS`, with a value for each of its slots."""

    kind: str
    slots: tuple[Value, ...]
    children: tuple[Node, ...]
    span: Span

    @property
    def row(self) -> DecoratorRow:
        """What it is."""
        return DECORATOR_OF[self.kind]


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
    limit: Value
    children: tuple[Node, ...]
    span: Span


class Every(msgspec.Struct, frozen=True):
    """`Class where condition by value`: the individuals of a class that fulfil a condition, in the order of a value."""

    cls: Name
    where: Condition | None
    by: Value | None
    span: Span


class For(msgspec.Struct, frozen=True):
    """`for variable in items { }`, `for variable: Class where condition by value { }`"""

    variable: Name
    items: Value | Every
    children: tuple[Node, ...]
    span: Span


class CheckNode(msgspec.Struct, frozen=True):
    """`check(condition)`"""

    condition: Condition
    text: str
    span: Span


class Fail(msgspec.Struct, frozen=True):
    """`fail "reason"`"""

    message: Message
    span: Span


class OnFailure(msgspec.Struct, frozen=True):
    """`node on failure as why { }`; `why` is None if it has no name."""

    node: Node
    why: Name | None
    handler: tuple[Node, ...]
    span: Span


class Finally(msgspec.Struct, frozen=True):
    """`node finally { }`"""

    node: Node
    last: tuple[Node, ...]
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
    Block
    | Decorator
    | Wait
    | WaitUntil
    | If
    | While
    | For
    | CheckNode
    | Fail
    | ApplyPosts
    | CallSkill
    | With
    | OnFailure
    | Finally
)
