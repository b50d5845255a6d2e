"""Compares what two runs were to do: their goals, their calls, or the nodes of their bodies."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec

from skillc.contract.run_diff import Difference
from skillc.services.run_diff.alignment import align
from skillc.services.run_diff.difference import find_difference
from skillc_model.format_condition import format_condition, format_expression
from skillc_model.traversal import children
from skillc_model.tree import Call, ForEach, Parallel, Repeat, Retry, Timeout, Wait, While
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.recording.events import TaskStarted

_NAMESPACE = re.compile(r"(?<![a-z])[a-z]+://[^\"\s]*[#/]")
_WORDS = Vocabulary()
"""A recording does not keep the prefixes of names, which are shown by their local parts."""


def compare_objectives(first: TaskStarted, second: TaskStarted) -> Iterator[Difference]:
    """Yield the goals if they differ, or the nodes of two bodies that differ or that only one run has."""
    one, other = _describe(first), _describe(second)
    if first.goal is not None or second.goal is not None:
        yield from find_difference("settings", "objective", ("; ".join(one), "; ".join(other)))
        return
    for pair in align(one, other, lambda line: line, _first_word):
        yield from find_difference("settings", "objective", pair)


def _first_word(line: str) -> str:
    """Return the skill of a call, or the kind of another node."""
    return re.split(r"\W", line, maxsplit=1)[0]


def _describe(start: TaskStarted) -> list[str]:
    """Return a goal, or the nodes of a body in order, as an author writes them."""
    if start.goal is not None:
        lines = [format_condition(start.goal, _WORDS)]
    else:
        lines = [] if start.body is None else list(_list_nodes(start.body))
    return [_NAMESPACE.sub("", line) for line in lines]


def _list_nodes(node: msgspec.Struct) -> Iterator[str]:
    yield _describe_node(node)
    if not isinstance(node, Call):
        inner = (each for each in children(node) if hasattr(each, "source"))
        yield from (line for each in inner for line in _list_nodes(each))


def _describe_node(node: msgspec.Struct) -> str:
    match node:
        case Call(skill, implementation, arguments):
            given = ", ".join(f"{name}: {format_expression(each, _WORDS)}" for name, each in arguments.items())
            return f"{skill}{f'[{implementation}]' if implementation else ''}({given})"
        case Retry(count) | Repeat(count):
            return f"{_kind(node)} {count}"
        case Timeout(seconds) | Wait(seconds):
            return f"{_kind(node)} {format_expression(seconds, _WORDS)} s"
        case Parallel(policy):
            return f"par {policy}"
        case ForEach(variable, items):
            return f"for {variable} in {format_expression(items, _WORDS)}"
        case While(text=text, limit=limit):
            return f"while {text} max {limit}"
        case _:
            return f"{_kind(node)} {getattr(node, 'text', '')}".strip()


def _kind(node: msgspec.Struct) -> str:
    return str(node.__struct_config__.tag).replace("-", " ")
