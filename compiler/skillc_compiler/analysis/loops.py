"""Nodes whose children run several times."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial, reduce
from math import inf
from typing import assert_never

from skillc_compiler.analysis.effects.loop_effects import with_loop_effects
from skillc_compiler.analysis.exploration import EvalContext, Exploration, explore_sequence, havoc_concurrent
from skillc_compiler.analysis.knowledge.assume import assume, unify
from skillc_compiler.analysis.knowledge.state import State, join
from skillc_compiler.analysis.members import (
    Begin,
    enter,
    enter_with_member,
    keep_apart,
    keeps_members,
    members_and_others,
    split_by_members,
    state_after_round_of,
    without_item,
)
from skillc_compiler.analysis.paths import (
    EndStates,
    Path,
    StatePaths,
    add_state,
    add_states,
    extend_path,
    havoc_all,
    widen,
)
from skillc_compiler.logic.intervals import interval_of, parameter_intervals
from skillc_compiler.program.typed import TypedNode
from skillc_dsl import syntax as s
from skillc_model.conditions import Aggregate, Expression, Individual, ListValue, Literal, Variable
from skillc_model.tree import MOST_ROUNDS

MAX_ROUNDS = 6
"""The number of rounds that are followed one by one; after them, unless they lead to known states only, what every
round keeps is known."""
MAX_NARROWINGS = 2
"""The number of times that the loop invariant is narrowed."""


def explore_loop(
    run: Exploration, node: TypedNode, written: s.While | s.For, states: StatePaths, context: EvalContext
) -> EndStates:
    """Return how a loop ends; an invalid number of rounds is reported elsewhere."""
    match written:
        case s.While():
            return _explore_while(run, node, states, context)
        case s.For():
            return _explore_for(run, node, written, states, context)
        case _:
            assert_never(written)


def explore_retry(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Return how a `retry` ends: a failed round is followed by another until none is left."""
    ends, later = EndStates(), dict[State, Path]()
    least, most = _count(run, node, states, ends)
    first = states
    for number in range(1, min(most, MAX_ROUNDS) + 1):
        last = number == min(most, MAX_ROUNDS)
        one = explore_sequence(
            run, node.children, states, context if last and most <= MAX_ROUNDS else context.with_failure_caught()
        )
        add_states(ends.success, one.success)
        if last or number >= least:
            ends.add_failures(one)
        states = widen(one.failed)
        if not states:
            return ends
        if most > MAX_ROUNDS and all(state in later or state in first for state in states):
            ends.add_failures(explore_sequence(run, node.children, widen({**later, **states}), context))
            return ends
        add_states(later, states)
    if most > MAX_ROUNDS:
        ends.add_failures(_explore_any_round(run, node, states, context, ends.success))
    return ends


