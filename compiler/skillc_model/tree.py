"""The body of a compound implementation as a behaviour tree; `Node` is the closed union of all node types."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal as OneOf
from typing import TypeAlias, get_args

import msgspec

from skillc_dsl.position import Position
from skillc_model.conditions import Condition, Expression

MOST_ROUNDS = 1_000_000
"""The greatest number of rounds of `retry`, `repeat` and `while`; more count as endless."""


class Sequence(msgspec.Struct, frozen=True, tag="seq"):
    """Runs its children in order until one fails; with memory unless reactive."""

    children: tuple[Node, ...]
    reactive: bool
    source: Position


class Selector(msgspec.Struct, frozen=True, tag="sel"):
    """Runs its children in order until one succeeds; with memory unless reactive."""

    children: tuple[Node, ...]
    reactive: bool
    source: Position


class Parallel(msgspec.Struct, frozen=True, tag="par", omit_defaults=True):
    """Runs its children together until `all` succeed, `any` succeeds, one ends (`race`) or the first ends (`lead`).

    In a body of a plan, with `all`, a child may have to wait for others: `after` has their indices, for each child.
    """

    policy: OneOf["all", "any", "race", "lead"]
    children: tuple[Node, ...]
    source: Position
    after: tuple[tuple[int, ...], ...] = ()


class Retry(msgspec.Struct, frozen=True, tag="retry"):
    """Runs the child up to `count` times until it succeeds."""

    count: int | Expression
    child: Node
    source: Position


class Repeat(msgspec.Struct, frozen=True, tag="repeat"):
    """Runs the child `count` times, as long as it succeeds."""

    count: int | Expression
    child: Node
    source: Position


class Timeout(msgspec.Struct, frozen=True, tag="timeout"):
    """Runs the child; halts it and fails after `seconds`."""

    seconds: Expression
    child: Node
    source: Position


class Try(msgspec.Struct, frozen=True, tag="try"):
    """Runs the child and succeeds even if it fails, unless an enclosing hold condition breaks or the node is halted."""

    child: Node
    source: Position


class Invert(msgspec.Struct, frozen=True, tag="invert"):
    """Runs the child and exchanges success and failure."""

    child: Node
    source: Position


class Once(msgspec.Struct, frozen=True, tag="once"):
    """Runs the child at most once per run of the enclosing skill; returns its result afterwards."""

    child: Node
    source: Position


class Wait(msgspec.Struct, frozen=True, tag="wait"):
    """Waits for `seconds`, then succeeds."""

    seconds: Expression
    source: Position


class WaitUntil(msgspec.Struct, frozen=True, tag="wait-until"):
    """Waits until the condition holds, then succeeds."""

    condition: Condition
    text: str
    source: Position


class If(msgspec.Struct, frozen=True, tag="if"):
    """Runs one of two branches, chosen at the start; without `orelse` a false condition succeeds."""

    condition: Condition
    text: str
    then: Node
    orelse: Node | None
    source: Position


class While(msgspec.Struct, frozen=True, tag="while"):
    """Repeats the child while the condition holds; fails if it still holds after `limit` rounds."""

    condition: Condition
    text: str
    limit: int | Expression
    child: Node
    source: Position


class ForEach(msgspec.Struct, frozen=True, tag="for"):
    """Runs the child once for each item, in order."""

    variable: str
    items: Expression
    child: Node
    source: Position


class Check(msgspec.Struct, frozen=True, tag="check"):
    """Succeeds if the condition holds, fails otherwise."""

    condition: Condition
    text: str
    source: Position


class Fail(msgspec.Struct, frozen=True, tag="fail"):
    """Fails for a reason."""

    reason: Expression
    source: Position


class Apply(msgspec.Struct, frozen=True, tag="apply"):
    """Applies the labelled postconditions of the enclosing skill to the world model."""

    labels: tuple[str, ...]
    source: Position


class Call(msgspec.Struct, frozen=True, tag="call"):
    """Runs another skill; arguments are by parameter name, `out` is the local name of its output."""

    skill: str
    implementation: str | None
    arguments: dict[str, Expression]
    out: str | None
    source: Position


class With(msgspec.Struct, frozen=True, tag="with"):
    """Runs a scoped skill, then the child; the skill's setup is undone however the child ends."""

    call: Call
    child: Node
    source: Position


class OnFailure(msgspec.Struct, frozen=True, tag="on-failure"):
    """Runs the child; if it fails, `handler` decides, in which `why` is the reason as text; None if it has no name.

    `why.kind`, `why.message`, `why.skill` and `why.source` are variables of these names.
    """

    child: Node
    why: str | None
    handler: Node
    source: Position


class Finally(msgspec.Struct, frozen=True, tag="finally"):
    """Runs the child, then `last` once the child has succeeded or failed; ends as the child does."""

    child: Node
    last: Node
    source: Position


FAILURE_PARTS = ("kind", "message", "skill", "source")
"""What a failure tells, each a text."""

Decorator: TypeAlias = Retry | Repeat | Timeout | Try | Invert | Once
"""A node that changes the result of its child, or how often or how long it runs; its tag is its word."""

Node: TypeAlias = (
    Sequence
    | Selector
    | Parallel
    | Decorator
    | Wait
    | WaitUntil
    | If
    | While
    | ForEach
    | Check
    | Fail
    | Apply
    | Call
    | With
    | OnFailure
    | Finally
)


def name_failure(why: str) -> tuple[str, ...]:
    """Return the variables for the failure called `why`: that of the reason, and those of what else it tells."""
    return (why, *(f"{why}.{part}" for part in FAILURE_PARTS))


def kind_of(node: Node | type[Node]) -> str:
    """Return the tag of a node."""
    return str(node.__struct_config__.tag)


DECORATORS: Mapping[str, Callable[..., Decorator]] = {kind_of(each): each for each in get_args(Decorator)}
"""What makes each decorator, by its word, from the fields of its slots, `child` and `source`."""
