"""What is known of the item of each round in a loop over the individuals of which a condition holds, and of all."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from typing import TypeAlias

from skillc_compiler.analysis.exploration import EvalContext, Exploration, explore_sequence
from skillc_compiler.analysis.knowledge.alias_types import same_individual
from skillc_compiler.analysis.knowledge.assume import assume, unify
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.quantifiers import known_individuals
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State, join
from skillc_compiler.analysis.paths import Path, StatePaths, add_state, havoc_all, widen
from skillc_compiler.program.typed import TypedNode
from skillc_model.conditions import Aggregate, Condition, Variable
from skillc_model.rewriting import substitute

Begin: TypeAlias = Callable[[StatePaths], StatePaths]
ANY_ONE = "any of them"
"""How the names of individuals begin that a proof is about, whichever they are; no name in a file has spaces."""
MAX_NARROWINGS = 4
"""The number of times that what all rounds keep is narrowed."""


def enter(states: StatePaths) -> StatePaths:
    """Return the states in which a round begins, of whose item nothing is known."""
    return states


def enter_with_member(run: Exploration, items: Aggregate, states: StatePaths) -> StatePaths:
    """Return the states in which a round begins, of whose item the condition of the loop holds."""
    found: dict[State, Path] = {}
    for state, path in states.items():
        known = assume(run.types, state, items.where)
        if known is not None:
            add_state(found, known, path)
    return found


def keeps_members(
    run: Exploration, node: TypedNode, items: Aggregate, states: StatePaths, context: EvalContext
) -> bool:
    """Whether each round leaves true what the loop demands of its items, for all items that follow.

    That is so if it is so for one other individual, of which as much is known as of any at the start of a round.
    """
    if run.monitor is not None:
        return False
    name = f"{items.variable} later"
    run.types.classes[name] = items.cls
    of_other = substitute(items.where, {items.variable: Variable(name)})
    starts: dict[State, Path] = {}
    for state in enter_with_member(run, items, havoc_all(run.types, states, run.writes(node))):
        both = assume(run.types, state, of_other)
        if both is not None:
            apart = both.with_facts({same_individual(Variable(items.variable), Variable(name)): False})
            add_state(starts, apart, None)
    run.quiet += 1
    ends = explore_sequence(run, node.children, widen(starts), context)
    run.quiet -= 1
    return all(evaluate(run.types, state, of_other) is True for state in ends.success)


def split_by_members(run: Exploration, items: Aggregate, states: StatePaths) -> Iterator[dict[State, Path]]:
    """Yield the states in groups, in each of which it is known whether what a proof is about has a round."""
    names = [Variable(name) for name in sorted(run.stable) if name.startswith(ANY_ONE)]
    groups: dict[tuple[bool | None, ...], dict[State, Path]] = {}
    for state, path in states.items():
        known = [state]
        for name in names:
            fulfils = substitute(items.where, {items.variable: name})
            split = (assume(run.types, each, fulfils, holds) for each in known for holds in (True, False))
            known = [each for each in split if each is not None]
        for each in known:
            key = tuple(is_member(run, items, each, name) for name in names)
            groups.setdefault(key, {})[each] = path
    yield from groups.values()


def members_and_others(
    run: Exploration, node: TypedNode, items: Aggregate, states: StatePaths
) -> tuple[list[IndividualTerm], list[IndividualTerm]]:
    """Return the individuals that certainly have a round, whichever of these states a loop starts in, and have none."""
    if run.monitor is not None or not states:
        return [], []
    names = map(Variable, sorted(run.stable & run.types.classes.keys()))
    found = dict.fromkeys((*known_individuals(next(iter(states))), *names))
    known = {thing: {is_member(run, items, state, thing) for state in states} for thing in found}
    for thing, answers in known.items():
        run.rounds.setdefault((id(node), thing), set()).update(answers)
    return [each for each in found if known[each] == {True}], [each for each in found if known[each] == {False}]


def is_member(run: Exploration, items: Aggregate, state: State, thing: IndividualTerm) -> bool | None:
    """Whether an individual has a round in a loop that starts in a state; None if that is open."""
    one = run.types.is_a(state, thing, items.cls)
    other = evaluate(run.types, state, substitute(items.where, {items.variable: thing}))
    return False if False in (one, other) else one and other


def keep_apart(begin: Begin, item: str, others: Sequence[IndividualTerm]) -> Begin:
    """Return how a round begins whose item is none of some individuals."""

    def begin_apart(starts: StatePaths) -> StatePaths:
        found: dict[State, Path] = {}
        apart: dict[Condition, bool] = {same_individual(Variable(item), each): False for each in others}
        for state, path in begin(starts).items():
            add_state(found, state.with_facts(apart), path)
        return found

    return begin_apart if others else begin


def state_after_round_of(
    run: Exploration,
    node: TypedNode,
    items: Aggregate,
    member: IndividualTerm,
    states: StatePaths,
    begin: Begin,
    context: EvalContext,
) -> State | None:
    """Return what is known after a loop in which an individual has a round, between those of others; None if nothing.

    `begin` says what is known of the item of any round.
    """
    item = Variable(items.variable)
    begin_others = keep_apart(begin, item.name, (member,))
    run.quiet += 1
    before = _kept_by_rounds(run, node, item.name, states, begin_others, context)
    own = unify(before.without_name(item.name), item, member)
    after = without_item(explore_sequence(run, node.children, {own: None}, context).success, item.name)
    kept = _kept_by_rounds(run, node, item.name, after, begin_others, context) if after else None
    run.quiet -= 1
    return kept


def _kept_by_rounds(
    run: Exploration, node: TypedNode, item: str, states: StatePaths, begin: Begin, context: EvalContext
) -> State:
    """Return what is known in all states and still after any number of rounds."""
    kept = reduce(join, states)
    for _ in range(MAX_NARROWINGS):
        ends = explore_sequence(run, node.children, begin({kept: None}), context)
        after = reduce(join, without_item(ends.success, item), kept)
        if after == kept:
            return kept
        kept = after
    return reduce(join, havoc_all(run.types, states, run.writes(node)))


def without_item(states: StatePaths, name: str) -> dict[State, Path]:
    """Return the states after a round, whose item has no name any more."""
    found: dict[State, Path] = {}
    for state, path in states.items():
        add_state(found, state.without_name(name), path)
    return found