def explore_repeat(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Return how a `repeat` ends: a successful round is followed by another."""
    ends, going, later = EndStates(), dict(states), dict[State, Path]()
    least, most = _count(run, node, states, ends)
    for number in range(1, min(most, MAX_ROUNDS) + 1):
        one = explore_sequence(run, node.children, widen(going), context)
        going = one.success
        ends.add_failures(one)
        if number >= least:
            add_states(ends.success, going)
        if most > MAX_ROUNDS and all(state in later or state in states for state in going):
            add_states(ends.success, later)
            add_states(ends.success, going)
            return ends
        add_states(later, going)
    if most > MAX_ROUNDS and going:
        ends.add_failures(_explore_any_round(run, node, going, context, ends.success))
    return ends


def _explore_while(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Explore a `while`: rounds while the condition holds; a failure if it still holds after the last one."""
    ends, later = EndStates(), dict(states)
    least, most = _count(run, node, states, ends)
    for number in range(min(most, MAX_ROUNDS)):
        going, out = _split_on_condition(run, node, states, context)
        add_states(ends.success, out)
        if number >= least:
            _add_still_going(node, going, ends)
        one = explore_sequence(run, node.children, going, context)
        ends.add_failures(one)
        states = widen(one.success)
        if not states:
            return ends
        if most > MAX_ROUNDS and all(state in later for state in states):
            most, states = MAX_ROUNDS, widen(later)
            break
        add_states(later, states)
    if most > MAX_ROUNDS:
        after: dict[State, Path] = {}
        ends.add_failures(_explore_any_round(run, node, states, context, after))
        add_states(after, states)
        states = after
    going, out = _split_on_condition(run, node, states, context)
    add_states(ends.success, out)
    _add_still_going(node, going, ends)
    return ends


def _add_still_going(node: TypedNode, going: StatePaths, ends: EndStates) -> None:
    """Add the failures of a `while` whose condition holds after its last round."""
    for state, path in going.items():
        event = "the condition still holds after the last round"
        add_state(ends.failure, state, extend_path(path, node.conditions[0].span, event))


def _explore_for(
    run: Exploration, node: TypedNode, written: s.For, states: StatePaths, context: EvalContext
) -> EndStates:
    """Explore a `for`: any number of rounds, each with its own item; those of a list that is written are known."""
    name = written.variable.text
    run.types.classes.pop(name, None)
    match node.values[0].meaning:
        case ListValue(items=items) if len(items) <= MAX_ROUNDS:
            return _explore_each(run, node, name, items, states, context)
        case Aggregate() as items:
            return _explore_members(run, node, items, states, context)
    ends, after = EndStates(), dict[State, Path]()
    _explore_rounds(run, node, name, (enter, enter), states, context, (ends, after))
    ends.success = {**after, **states}
    return ends


def _explore_each(
    run: Exploration, node: TypedNode, name: str, items: Sequence[Expression], states: StatePaths, context: EvalContext
) -> EndStates:
    """Explore the rounds of a list that is written there."""
    ends = EndStates(success=dict(states))
    run.items.add(name)
    for item in items:
        begun = _with_item(ends.success, Variable(name), item)
        one = explore_sequence(run, node.children, widen(begun), context)
        ends.success = without_item(one.success, name)
        ends.add_failures(one)
    return ends


def _explore_members(
    run: Exploration, node: TypedNode, items: Aggregate, states: StatePaths, context: EvalContext
) -> EndStates:
    """Explore a loop over individuals; each that certainly is one of them has a round."""
    run.types.classes[items.variable] = items.cls
    ends = EndStates()
    for group in split_by_members(run, items, states):
        _explore_group(run, node, items, group, context, ends)
    return ends


def _explore_group(
    run: Exploration, node: TypedNode, items: Aggregate, states: StatePaths, context: EvalContext, ends: EndStates
) -> None:
    members, others = members_and_others(run, node, items, states)
    begin = keep_apart(partial(enter_with_member, run, items), items.variable, others)
    later = begin if keeps_members(run, node, items, states, context) else keep_apart(enter, items.variable, others)
    after = dict[State, Path]()
    _explore_rounds(run, node, items.variable, (begin, later), states, context, (ends, after))
    if not members:
        add_states(ends.success, {**after, **states})
    for member in members:
        kept = state_after_round_of(run, node, items, member, states, later, context)
        after = _with_invariant(after, kept) if kept is not None else {}  # its round never succeeds
    if members:
        add_states(ends.success, after)


def _explore_rounds(
    run: Exploration,
    node: TypedNode,
    name: str,
    begins: tuple[Begin, Begin],
    states: StatePaths,
    context: EvalContext,
    found: tuple[EndStates, dict[State, Path]],
) -> None:
    """Explore any number of rounds, one at least; add the failures, and the states after the last one.

    `begins` say what is known of the item of the first round, and of one that follows.
    """
    (ends, after), (begin, later), starts = found, begins, states
    items = node.values[0].meaning
    for number in range(MAX_ROUNDS):
        one = explore_sequence(run, node.children, begin(widen(states)), context)
        ends.add_failures(one)
        if isinstance(items, Aggregate):
            one.success = with_loop_effects(run, node, items, starts, one.success)
        states = without_item(one.success, name)
        is_known = (number or begin is later) and all(state in after or state in starts for state in states)
        add_states(after, states)
        if is_known:
            return
        begin = later
    further: dict[State, Path] = {}
    ends.add_failures(_explore_any_round(run, node, states, context, further, later))
    add_states(after, without_item(further, name))


def _with_item(states: StatePaths, name: Variable, item: Expression) -> dict[State, Path]:
    """Return the states in which the variable of a loop is another name for an item, if that has a name."""
    if not isinstance(item, Variable | Individual):
        return dict(states)
    found: dict[State, Path] = {}
    for state, path in states.items():
        thing = state.aliases.get(item.name, item) if isinstance(item, Variable) else item
        add_state(found, unify(state, name, thing), path)
    return found


def _split_on_condition(
    run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext
) -> tuple[dict[State, Path], dict[State, Path]]:
    """Return the states in which the condition holds and those in which it does not."""
    found: tuple[dict[State, Path], dict[State, Path]] = ({}, {})
    for state, path in states.items():
        for target, holds in zip(found, (True, False), strict=True):
            known = assume(run.types, state, node.conditions[0].meaning, holds)
            if known is not None:
                event = "the loop goes on" if holds else "the loop ends"
                add_state(
                    target,
                    havoc_concurrent(run, known, context),
                    path if known is state else extend_path(path, node.conditions[0].span, event),
                )
    return found


def _explore_any_round(
    run: Exploration,
    node: TypedNode,
    states: StatePaths,
    context: EvalContext,
    target: dict[State, Path],
    begin: Begin = enter,
) -> EndStates:
    """Explore one round after any number of others; the states after its successes are added to `target`."""
    writes = run.writes(node)
    kept = _loop_invariant(run, node, states, context)
    starts = begin(_with_invariant(havoc_all(run.types, states, writes), kept))
    one = explore_sequence(run, node.children, starts, context)
    ended = havoc_all(run.types, one.success, writes)
    add_states(target, ended if _is_retry(node) else _with_invariant(ended, kept))
    return one


def _is_retry(node: TypedNode) -> bool:
    """Whether another round follows a failure, not a success."""
    return isinstance(node.written, s.Decorator) and node.written.row.on_failure == "again"


def _count(run: Exploration, node: TypedNode, states: StatePaths, ends: EndStates) -> tuple[int, int]:
    """Return the numbers of rounds; where it may be none, the loop may fail without a round."""
    count = node.values[0]
    low, high = _interval_of_count(run, node)
    if not isinstance(count.meaning, Literal) and not 1 <= low <= high <= MOST_ROUNDS:
        for state, path in states.items():
            add_state(ends.failure, state, extend_path(path, count.span, "this is no number of rounds"))
    return count_rounds(run, node)


def _interval_of_count(run: Exploration, node: TypedNode) -> tuple[float, float]:
    owner = run.implementation
    known = parameter_intervals(owner.parameters, owner.lets) if owner is not None else {}
    return interval_of(node.values[0].meaning, known) or (0.0, inf)


def count_rounds(run: Exploration, node: TypedNode) -> tuple[int, int]:
    """Return the least and the greatest number of rounds."""
    low, high = _interval_of_count(run, node)
    return round(min(max(low, 1), MOST_ROUNDS)), round(min(max(high, 1), MOST_ROUNDS))


def _loop_invariant(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> State | None:
    """Return what is known before each further round because every round keeps it, or None if nothing was found."""
    if run.monitor is not None or not states:
        return None
    kept = reduce(join, states)
    for _ in range(MAX_NARROWINGS):
        run.quiet += 1
        ends = explore_sequence(run, node.children, {kept: None}, context)
        run.quiet -= 1
        after_round = reduce(join, ends.failed if _is_retry(node) else ends.success, kept)
        if after_round == kept:
            return kept
        kept = after_round
    return None


def _with_invariant(states: StatePaths, kept: State | None) -> dict[State, Path]:
    found: dict[State, Path] = {}
    for state, path in states.items():
        add_state(found, _conjoin(state, kept) if kept is not None else state, path)
    return found


def _conjoin(state: State, kept: State) -> State:
    return state.replace(
        facts={**state.facts, **kept.facts},
        possible={**state.possible, **kept.possible},
        assigned=state.assigned | kept.assigned,
    )
