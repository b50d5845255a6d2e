"""What the text of a class assigns, and what it does with `outputs`: found in one walk, for all who ask."""

from __future__ import annotations

import ast
from functools import lru_cache
from typing import NamedTuple

MOST = 512
"""Of how many classes the texts are kept."""


class Use(NamedTuple):
    """A place that names `outputs` as an attribute, the node around it, and the one around that."""

    node: ast.Attribute
    around: ast.AST | None
    further: ast.AST | None


class ClassText(NamedTuple):
    """What is looked for in the text of a class; `gives_itself` if it passes `self` to a call."""

    gives_itself: bool
    outputs: tuple[Use, ...]
    assignments: tuple[ast.Assign, ...]


@lru_cache(MOST)
def read_class(node: ast.ClassDef) -> ClassText:
    """Return what is looked for in a class, with the functions and classes inside it; assignments in their order."""
    gives_itself, outputs, assignments = False, list[Use](), list[ast.Assign]()
    waiting: list[tuple[ast.AST, ast.AST | None, ast.AST | None]] = [(node, None, None)]
    while waiting:
        each, around, further = waiting.pop()
        match each:
            case ast.Name() | ast.Constant():
                continue
            case ast.Call(args=args):
                gives_itself |= any(isinstance(given, ast.Name) and given.id == "self" for given in args)
            case ast.Attribute(attr="outputs"):
                outputs.append(Use(each, around, further))
            case ast.Assign():
                assignments.append(each)
        waiting += [(child, each, around) for child in ast.iter_child_nodes(each)]
    return ClassText(gives_itself, tuple(outputs), tuple(sorted(assignments, key=lambda line: line.lineno)))
