"""Equality modulo layout: two sources have the same syntax tree and the same comments."""

from __future__ import annotations

import re

import msgspec

from skillc_dsl.comments import find_comments
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source, Span

_WRITTEN = ("text", "goal_text")
"""Fields that hold the source text of a condition."""
_TEXT_OR_BLANK = re.compile(r'("[^"\n]*")|\s+')


def equal_modulo_layout(left: Source, right: Source) -> bool:
    """Whether both parse without errors to the same tree and have the same comments in the same order."""
    trees = parse(left), parse(right)
    if not all(tree.ok for tree in trees):
        return False
    notes = ([comment.written for comment in find_comments(source)] for source in (left, right))
    return _flat(trees[0].value) == _flat(trees[1].value) and next(notes) == next(notes)


def _flat(tree: object) -> list[object]:
    """Return the content of a tree in order, without places; brackets mark its nested parts."""
    result: list[object] = []
    pending: list[object] = [tree]
    while pending:
        node = pending.pop()
        match node:
            case Span():
                continue
            case tuple():
                pending += [_END, *reversed(node), "("]
            case msgspec.Struct():
                pending += [_END, *reversed([_field(node, name) for name in node.__struct_fields__])]
                result.append(type(node))
            case _:
                result.append(node)
    return result


_END = ")"


def _field(node: object, name: str) -> object:
    value = getattr(node, name)
    return _TEXT_OR_BLANK.sub(r"\1", value) if name in _WRITTEN and isinstance(value, str) else value
