"""Foresees how the calls of a body go in a scene, one after the other: with which implementation and individuals."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from skillc_compiler.ide.annotations.hints import CallChoice
from skillc_dsl.descriptions.nodes import DECORATOR_OF
from skillc_model import tree
from skillc_model.skills import SkillLibrary, Task, Test
from skillc_model.traversal import free_variables
from skillc_runtime.execution.selection.select import SelectedImplementation, select_implementation
from skillc_runtime.world.eval.effects import changes_of
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState


def foresee_choices(body: tree.Node, library: SkillLibrary, state: WorldState) -> tuple[CallChoice, ...]:
    """Return the choices of the calls in a body, as long as the world is known: each does what its skill states.

    It ends before what depends on more than facts: outcomes, outputs, loops, and blocks that may fail.
    """
    found: list[CallChoice] = []
    _follow(body, _Course(library, found), state)
    return tuple(found)


def start_of(task: Task, scene: WorldState) -> WorldState:
    """Return the world in which a task or test starts; that of its scene if what a test states contradicts it."""
    if not isinstance(task, Test) or not task.starts:
        return scene
    try:
        return WorldModel(scene).commit(changes_of(task.starts, scene, {})).after
    except (EvaluationError, WorldError):
        return scene


class _Course(NamedTuple):
    library: SkillLibrary
    found: list[CallChoice]


def _follow(node: tree.Node, course: _Course, state: WorldState) -> WorldState | None:
    """Add the choices of the calls in a node, and return the world after it; None if that is not known."""
    match node:
        case tree.Call():
            return _call(node, course, state)
        case tree.Sequence(children=children):
            return _in_order(children, course, state)
        case tree.With(call=call, child=child):
            return _in_order((call, child), course, state)
        case tree.Finally(child=child, last=last):
            return _in_order((child, last), course, state)
        case tree.Wait():
            return state
        case _ if isinstance(node, tree.Decorator) and DECORATOR_OF[tree.kind_of(node)].on_failure == "failure":
            return _follow(node.child, course, state)
        case _:
            return None


def _in_order(nodes: Sequence[tree.Node], course: _Course, state: WorldState) -> WorldState | None:
    after: WorldState | None = state
    for each in nodes:
        after = _follow(each, course, after) if after is not None else None
    return after


def _call(call: tree.Call, course: _Course, state: WorldState) -> WorldState | None:
    if any(free_variables(each) for each in call.arguments.values()):
        return None
    skill = course.library.skills[call.skill]
    try:
        arguments = {name: value_of(each, state, {}) for name, each in call.arguments.items()}
        chosen = select_implementation(course.library, call.skill, arguments, state, call.implementation)
        if not isinstance(chosen, SelectedImplementation):
            return None
        inferred = _inferred(chosen, call, state)
        course.found.append(CallChoice(call.source.line, call.source.column, chosen.implementation.name, inferred))
        if skill.outcomes or call.out is not None:
            return None
        changes = changes_of([effect for post in skill.post for effect in post.effects], state, chosen.bindings)
        return WorldModel(state).commit(changes).after
    except (EvaluationError, WorldError):
        return None


def _inferred(chosen: SelectedImplementation, call: tree.Call, state: WorldState) -> tuple[tuple[str, str], ...]:
    return tuple(
        (each.name, state.vocabulary.short(str(chosen.bindings[each.name])))
        for each in chosen.implementation.parameters
        if each.direction == "infer" and each.name not in call.arguments and each.name in chosen.bindings
    )
