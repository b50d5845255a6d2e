"""The effects of a loop over individuals: those of its rounds, on each individual that has a round."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.exploration import CallEffect, Exploration
from skillc_compiler.analysis.knowledge.apply_effects import on_known_members
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.paths import Path, StatePaths, add_state
from skillc_compiler.program.typed import TypedNode
from skillc_compiler.program.walk import calls_in
from skillc_model.conditions import (
    Adjust,
    Aggregate,
    And,
    Anything,
    Exists,
    ForEach,
    Retract,
    SingleEffect,
    Variable,
    wanted_by,
)
from skillc_model.rewriting import ALWAYS
from skillc_model.traversal import free_variables_in_order


def with_loop_effects(
    run: Exploration, node: TypedNode, items: Aggregate, starts: StatePaths, ended: StatePaths
) -> dict[State, Path]:
    """Return the states after a round, with the effects on many that all rounds of the loop may have together."""
    calls = {id(call): call for call in calls_in(node)}
    effects = [one for one in run.effects.values() if id(one.call) in calls and _is_on(one, items.variable)]
    found: dict[State, Path] = {}
    for state, path in ended.items():
        lasting = [one for one in effects if _lasts(run, state, one)]
        for one in (each for each in lasting if _is_on_another(run, state, each, items.variable)):
            run.unsayable.setdefault((id(one.call), id(one.post), one.effect), one)
        many = {each for one in lasting for each in _effects_of_loop(run, one, items, starts)}
        add_state(found, state.with_effects(many), path)
    return found


def _effects_of_loop(run: Exploration, one: CallEffect, items: Aggregate, starts: StatePaths) -> Iterator[ForEach]:
    """Yield the effects of all rounds by an effect of a call, and note those that are on known individuals."""
    whole = _for_all(run, one, items)
    if whole is None:
        run.unsayable.setdefault((id(one.call), id(one.post), one.effect), one)
        return
    members = [each for state in starts for each in on_known_members(run.types, state, whole)]
    for each in dict.fromkeys(members):
        run.effects.setdefault((id(one.call), id(one.post), each), CallEffect(one.call, one.post, each, of_loop=True))
        if isinstance(each, ForEach):
            yield each


def _is_on(one: CallEffect, item: str) -> bool:
    return item in free_variables_in_order(one.effect)


def _is_on_another(run: Exploration, state: State, one: CallEffect, item: str) -> bool:
    """Whether an effect on the item of a round is also on that of another loop, so that each may be any."""
    others = (name for name in free_variables_in_order(one.effect) if name not in run.stable | state.aliases.keys())
    return any("@" not in name for name in others if name != item)


def _lasts(run: Exploration, state: State, one: CallEffect) -> bool:
    """Whether an effect of a call is still there at the end of a round."""
    if isinstance(one.effect, ForEach):
        return one.effect in state.had
    return isinstance(one.effect, Adjust) or bool(evaluate(run.types, state, wanted_by(one.effect)))


def _for_all(run: Exploration, one: CallEffect, items: Aggregate) -> ForEach | None:
    """Return an effect of a call in a loop as that of all rounds; None if no effect on many can say it.

    An effect on many in each round is one on all for which some round has it.
    """
    name, effect = items.variable, one.effect
    if not isinstance(effect, ForEach):
        return ForEach(name, items.cls, items.where, _without_found(run, effect))
    if name in free_variables_in_order(effect.effect):
        return None
    when = And(tuple(each for each in (items.where, effect.when) if each != ALWAYS))
    return ForEach(effect.variable, effect.cls, Exists(name, items.cls, when), effect.effect)


def _without_found(run: Exploration, effect: SingleEffect) -> SingleEffect:
    """Return the end of a relation to what each round finds at run time as that of any, if there is only one."""
    if not isinstance(effect, Retract):
        return effect
    relation = run.types.vocabulary.relations.get(effect.relation)
    if relation is None:
        return effect
    subject, object_ = effect.subject, effect.object
    if relation.functional and _is_found(object_):
        object_ = Anything()
    elif relation.inverse_functional and _is_found(subject):
        subject = Anything()
    return Retract(subject, effect.relation, object_)


def _is_found(term: object) -> bool:
    return isinstance(term, Variable) and "@" in term.name
