"""The body of a compound implementation as a tree of nodes; the set is closed and the runtime knows each."""

from __future__ import annotations

from typing import Literal as OneOf
from typing import TypeAlias

import msgspec

from skillc_model.conditions import Condition, Expression
from skillc_rdf.vocabulary.types import Position


class Sequence(msgspec.Struct, frozen=True, tag="seq"):
    """Children in order until one fails; with memory unless reactive."""

    children: tuple[Node, ...]
    reactive: bool
    source: Position


class Selector(msgspec.Struct, frozen=True, tag="sel"):
    """Children in order until one succeeds; with memory unless reactive."""

    children: tuple[Node, ...]
    reactive: bool
    source: Position


class Parallel(msgspec.Struct, frozen=True, tag="par"):
    """Children together: `all` succeed, `any` first success, `race` first to finish, `lead` the first child decides."""

    policy: OneOf["all", "any", "race", "lead"]
    children: tuple[Node, ...]
    source: Position


class Retry(msgspec.Struct, frozen=True, tag="retry"):
    """The child up to `count` times until it succeeds."""

    count: int
    child: Node
    source: Position


class Repeat(msgspec.Struct, frozen=True, tag="repeat"):
    """The child `count` times, while it succeeds."""

    count: int
    child: Node
    source: Position


class Timeout(msgspec.Struct, frozen=True, tag="timeout"):
    """The child, halted and failed after `seconds`."""

    seconds: Expression
    child: Node
    source: Position


class Try(msgspec.Struct, frozen=True, tag="try"):
    """The child; its failure becomes success, except of an enclosing hold or halt."""

    child: Node
    source: Position


class Invert(msgspec.Struct, frozen=True, tag="invert"):
    """The child with success and failure exchanged."""

    child: Node
    source: Position


class Once(msgspec.Struct, frozen=True, tag="once"):
    """The child, run at most once in the life of the enclosing skill; afterwards its result."""

    child: Node
    source: Position


class Wait(msgspec.Struct, frozen=True, tag="wait"):
    """Nothing for `seconds`."""

    seconds: Expression
    source: Position


class WaitUntil(msgspec.Struct, frozen=True, tag="wait-until"):
    """Nothing until the condition holds."""

    condition: Condition
    text: str
    source: Position


class If(msgspec.Struct, frozen=True, tag="if"):
    """One of two branches, chosen at start; without `orelse` a false condition succeeds."""

    condition: Condition
    text: str
    then: Node
    orelse: Node | None
    source: Position


class While(msgspec.Struct, frozen=True, tag="while"):
    """The child again while the condition holds; fails when it still holds after `limit` rounds."""

    condition: Condition
    text: str
    limit: int
    child: Node
    source: Position


class ForEach(msgspec.Struct, frozen=True, tag="for"):
    """The child once for every item, in order."""

    variable: str
    items: Expression
    child: Node
    source: Position


class Check(msgspec.Struct, frozen=True, tag="check"):
    """Success when the condition holds, else failure."""

    condition: Condition
    text: str
    source: Position


class Apply(msgspec.Struct, frozen=True, tag="apply"):
    """Write the labelled posts of the enclosing skill now."""

    labels: tuple[str, ...]
    source: Position


class Call(msgspec.Struct, frozen=True, tag="call"):
    """Run another skill; arguments by parameter name, `out` names what its output is called here."""

    skill: str
    implementation: str | None
    arguments: dict[str, Expression]
    out: str | None
    source: Position


class With(msgspec.Struct, frozen=True, tag="with"):
    """Run a scoped skill, then the child; what the skill set up is undone when the child ends in any way."""

    call: Call
    child: Node
    source: Position


Node: TypeAlias = (
    Sequence
    | Selector
    | Parallel
    | Retry
    | Repeat
    | Timeout
    | Try
    | Invert
    | Once
    | Wait
    | WaitUntil
    | If
    | While
    | ForEach
    | Check
    | Apply
    | Call
    | With
)
