"""Children that run in parallel: each knows only what none of the others may write."""

from __future__ import annotations

from functools import reduce

from skillc_compiler.analysis.binding import bind_call, call_requirements
from skillc_compiler.analysis.exploration import EvalContext, Exploration, interleave
from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.apply_effects import spare
from skillc_compiler.analysis.knowledge.assume import assume
from skillc_compiler.analysis.knowledge.havoc import havoc
from skillc_compiler.analysis.knowledge.state import State, join
from skillc_compiler.analysis.knowledge.writes import OutputWrite, Write
from skillc_compiler.analysis.paths import EndStates, Path, StatePaths, add_state, add_states, havoc_all, widen
from skillc_compiler.program.typed import Call, TypedNode
from skillc_dsl import syntax as s


def explore_parallel(
    run: Exploration, node: TypedNode, kind: str, states: StatePaths, context: EvalContext
) -> EndStates:
    """Return how a `par` ends, by which of its children determines the end."""
    if not node.children:
        return EndStates(success=dict(states))
    writes = _writes_of_children(run, node, states, context)
    if kind == "par all":
        return _explore_all(run, node, writes, states, context)
    ends, place = EndStates(), context if kind != "par any" else context.with_failure_caught()
    for number, child in enumerate(node.children):
        others = _writes_of_others(writes, number)
        siblings = _siblings(node, number)
        entry = interleave(run, havoc_all(run.types, states, others), *siblings)
        one = run.explore(run, child, entry, _context_of_child(kind, number, context, place).beside(others))
        one = EndStates(*(dict(interleave(run, each, *siblings)) for each in (one.success, one.failure, one.broken)))
        if number == 0 or kind != "par lead":
            add_states(ends.success, one.success)
            ends.add_failures(one)
    if kind != "par lead":
        ends.failure = havoc_all(run.types, ends.failure, frozenset().union(*writes))
        ends.broken = havoc_all(run.types, ends.broken, frozenset().union(*writes))
    return ends


def _writes_of_children(
    run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext
) -> list[frozenset[Write]]:
    """Return what each child may write; one on many is none on what does not fulfil its condition all the time."""
    writes = [run.writes(child) for child in node.children]
    together = frozenset[Write]().union(context.concurrent_writes, *writes)
    always = reduce(join, havoc_all(run.types, states, together))
    if not run.quiet:
        run.always[id(node)] = join(run.always.get(id(node), always), always)
    return [frozenset(spare(run.types, always, write) for write in each) for each in writes]


def _context_of_child(kind: str, number: int, context: EvalContext, several: EvalContext) -> EvalContext:
    """Return the context of a child; the failure of a child beside the leading one has no effect."""
    return context.with_failure_caught() if kind == "par lead" and number else several


def _explore_all(
    run: Exploration, node: TypedNode, writes: list[frozenset[Write]], states: StatePaths, context: EvalContext
) -> EndStates:
    """Explore children that must all succeed as if one ran after the other, each keeping what no other may write."""
    ends = EndStates(success=dict(states))
    known = frozenset.intersection(*(state.assigned for state in states))
    for number, child in enumerate(node.children):
        others = _writes_of_others(writes, number)
        ends.add_failures(
            _explore_start(run, node, number, havoc_all(run.types, states, others), context.beside(others))
        )
        before = ends.success
        ends.success = {}
        run.quiet += 1
        for state, path in before.items():
            entry = _without_outputs(havoc(run.types, state, others), others, known)
            siblings = _siblings(node, number)
            one = run.explore(run, child, interleave(run, {entry: path}, *siblings), context.beside(others))
            one.success = dict(interleave(run, one.success, *siblings))
            kept = havoc(run.types, state, writes[number])
            for found, found_way in one.success.items():
                add_state(ends.success, _combine(found, kept), found_way)
            ends.add_failures(one)
        run.quiet -= 1
        ends.success = widen(ends.success)
    together = frozenset[Write]().union(*writes)
    ends.failure, ends.broken = (havoc_all(run.types, some, together) for some in (ends.failure, ends.broken))
    return ends


def _explore_start(
    run: Exploration, node: TypedNode, number: int, states: StatePaths, context: EvalContext
) -> EndStates:
    """Explore a child as it begins, when the others may not have achieved anything yet."""
    return run.explore(run, node.children[number], interleave(run, states, *_siblings(node, number)), context)


