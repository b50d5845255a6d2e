"""The expressions of a task as its author wrote them: in a body that runs, values stand in place of its parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeAlias, cast

import msgspec

from skillc_dsl.position import Position
from skillc_model.conditions import Expression, Variable
from skillc_model.skills import SkillLibrary, Task
from skillc_model.traversal import children, walk
from skillc_model.tree import Call, ForEach
from skillc_rdf.vocabulary.types import ValueType
from skillc_runtime.world.eval.identity_cache import IdentityCache

_Index: TypeAlias = Mapping[tuple[Position, str], tuple[Task, Expression]]
"""The expressions in bodies of tasks by the place of the node and the name that gets the value."""


class OriginalExpression(msgspec.Struct, frozen=True):
    """An expression as it is written, and the values, with their types, of the parameters of a task that it names."""

    expression: Expression
    given: Mapping[str, tuple[Expression, ValueType]] = msgspec.field(default_factory=dict)


def find_original(library: SkillLibrary, source: Position, name: str, bound: Expression) -> OriginalExpression:
    """Return how an expression of a task is written in which values stand in place of parameters.

    It is at `source` the argument `name` of a call, or the items of the loop with the variable `name`. Another
    expression is returned as it is.
    """
    found = _indexed(library).get((source, name))
    if found is None:
        return OriginalExpression(bound)
    task, written = found
    types = {each.name: each.type for each in task.parameters}
    values = {each: (value, types[each]) for each, value in _replaced(written, bound) if each in types}
    return OriginalExpression(written, values)


def _replaced(written: msgspec.Struct, bound: msgspec.Struct) -> Iterator[tuple[str, Expression]]:
    """Yield the names in an expression with what stands in their place."""
    if isinstance(written, Variable):
        yield written.name, cast(Expression, bound)
        return
    for part, with_values in zip(children(written), children(bound), strict=True):
        yield from _replaced(part, with_values)


def _index(library: SkillLibrary) -> _Index:
    return {
        (node.source, name): (task, expression)
        for task in library.tasks.values()
        if task.parameters and task.body is not None
        for node in walk(task.body)
        if isinstance(node, Call | ForEach)
        for name, expression in _named_expressions(node).items()
    }


def _named_expressions(node: Call | ForEach) -> Mapping[str, Expression]:
    return node.arguments if isinstance(node, Call) else {node.variable: node.items}


_indexed = IdentityCache(_index)
