"""Where the values of a call come from: the expressions of its arguments and defaults, and what these read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeAlias, cast

import msgspec

from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import Expression, Literal, Variable
from skillc_model.format_condition import format_expression
from skillc_model.skills import Implementation, SkillLibrary, Task
from skillc_model.traversal import children, free_variables_in_order, walk
from skillc_model.tree import Call, ForEach
from skillc_rdf.vocabulary.types import ListType, ValueType
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.lexical_scope import LexicalScope
from skillc_runtime.execution.tree.node import Node
from skillc_runtime.execution.tree.nodes.loop_nodes import ForEachNode
from skillc_runtime.recording.reasons import NameInExpression, WrittenExpression
from skillc_runtime.world.eval.deciding_facts import facts_read
from skillc_runtime.world.eval.expressions import type_of, value_of
from skillc_runtime.world.eval.identity_cache import IdentityCache
from skillc_runtime.world.state.labels.labelled import LabelledValue
from skillc_runtime.world.state.labels.labelled_text import format_value
from skillc_runtime.world.state.labels.labelling import label_value
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

_Index: TypeAlias = Mapping[tuple[Position, str], tuple[Task, Expression]]
"""The expressions in bodies of tasks by the place of the node and the name that gets the value."""


def explain_arguments(
    call: tree.Call,
    implementation: Implementation,
    values: Mapping[str, LabelledValue],
    bindings: Mapping[str, Value],
    body: EnclosingBody,
) -> dict[str, WrittenExpression]:
    """Return the expressions of the arguments, and of the defaults that were taken, by parameter.

    `values` are the `bindings` of the parameters with labels and units, `body` is that in which the call stands.
    """
    found: dict[str, WrittenExpression] = {}
    for each in implementation.parameters:
        written, value = call.arguments.get(each.name), values.get(each.name)
        if value is None:
            continue
        if written is not None:
            found[each.name] = body.write(each.name, written, call.source, value)
        elif each.default is not None:
            facts = facts_read(each.default, body.state, bindings)
            text = _write(each.default, value, body.state)
            found[each.name] = WrittenExpression(text=text, source=each.source, facts=facts)
    return found


class EnclosingBody:
    """The body in which a call stands; it knows what the names in its expressions stand for."""

    def __init__(self, node: Node, scope: LexicalScope, context: TreeContext) -> None:
        self.state = context.state
        self._library = context.library
        self._scope = scope
        self._loops = {loop.variable: loop for loop in _loops_around(node)}
        owner = scope.implementation
        self._lets = {let.name: (let.value, owner.source) for let in owner.lets} if owner is not None else {}
        self._parameters = {each.name for each in owner.parameters} if owner is not None else frozenset[str]()

    def write(
        self, name: str, expression: Expression, source: Position, value: LabelledValue | None = None
    ) -> WrittenExpression:
        """Return the expression that gives a name its value, with what it reads; a constant as its labelled `value`."""
        return self._write_in(self.state, _find_original(self._library, source, name, expression), source, value)

    def _write_in(
        self, state: WorldState, original: OriginalExpression, source: Position, value: LabelledValue | None = None
    ) -> WrittenExpression:
        given = {name: value_of(each, self.state, {}) for name, (each, _) in original.given.items()}
        explained = {
            name: NameInExpression(name=name, how="given", value=label_value(given[name], type_, self.state.vocabulary))
            for name, (_, type_) in original.given.items()
        }
        names = free_variables_in_order(original.expression)
        return WrittenExpression(
            text=_write(original.expression, value, state),
            source=source,
            facts=facts_read(original.expression, state, {**self._scope.frame, **given}),
            names=tuple(explained.get(each) or self._explain(each) for each in names),
        )

    def _explain(self, name: str) -> NameInExpression:
        if name in self._loops:
            return self._explain_item(name, self._loops[name])
        if name in self._lets:
            read = self._scope.lets_read if self._scope.lets_read is not None else self.state
            expression, source = self._lets[name]
            let = self._write_in(read, OriginalExpression(expression), source)
            return NameInExpression(name=name, how="let", expression=let)
        return NameInExpression(name=name, how="parameter" if name in self._parameters else "output")

    def _explain_item(self, name: str, loop: tree.ForEach) -> NameInExpression:
        """Return the loop of a variable, with the present item if its type is known."""
        type_, value = type_of(loop.items, self.state.vocabulary), self._scope.frame[name]
        item = label_value(value, type_.element, self.state.vocabulary) if isinstance(type_, ListType) else None
        items = self.write(name, loop.items, loop.source)
        return NameInExpression(name=name, how="loop", expression=items, value=item)


def _write(expression: Expression, value: LabelledValue | None, state: WorldState) -> str:
    if isinstance(expression, Literal) and value is not None:
        return format_value(value)
    return format_expression(expression, state.vocabulary)


def _loops_around(node: Node) -> Iterator[tree.ForEach]:
    """Yield the loops over items around a node in the same body, the outermost first."""
    around = node.parent
    if around is None or around.kind == "call":
        return
    yield from _loops_around(around)
    if isinstance(around, ForEachNode):
        yield around.node


class OriginalExpression(msgspec.Struct, frozen=True):
    """An expression as it is written, and the values, with their types, of the parameters of a task that it names."""

    expression: Expression
    given: Mapping[str, tuple[Expression, ValueType]] = msgspec.field(default_factory=dict)


def _find_original(library: SkillLibrary, source: Position, name: str, bound: Expression) -> OriginalExpression:
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
