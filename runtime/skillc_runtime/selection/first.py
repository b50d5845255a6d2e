"""Whether what a body starts with can start in the world as it is."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.library import tree
from skillc_compiler.library.reading import free_variables
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.selection.preflight import Refusal
from skillc_runtime.selection.select import NoneFits, select, why_none
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState


def first_refusals(body: tree.Node, library: SkillLibrary, state: WorldState) -> Iterator[Refusal]:
    """Yield why the calls that a body starts with, before anything else can have changed the world, cannot start."""
    for call in _first_calls(body):
        if any(free_variables(argument) for argument in call.arguments.values()):
            continue
        try:
            arguments = {name: value_of(argument, state, {}) for name, argument in call.arguments.items()}
            chosen = select(library, call.skill, arguments, state, call.implementation)
        except EvaluationError as error:
            yield Refusal(call.skill, f"{call.skill}: {error}", call.source)
            continue
        if isinstance(chosen, NoneFits):
            yield Refusal(call.skill, why_none(call.skill, chosen.rejected), call.source, (), chosen.rejected)


def _first_calls(node: tree.Node) -> Iterator[tree.Call]:
    """Yield the calls that begin at once, and whose failure is the body's."""
    match node:
        case tree.Call():
            yield node
        case tree.Sequence(children=(first, *_)):
            yield from _first_calls(first)
        case tree.With(call=call):
            yield call
        case tree.Parallel(children=children, policy="all"):
            for child in children:
                yield from _first_calls(child)
        case tree.Retry() | tree.Repeat() | tree.Timeout() | tree.Once():
            yield from _first_calls(node.child)
        case _:
            return
