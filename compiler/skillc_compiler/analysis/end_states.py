"""Checks of the states in which a body ends: unproved posts, undeclared effects, changes left behind by a failure."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec import structs

from skillc_compiler.analysis.binding import definite_effects
from skillc_compiler.analysis.effects.declared import check_changes, check_each_declared, is_of_many, unchanged
from skillc_compiler.analysis.effects.leaks import writes_from_start
from skillc_compiler.analysis.effects.possible import Possibilities
from skillc_compiler.analysis.effects.universals import Universals
from skillc_compiler.analysis.exploration import CallEffect, Exploration
from skillc_compiler.analysis.findings import Finding, UnassignedOutput, UndeclaredEffect, UnprovedPost
from skillc_compiler.analysis.initial_state import requirements_of
from skillc_compiler.analysis.knowledge.alias_types import AliasTypes, is_any_individual
from skillc_compiler.analysis.knowledge.apply_effects import apply_effects
from skillc_compiler.analysis.knowledge.assume import assume
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import (
    PropertyWrite,
    RelationWrite,
    Write,
    normalise_each,
    write_of,
    written_condition,
)
from skillc_compiler.analysis.paths import EndStates, StatePaths, path_length
from skillc_compiler.analysis.released import find_last_call, find_leaked
from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.typed import Implementation, Requirement, TypedNode
from skillc_model.conditions import (
    Adjust,
    Aggregate,
    Arithmetic,
    Condition,
    Effect,
    Exists,
    Forall,
    ForEach,
    Holds,
    Invoke,
    IsA,
    Not,
    Or,
    PropertyOf,
    Same,
    Variable,
    single_effect,
    wanted_by,
)
from skillc_model.traversal import free_variables, walk


def end_findings(
    run: Exploration, implementation: Implementation, before: Sequence[State], ends: EndStates, universals: Universals
) -> Iterator[Finding]:
    """Yield the findings about the states in which an implementation ends.

    `before` are the state at its start and the declared ones; `universals` explores its body again.

    If a postcondition is not established, an undeclared effect usually has the same cause and is not reported.
    """
    unassigned: set[str] = set()
    unproved: list[Finding] = []
    run.check_reads((each.value for each in implementation.outputs), (), ends.success)
    computed = {each.name.text for each in implementation.outputs}
    for parameter in implementation.parameters:
        states = [path for state, path in ends.success.items() if parameter.name not in state.assigned]
        if parameter.direction == "out" and parameter.name not in computed and states:
            unassigned.add(parameter.name)
            yield UnassignedOutput(implementation, parameter, min(states, key=path_length))
    for post in (*requirements_of(implementation, "post"), *_join_outcomes(implementation)):
        if unassigned.isdisjoint(free_variables(post.condition.meaning)):
            unproved += _check_post(run, implementation, post, ends.success, universals)
    yield from unproved
    start = before[0]
    declared = [effect for _, effect in definite_effects(requirements_of(implementation, "post"))]
    effects = {one.effect: one for one in reversed(run.effects.values())}
    alike = {effect: [one for one in run.effects.values() if one.effect == effect] for effect in effects}
    possible = Possibilities(run, implementation, start)
    if not unproved:
        yield from possible.undeclared(ends.success)
        yield from possible.of_rounds(ends.success)
        changed = check_changes(implementation, effects.values(), declared, ends.success, universals)
        yield from possible.with_possible(changed)
    for one in effects.values():
        condition = None if _is_on_item(run, one.effect) else effect_condition(one.effect)
        if isinstance(one.effect, ForEach) and not unproved:
            each_changed = check_each_declared(implementation, one, one.effect, ends.success, universals)
            yield from possible.with_possible(each_changed)
        if condition is not None:
            if not unproved and not is_of_many(run, one, start):
                found = possible.with_possible(
                    _check_declared(run, implementation, alike[one.effect], condition, before, ends.success)
                )
                yield from (each for each in found if universals.may_last(one.effect, declared, ()))
            yield from find_leaked(run, one, condition, start, ends)


def undeclared_writes(
    run: Exploration, implementation: Implementation, before: Sequence[State], ends: EndStates
) -> frozenset[Write]:
    """Return the writes that a successful execution may leave behind and that the description does not declare.

    `before` are the state at its start and the declared ones.
    """
    found = set()
    body = implementation.body
    for write in writes_from_start(run, implementation, body) if isinstance(body, TypedNode) else ():
        condition = written_condition(write) if isinstance(write, RelationWrite | PropertyWrite) else None
        if condition is None or any(is_any_individual(part) for part in walk(condition)):
            if not _is_declared(run, implementation, write):
                found.add(write)
            continue
        if not all(_is_accounted_for(run.types, condition, before, state) for state in ends.success):
            found.add(write)
    return frozenset(found)


def effect_condition(effect: Effect) -> Condition | None:
    """Return the condition that an effect makes true, or None if it is not known."""
    write = write_of(effect)
    if not isinstance(write, RelationWrite | PropertyWrite):
        return None
    condition = written_condition(write)
    return (
        Not(condition) if condition is not None and isinstance(write, RelationWrite) and not write.value else condition
    )


def _is_accounted_for(types: AliasTypes, condition: Condition, before: Sequence[State], state: State) -> bool:
    now = evaluate(types, state, condition)
    return now is not None and any(evaluate(types, _with_identities(each, state), condition) is now for each in before)


def _with_identities(state: State, other: State) -> State:
    """Return the state with the identities and classes that the other knows, which never change."""
    return state.with_facts({fact: true for fact, true in other.facts.items() if isinstance(fact, Same | IsA)})


def _is_declared(run: Exploration, implementation: Implementation, write: Write) -> bool:
    """Whether a postcondition or an outcome declares the write, for any individual."""
    for _, effect in definite_effects((*requirements_of(implementation, "post"), *implementation.skill.outcomes)):
        own = write_of(effect)
        if isinstance(own, RelationWrite) and own == write and own.value is True:
            return True
        if isinstance(own, PropertyWrite) and isinstance(write, PropertyWrite) and own.property == write.property:
            return own.subject == write.subject and own.value is not None
    return False


def _check_post(
    run: Exploration, implementation: Implementation, post: Requirement, states: StatePaths, universals: Universals
) -> Iterator[Finding]:
    effects = [effect for _, effect in definite_effects((post,))]
    for effect in effects:
        if isinstance(effect, Adjust) and not post.sensed and not universals.whole.has_change(effect):
            instead = universals.whole.change_of(effect)
            yield UnprovedPost(implementation, post, False, False, None, instead=instead or unchanged(effect))
            return
    many = [effect for effect in effects if isinstance(effect, ForEach)]
    for effect in many:
        missing = [path for state, path in states.items() if normalise_each(effect) not in state.done]
        established = universals.is_established(effect) if missing else True
        if missing and not established:
            beyond = established is None and _is_beyond(run.types, effect.when)
            yield UnprovedPost(implementation, post, established is False, beyond, min(missing, key=path_length))
            return
    if many:
        return
    condition = post.condition.meaning
    known = {state: evaluate(run.types, state, condition) for state in states}
    for value in (False, None):
        found = [path for state, path in states.items() if known[state] is value]
        if found:
            beyond = value is None and _is_beyond(run.types, condition)
            yield UnprovedPost(implementation, post, value is False, beyond, min(found, key=path_length))
            return


def _is_beyond(types: AliasTypes, condition: Condition) -> bool:
    """Whether a condition cannot be decided here: it is about all individuals, chains or computed values."""
    for part in walk(condition):
        match part:
            case Exists() | Forall() | Invoke() | Arithmetic() | Aggregate():
                return True
            case Holds(relation=relation):
                if types.is_computed(relation):
                    return True
                if types.axioms.canonical.get(relation, (relation, False))[0] in types.axioms.chained:
                    return True
            case PropertyOf(property=iri):
                term = types.vocabulary.properties.get(iri)
                if term is None or term.computed_by is not None:
                    return True
    return False


def declared_states(run: Exploration, implementation: Implementation, start: State) -> tuple[State, ...]:
    """Return what a caller may assume after a success, one state an outcome."""
    posts = requirements_of(implementation, "post")
    endings = [(*posts, each) for each in implementation.skill.outcomes] or [posts]
    return tuple(_declared_state(run, each, start) for each in endings)


def _declared_state(run: Exploration, posts: Sequence[Requirement], start: State) -> State:
    state = apply_effects(run.types, start, [effect for _, effect in definite_effects(posts)])
    for post in posts:
        state = assume(run.types, state, post.condition.meaning) or state
    return state


def _join_outcomes(implementation: Implementation) -> Iterator[Requirement]:
    """Yield the promise that an outcome comes true, if there are any; which exclude each other."""
    outcomes = implementation.skill.outcomes
    if outcomes:
        either = TypedCondition(Or(tuple(each.condition.meaning for each in outcomes)), outcomes[0].condition.span)
        text = " or ".join(each.text for each in outcomes)
        yield structs.replace(outcomes[0], condition=either, text=text)


def _check_declared(
    run: Exploration,
    implementation: Implementation,
    alike: Sequence[CallEffect],
    condition: Condition,
    before: Sequence[State],
    states: StatePaths,
) -> Iterator[UndeclaredEffect]:
    """Yield an effect, which several calls may have, if it may last; of the last call on a path that leads there."""
    measured = [each for each in alike if not each.post.sensed]
    if not measured or any(
        _same_but_for_names(run, measured[0].effect, own)
        for _, own in definite_effects(requirements_of(implementation, "post"))
    ):
        return
    for state, path in sorted(states.items(), key=lambda each: path_length(each[1])):
        last = find_last_call(path, measured)
        if (
            last is not None
            and evaluate(run.types, state, condition)
            and not any(evaluate(run.types, _with_identities(each, state), condition) for each in before)
        ):
            yield UndeclaredEffect(implementation, last.call, last.post, last.effect, path)
            return


def _is_on_item(run: Exploration, effect: Effect) -> bool:
    """Whether an effect is on the item of a round, which has no name any more in the end."""
    names = (name for name in free_variables(wanted_by(single_effect(effect))) if "@" not in name)
    return not isinstance(effect, ForEach) and not run.stable | run.outputs >= {*names}


def _same_but_for_names(run: Exploration, effect: Effect, own: Effect) -> bool:
    """Whether both are the same effect if an inferred individual is the one that the caller names."""
    one, other = write_of(effect), write_of(own)
    match one, other:
        case RelationWrite(), RelationWrite():
            if (one.relation, one.value) != (other.relation, other.value):
                return False
            return _may_mean(run, one.subject, other.subject) and _may_mean(run, one.object, other.object)
        case PropertyWrite(), PropertyWrite():
            return one.property == other.property and _may_mean(run, one.subject, other.subject)
    return False


def _may_mean(run: Exploration, one: object, other: object) -> bool:
    if one == other:
        return True
    return isinstance(one, Variable) and "@" in one.name
