"""Changes of numbers and effects on many that last to the end of a body, and that no postcondition declares."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from msgspec import structs

from skillc_compiler.analysis.binding import definite_effects
from skillc_compiler.analysis.effects.branches import branches_to
from skillc_compiler.analysis.effects.universals import Universals
from skillc_compiler.analysis.exploration import CallEffect, Exploration
from skillc_compiler.analysis.findings import UndeclaredEffect
from skillc_compiler.analysis.initial_state import requirements_of
from skillc_compiler.analysis.knowledge.apply_effects import is_member
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.paths import StatePaths, path_length
from skillc_compiler.analysis.released import contains_call
from skillc_compiler.logic.sums import UNCHANGED, effect_of
from skillc_compiler.program.typed import Implementation, TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_model.conditions import (
    Adjust,
    Assign,
    Effect,
    ForEach,
    Individual,
    ListValue,
    Variable,
    single_effect,
    wanted_by,
)
from skillc_model.rewriting import substitute
from skillc_model.traversal import free_variables


def check_changes(
    implementation: Implementation,
    effects: Iterable[CallEffect],
    declared: Sequence[Effect],
    states: StatePaths,
    universals: Universals,
) -> Iterator[UndeclaredEffect]:
    """Yield the changes of numbers of the skill's parameters that last and that no postcondition declares."""
    done = {(each.subject, each.property) for each in declared if isinstance(each, Adjust | Assign)}
    for one in (each for each in effects if not each.post.sensed):
        for effect in _on_named(implementation, one.effect):
            number = effect.subject, effect.property
            if number in done or not universals.whole.change_of(effect):
                continue
            done.add(number)
            if universals.may_last(effect, declared, ()):
                ways = [each for each in states.values() if contains_call(each, one.call)]
                way = min(ways, key=path_length, default=None)
                yield UndeclaredEffect(implementation, one.call, one.post, effect, way)


def _on_named(implementation: Implementation, effect: Effect) -> Iterator[Adjust]:
    """Yield a change of a number of what the skill has a name for; of each of a list, if it is on that of a round."""
    if not isinstance(effect, Adjust):
        return
    for node in nodes_in(implementation.body) if isinstance(implementation.body, TypedNode) else ():
        items = node.values[0].meaning if isinstance(node.written, s.For) else None
        name = Variable(node.written.variable.text) if isinstance(node.written, s.For) else None
        if isinstance(items, ListValue) and effect.subject == name:
            things = (each for each in items.items if isinstance(each, Variable | Individual))
            yield from (structs.replace(effect, subject=each) for each in things)
    if isinstance(effect.subject, Individual) or implementation.skill.parameter(effect.subject.name):
        yield effect


def unchanged(effect: Adjust) -> Adjust:
    """Return that a number stays as it is."""
    return effect_of(UNCHANGED, effect.subject, effect.property)


def is_of_many(run: Exploration, one: CallEffect, start: State) -> bool:
    """Whether an effect on one individual is, for all that is known at the start, a part of one on many."""
    many = (
        other.effect
        for other in run.effects.values()
        if isinstance(other.effect, ForEach) and other.call is one.call and other.post is one.post
    )
    things = [Variable(name) for name in free_variables(wanted_by(single_effect(one.effect)))]
    return any(
        substitute(each.effect, {each.variable: thing}) == one.effect and bool(is_member(run.types, start, each, thing))
        for each in many
        for thing in things
    )


def check_each_declared(
    implementation: Implementation, one: CallEffect, effect: ForEach, states: StatePaths, universals: Universals
) -> Iterator[UndeclaredEffect]:
    """Yield an effect on all individuals that fulfil a condition which no postcondition declares, or replaces."""
    found = [path for state, path in states.items() if effect in state.had]
    declared = [own for _, own in definite_effects(requirements_of(implementation, "post"))]
    branches = tuple(branches_to(implementation, one.call, effect.variable))
    if not found or one.post.sensed:
        return
    if universals.may_last(effect, declared, branches) or universals.may_be_left(effect, declared):
        yield UndeclaredEffect(implementation, one.call, one.post, effect, min(found, key=path_length))
