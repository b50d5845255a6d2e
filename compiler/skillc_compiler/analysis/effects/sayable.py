"""The postcondition that declares an effect in the terms of a skill: only one that each success establishes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from skillc_compiler.analysis.binding import definite_effects
from skillc_compiler.analysis.effects.branches import branches_to
from skillc_compiler.analysis.effects.universals import Universals
from skillc_compiler.analysis.findings import Remedy
from skillc_compiler.analysis.initial_state import requirements_of
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.paths import EndStates
from skillc_compiler.logic.selection import types_overlap
from skillc_compiler.program.typed import Call, Implementation, Parameter, TypedNode
from skillc_compiler.program.types import Thing
from skillc_compiler.program.walk import calls_in
from skillc_model.conditions import (
    Adjust,
    And,
    Condition,
    Effect,
    ForEach,
    Not,
    Same,
    SingleEffect,
    Variable,
    wanted_by,
)
from skillc_model.rewriting import substitute
from skillc_model.traversal import conjuncts, free_variables, free_variables_in_order

EACH = "each"
"""The variable of an effect that is on one individual, in a branch."""


def declare(
    implementation: Implementation, call: Call, effect: Effect, ends: EndStates, universals: Universals
) -> Remedy | None:
    """Return what declares an effect of a call on parameters of a skill, or on outputs of calls; None if none does."""
    own = {each.name for each in implementation.skill.parameters}
    if isinstance(effect, Adjust):
        found = universals.whole.change_of(effect)
        return Remedy(after=(found,)) if found is not None and _is_said(found, own) else None
    if isinstance(effect, ForEach) and isinstance(effect.effect, Adjust):
        if own.issuperset(free_variables_in_order(effect)) and universals.is_done(effect):
            return Remedy(after=(effect,))
        each = universals.change_of_each(effect)
        return _declare_first((each,) if each is not None else (), own, universals)
    if isinstance(effect, ForEach):
        remedy = _declare_first(_with_exceptions(implementation, call, effect, universals), own, universals)
        is_whole = remedy is None or _leaves_nothing(implementation, call, effect, remedy, universals)
        return remedy if is_whole else None
    condition = wanted_by(effect)
    is_alone = len(universals.run.program.implementations_of[implementation.skill.name]) == 1
    given = _outputs(implementation) if is_alone else ()
    outputs = {name: of for name, of in given if name in free_variables(condition) - own}
    if not free_variables(condition) <= own | outputs.keys():
        return None
    if all(evaluate(universals.run.types, state, condition) for state in ends.success) and all(
        state.assigned >= outputs.keys() for state in ends.success
    ):
        return Remedy(outputs=tuple((name, of.declared) for name, of in outputs.items()), after=(condition,))
    if outputs:
        return None
    return _declare_first(_only_in_branch(implementation, call, effect, universals), own, universals)


def _is_said(effect: Adjust, own: set[str]) -> bool:
    """Whether the names of an effect are known to a skill."""
    return own.issuperset(free_variables_in_order(effect))


def _leaves_nothing(
    implementation: Implementation, call: Call, effect: ForEach, said: Remedy, universals: Universals
) -> bool:
    """Whether nothing is left to declare of an effect on many once a remedy says this of it."""
    declared = [own for _, own in definite_effects(requirements_of(implementation, "post"))]
    branches = tuple(branches_to(implementation, call, effect.variable))
    said_of_many = [each for each in said.after if isinstance(each, ForEach)]
    return not universals.may_last(effect, (*declared, *said_of_many), branches)


def _declare_first(effects: Iterable[ForEach], own: set[str], universals: Universals) -> Remedy | None:
    for effect in effects:
        if own.issuperset(free_variables_in_order(effect)) and universals.is_established(effect):
            return Remedy(after=(effect,))
    return None


def _with_exceptions(
    implementation: Implementation, call: Call, effect: ForEach, universals: Universals
) -> Iterator[ForEach]:
    """Yield an effect on many, then the same where the call is reached, and on others than the skill's parameters."""
    branches = tuple(branches_to(implementation, call, effect.variable))
    vocabulary, item = universals.run.types.vocabulary, Variable(effect.variable)
    fitting = (
        each.name
        for each in implementation.parameters
        if isinstance(each.type, Thing) and each.name != item.name
        if types_overlap(vocabulary, each.type, Thing(effect.cls))
    )
    named = tuple(Not(Same(item, Variable(name))) for name in fitting)
    for more in dict.fromkeys(((), branches, named, (*branches, *named))):
        yield ForEach(effect.variable, effect.cls, _all_of((*conjuncts(effect.when), *more)), effect.effect)


def _only_in_branch(
    implementation: Implementation, call: Call, effect: SingleEffect, universals: Universals
) -> Iterator[ForEach]:
    """Yield an effect on one individual in a branch as that on each which is the one, if the branch is taken."""
    branches = tuple(branches_to(implementation, call))
    thing = effect.subject
    if branches and isinstance(thing, Variable) and implementation.skill.parameter(EACH) is None:
        cls = universals.run.types.class_of(thing)
        named = substitute(effect, {thing.name: Variable(EACH)})
        yield ForEach(EACH, cls, _all_of((Same(Variable(EACH), thing), *branches)), named)


def _all_of(conditions: Iterable[Condition]) -> Condition:
    parts = tuple(dict.fromkeys(part for each in conditions for part in conjuncts(each)))
    return parts[0] if len(parts) == 1 else And(parts)


def _outputs(implementation: Implementation) -> Iterator[tuple[str, Parameter]]:
    """Yield what calls give by `->`, with the parameter that it is."""
    for call in calls_in(implementation.body) if isinstance(implementation.body, TypedNode) else ():
        given = [each for each in (call.skill.parameters if call.skill else ()) if each.direction == "out"]
        if call.out is not None and given:
            yield call.out.text, given[0]
