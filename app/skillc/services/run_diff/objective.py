"""Compares what two runs were to do: their goals, their calls, or the nodes of their bodies."""

from __future__ import annotations

import re
from collections.abc import Iterator

from skillc.contract.runs.run_diff import Difference
from skillc.services.run_diff.alignment import align
from skillc.services.run_diff.difference import find_difference
from skillc_dsl.descriptions.nodes import DECORATOR_OF
from skillc_dsl.descriptions.rows import SlotKind
from skillc_model.conditions import Expression
from skillc_model.format_condition import format_condition, format_expression
from skillc_model.traversal import children
from skillc_model.tree import (
    Apply,
    Call,
    Check,
    Fail,
    Finally,
    ForEach,
    If,
    Node,
    OnFailure,
    Parallel,
    Selector,
    Sequence,
    Wait,
    WaitUntil,
    While,
    With,
    kind_of,
)
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.recording.events import TaskStarted

_NAMESPACE = re.compile(r"(?<![a-z\"])[a-z]+://[^\"\s]*[#/]")
_WORDS = Vocabulary()
"""A recording does not keep the prefixes of names, which are shown by their local parts."""


def compare_objectives(first: TaskStarted, second: TaskStarted) -> Iterator[Difference]:
    """Yield the goals if they differ, or the nodes of two bodies that differ or that only one run has."""
    one, other = _describe(first), _describe(second)
    if first.goal is not None or second.goal is not None:
        yield from _find_difference("; ".join(one), "; ".join(other))
        return
    for pair in align(one, other, lambda line: line, _first_word):
        yield from _find_difference(*pair)


def _find_difference(one: str | None, other: str | None) -> tuple[Difference, ...]:
    """Return a difference by local names, or by whole names if the local ones are the same."""
    first, second = (None if each is None else _NAMESPACE.sub("", each) for each in (one, other))
    return find_difference("settings", "objective", (one, other) if first == second else (first, second))


def _first_word(line: str) -> str:
    """Return the skill of a call, or the kind of another node."""
    return re.split(r"\W", line.removeprefix("reactive "), maxsplit=1)[0]


def _describe(start: TaskStarted) -> list[str]:
    """Return a goal, or the nodes of a body in order, as an author writes them."""
    if start.goal is not None:
        return [format_condition(start.goal, _WORDS)]
    return [] if start.body is None else list(_list_nodes(start.body))


def _list_nodes(node: Node) -> Iterator[str]:
    yield _describe_node(node)
    inner = (each for each in children(node) if isinstance(each, Node))
    yield from (line for each in inner for line in _list_nodes(each))


def _describe_node(node: Node) -> str:
    """Return a node as an author writes it, without the nodes inside it."""
    match node:
        case Call():
            return _describe_call(node)
        case Sequence(reactive=reactive) | Selector(reactive=reactive):
            return f"{'reactive ' if reactive else ''}{_kind(node)}"
        case Parallel(policy=policy):
            return f"par {policy}"
        case Wait(seconds=seconds):
            return f"wait {_slot(seconds)}"
        case ForEach(variable=variable, items=items):
            return f"for {variable} in {format_expression(items, _WORDS)}"
        case While(text=text, limit=limit):
            return f"while {text} max {limit}"
        case WaitUntil(text=text) | If(text=text) | Check(text=text):
            return f"{_kind(node)} {text}"
        case OnFailure(why=why):
            return f"on failure as {why}" if why else "on failure"
        case Fail(reason=reason):
            return f"fail {format_expression(reason, _WORDS)}"
        case Apply(labels=labels):
            return f"apply {', '.join(labels)}"
        case With() | Finally():
            return _kind(node)
        case _:
            row = DECORATOR_OF[kind_of(node)]
            return " ".join((row.kind, *(_slot(getattr(node, slot.field), slot.kind) for slot in row.slots)))


def _slot(value: int | Expression, kind: SlotKind = "time") -> str:
    if isinstance(value, int):
        return str(value)
    return f"{format_expression(value, _WORDS)}{' s' if kind == 'time' else ''}"


def _describe_call(call: Call) -> str:
    fixed = f"[{call.implementation}]" if call.implementation else ""
    given = ", ".join(f"{name}: {format_expression(each, _WORDS)}" for name, each in call.arguments.items())
    return f"{call.skill}{fixed}({given}){f' -> {call.out}' if call.out else ''}"


def _kind(node: Node) -> str:
    return kind_of(node).replace("-", " ")
