"""Nodes whose children run several times."""

from __future__ import annotations

from functools import reduce
from typing import assert_never

from skillc_compiler.analysis.learning import learned
from skillc_compiler.analysis.run import Around, Run, disturbed, in_order
from skillc_compiler.analysis.state import State, joined
from skillc_compiler.analysis.trail import Ends, Way, Ways, add, after, few, merge, step
from skillc_compiler.logic.rounds import count_rounds
from skillc_compiler.program.typed import TypedNode
from skillc_dsl import syntax as s

ROUNDS = 6
"""So many rounds are followed one by one; after them, only what no round can change, or every round keeps, is known."""
TRIALS = 2
"""So often what every round keeps is narrowed down."""


def rounds(run: Run, node: TypedNode, written: s.Counted | s.While | s.For, ways: Ways, around: Around) -> Ends:
    """Return how a loop ends; a number of rounds that is none is told elsewhere."""
    match written:
        case s.Counted(kind="retry", count=count):
            return _retried(run, node, count_rounds(count), ways, around)
        case s.Counted(count=count):
            return _repeated(run, node, count_rounds(count), ways, around)
        case s.While(limit=limit):
            return _while(run, node, count_rounds(limit), ways, around)
        case s.For():
            return _each(run, node, written, ways, around)
        case _:
            assert_never(written)


def _retried(run: Run, node: TypedNode, count: int, ways: Ways, around: Around) -> Ends:
    """`retry`: a failed round is followed by another one until there is none left."""
    ends = Ends()
    for number in range(1, min(count, ROUNDS) + 1):
        last = number == min(count, ROUNDS)
        one = in_order(run, node.children, ways, around if last and count <= ROUNDS else around.catching())
        merge(ends.success, one.success)
        ends.failure, ends.broken = one.failure, one.broken
        ways = few(one.failed)
        if not ways:
            return ends
    if count > ROUNDS:
        ends.add_failures(_any_number(run, node, ways, around, ends.success))
    return ends


def _repeated(run: Run, node: TypedNode, count: int, ways: Ways, around: Around) -> Ends:
    """`repeat`: a round that succeeded is followed by another one."""
    ends = Ends(success=dict(ways))
    for _ in range(min(count, ROUNDS)):
        one = in_order(run, node.children, few(ends.success), around)
        ends.success = one.success
        ends.add_failures(one)
    if count > ROUNDS and ends.success:
        last: dict[State, Way] = {}
        ends.add_failures(_any_number(run, node, ends.success, around, last))
        ends.success = last
    return ends


def _while(run: Run, node: TypedNode, limit: int, ways: Ways, around: Around) -> Ends:
    """`while`: a round for as long as the condition holds; a failure when it still does after the last."""
    ends = Ends()
    for _ in range(min(limit, ROUNDS)):
        going, out = _asked(run, node, ways, around)
        merge(ends.success, out)
        one = in_order(run, node.children, going, around)
        ends.add_failures(one)
        ways = few(one.success)
        if not ways:
            return ends
    if limit > ROUNDS:
        later: dict[State, Way] = {}
        ends.add_failures(_any_number(run, node, ways, around, later))
        merge(later, ways)
        ways = later
    going, out = _asked(run, node, ways, around)
    merge(ends.success, out)
    for state, way in going.items():
        add(ends.failure, state, step(way, node.clauses[0].span, "the condition still holds after the last round"))
    return ends


def _each(run: Run, node: TypedNode, written: s.For, ways: Ways, around: Around) -> Ends:
    """`for`: any number of rounds, each with an item of its own."""
    ends, name = Ends(success=dict(ways)), written.variable.text
    run.sorts.classes.pop(name, None)
    for _ in range(ROUNDS):
        new = {state: way for state, way in ways.items() if state not in ends.success or state in ways}
        one = in_order(run, node.children, few(new), around)
        ends.add_failures(one)
        ways = _without(one.success, name)
        if all(state in ends.success for state in ways):
            return ends
        merge(ends.success, ways)
    later: dict[State, Way] = {}
    ends.add_failures(_any_number(run, node, ways, around, later))
    merge(ends.success, _without(later, name))
    return ends


def _without(ways: Ways, name: str) -> dict[State, Way]:
    found: dict[State, Way] = {}
    for state, way in ways.items():
        add(found, state.without(name), way)
    return found


def _asked(run: Run, node: TypedNode, ways: Ways, around: Around) -> tuple[dict[State, Way], dict[State, Way]]:
    """Return the states in which the condition holds and those in which it does not."""
    found: tuple[dict[State, Way], dict[State, Way]] = ({}, {})
    for state, way in ways.items():
        for target, holds in zip(found, (True, False), strict=True):
            known = learned(run.sorts, state, node.clauses[0].meaning, holds)
            if known is not None:
                event = "the loop goes on" if holds else "the loop ends"
                add(
                    target,
                    disturbed(run, known, around),
                    way if known is state else step(way, node.clauses[0].span, event),
                )
    return found


def _any_number(run: Run, node: TypedNode, ways: Ways, around: Around, target: dict[State, Way]) -> Ends:
    """Follow one round after any number of others; its successes go to `target`."""
    writes = run.writes(node)
    kept = _kept(run, node, ways, around)
    one = in_order(run, node.children, _knowing(after(run.sorts, ways, writes), kept), around)
    ended = after(run.sorts, one.success, writes)
    merge(target, ended if _is_retry(node) else _knowing(ended, kept))
    return one


def _is_retry(node: TypedNode) -> bool:
    """Whether it is a failure that another round follows, not a success."""
    return isinstance(node.written, s.Counted) and node.written.kind == "retry"


def _kept(run: Run, node: TypedNode, ways: Ways, around: Around) -> State | None:
    """Return what is known before each further round because every round keeps it; None where nothing was found."""
    if run.watch is not None or not ways:
        return None
    kept = reduce(joined, ways)
    for _ in range(TRIALS):
        run.quiet += 1
        ends = in_order(run, node.children, {kept: None}, around)
        run.quiet -= 1
        after_round = reduce(joined, ends.failed if _is_retry(node) else ends.success, kept)
        if after_round == kept:
            return kept
        kept = after_round
    return None


def _knowing(ways: Ways, kept: State | None) -> dict[State, Way]:
    found: dict[State, Way] = {}
    for state, way in ways.items():
        add(found, _and(state, kept) if kept is not None else state, way)
    return found


def _and(state: State, kept: State) -> State:
    return state.replaced(
        facts={**state.facts, **kept.facts},
        alone={**state.alone, **kept.alone},
        assigned=state.assigned | kept.assigned,
    )