def _combine(state: State, other: State) -> State:
    """Return what is known in either state: what one child has achieved, no other may have changed."""
    return state.replace(
        facts={**other.facts, **state.facts},
        possible={**other.possible, **state.possible},
        assigned=other.assigned | state.assigned,
        done=other.done | state.done,
        unchanged=other.unchanged & state.unchanged,
        had=other.had | state.had,
    )


def _without_outputs(state: State, others: frozenset[Write], known: frozenset[str]) -> State:
    """Return the state without the outputs that others assign in parallel."""
    assigned = {write.name for write in others if isinstance(write, OutputWrite)}
    return state.replace(assigned=state.assigned - (assigned - known))


def _siblings(node: TypedNode, number: int) -> tuple[TypedNode, ...]:
    return (*node.children[:number], *node.children[number + 1 :])


def _writes_of_others(writes: list[frozenset[Write]], number: int) -> frozenset[Write]:
    return frozenset().union(*(each for index, each in enumerate(writes) if index != number))


def states_when_halted(
    run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext
) -> dict[State, Path]:
    """Return what is known after a node was halted at any point."""
    return havoc_all(run.types, interleave(run, states, node), run.writes(node) | context.concurrent_writes)


def explore_reactive_sequence(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Explore a `reactive seq`: children before the running one may run again; at the end the result of each holds."""
    writes = [run.writes(child) for child in node.children]
    together = frozenset[Write]().union(*writes)
    ends = EndStates(success={**havoc_all(run.types, states, together), **states})
    for number, child in enumerate(node.children):
        earlier = frozenset[Write]().union(*writes[:number])
        one = run.explore(
            run, child, widen(interleave(run, ends.success, *node.children)), context.with_concurrent_writes(earlier)
        )
        ends.success = one.success
        ends.add_failures(one)
    ends.success = _assume_all_succeed_again(run, node, writes, havoc_all(run.types, ends.success, together))
    ends.failure, ends.broken = (havoc_all(run.types, some, together) for some in (ends.failure, ends.broken))
    return ends


def _assume_all_succeed_again(
    run: Exploration, node: TypedNode, writes: list[frozenset[Write]], states: StatePaths
) -> dict[State, Path]:
    found: dict[State, Path] = {}
    for state, path in states.items():
        known = state
        for number, child in enumerate(node.children):
            later = frozenset[Write]().union(*writes[number + 1 :])
            known = havoc(run.types, known, later) if later else known
            known = _assume_succeeds_again(run, child, known)
        add_state(found, known, path)
    return found


def _assume_succeeds_again(run: Exploration, child: TypedNode, state: State) -> State:
    """Return the state, knowing that the child would succeed again."""
    match child.written:
        case s.CheckNode() | s.WaitUntil():
            return assume(run.types, state, child.conditions[0].meaning) or state
        case s.CallSkill() if child.call is not None and child.call.skill is not None:
            return _assume_posts(run, child.call, state, run.types)
    return state


def _assume_posts(run: Exploration, call: Call, state: State, types: AliasTypes) -> State:
    binding = bind_call(types, state, call, call_requirements(run.program, call, "pre"))
    for post in call_requirements(run.program, call, "post"):
        state = assume(types, state, binding.at_end(post.condition.meaning)) or state
    return state


def explore_reactive_selector(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Explore a `reactive sel`: children before the running one are tried again in each tick."""
    writes = [run.writes(child) for child in node.children]
    together = frozenset[Write]().union(*writes)
    ends, broken = EndStates(), False
    entry: dict[State, Path] = {**havoc_all(run.types, states, together), **states}
    for number, child in enumerate(node.children):
        earlier = frozenset[Write]().union(*writes[:number])
        last = number == len(node.children) - 1
        entry = widen(interleave(run, entry, *node.children))
        one = run.explore(
            run, child, entry, (context if last else context.with_failure_caught()).with_concurrent_writes(earlier)
        )
        add_states(ends.success, one.success)
        broken |= bool(one.broken)
        ends.failure = one.failed
        ends.broken = dict(one.failed) if broken else {}
        entry = {**havoc_all(run.types, one.failed, together), **one.failed}
    ends.success = havoc_all(run.types, ends.success, together)
    return ends
