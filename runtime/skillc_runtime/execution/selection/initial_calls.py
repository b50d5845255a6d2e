"""Checks whether the calls that a body starts with can start in the current world."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_dsl.descriptions.nodes import DECORATOR_OF
from skillc_model import tree
from skillc_model.skills import SkillLibrary
from skillc_model.traversal import free_variables
from skillc_runtime.execution.selection.refusal import Refusal
from skillc_runtime.execution.selection.select import NoneSelected, explain_none_selected, select_implementation
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState


def initial_call_refusals(body: tree.Node, library: SkillLibrary, state: WorldState) -> Iterator[Refusal]:
    """Yield why calls cannot start that a body starts with, before anything else can have changed the world."""
    for call in _initial_calls(body):
        if any(free_variables(argument) for argument in call.arguments.values()):
            continue
        try:
            arguments = {name: value_of(argument, state, {}) for name, argument in call.arguments.items()}
            chosen = select_implementation(library, call.skill, arguments, state, call.implementation)
        except EvaluationError as error:
            yield Refusal(call.skill, f"{call.skill}: {error}", call.source)
            continue
        if isinstance(chosen, NoneSelected):
            yield Refusal(
                call.skill, explain_none_selected(call.skill, chosen.rejected), call.source, (), chosen.rejected
            )


def _initial_calls(node: tree.Node) -> Iterator[tree.Call]:
    """Yield the calls that start at once and whose failure is the failure of the body."""
    match node:
        case tree.Call():
            yield node
        case tree.Sequence(children=(first, *_)):
            yield from _initial_calls(first)
        case tree.With(call=call):
            yield call
        case tree.Finally(child=child):
            yield from _initial_calls(child)
        case tree.Parallel(children=children, policy="all", after=after):
            for index, child in enumerate(children):
                if not after or not after[index]:
                    yield from _initial_calls(child)
        case _ if isinstance(node, tree.Decorator) and DECORATOR_OF[tree.kind_of(node)].on_failure != "success":
            yield from _initial_calls(node.child)
