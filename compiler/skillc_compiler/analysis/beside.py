"""Children that run at the same time: each sees only what none of the others may write."""

from __future__ import annotations

from skillc_compiler.analysis.binding import bound, required
from skillc_compiler.analysis.forgetting import forgotten
from skillc_compiler.analysis.learning import learned
from skillc_compiler.analysis.run import Around, Run, mixed
from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import State
from skillc_compiler.analysis.trail import Ends, Way, Ways, add, after, few, merge
from skillc_compiler.analysis.writes import Assigned, Write
from skillc_compiler.program.typed import Call, TypedNode
from skillc_dsl import syntax as s


def parallel(run: Run, node: TypedNode, kind: str, ways: Ways, around: Around) -> Ends:
    """`par`: how it ends, by which of the children decides."""
    writes = [run.writes(child) for child in node.children]
    if not node.children:
        return Ends(success=dict(ways))
    if kind == "par all":
        return _all(run, node, writes, ways, around)
    ends, place = Ends(), around if kind != "par any" else around.catching()
    for number, child in enumerate(node.children):
        others = _others(writes, number)
        siblings = _siblings(node, number)
        entry = mixed(run, after(run.sorts, ways, others), *siblings)
        one = run.explore(run, child, entry, _place(kind, number, around, place).beside(others))
        one = Ends(*(dict(mixed(run, each, *siblings)) for each in (one.success, one.failure, one.broken)))
        if number == 0 or kind != "par lead":
            merge(ends.success, one.success)
            ends.add_failures(one)
    if kind != "par lead":
        ends.failure = after(run.sorts, ends.failure, frozenset().union(*writes))
        ends.broken = after(run.sorts, ends.broken, frozenset().union(*writes))
    return ends


def _place(kind: str, number: int, around: Around, several: Around) -> Around:
    """Beside the one that leads, a failure changes nothing."""
    return around.catching() if kind == "par lead" and number else several


def _all(run: Run, node: TypedNode, writes: list[frozenset[Write]], ways: Ways, around: Around) -> Ends:
    """All must succeed: the ends are followed as if one ran after the other, each keeping what no other may write."""
    ends = Ends(success=dict(ways))
    known = frozenset.intersection(*(state.assigned for state in ways))
    for number, child in enumerate(node.children):
        others = _others(writes, number)
        ends.add_failures(_while_others_run(run, node, number, after(run.sorts, ways, others), around.beside(others)))
        before = ends.success
        ends.success = {}
        run.quiet += 1
        for state, way in before.items():
            entry = _not_yet(forgotten(run.sorts, state, others), others, known)
            siblings = _siblings(node, number)
            one = run.explore(run, child, mixed(run, {entry: way}, *siblings), around.beside(others))
            one.success = dict(mixed(run, one.success, *siblings))
            for found, found_way in one.success.items():
                add(ends.success, _with_facts_of(found, state), found_way)
            ends.add_failures(one)
        run.quiet -= 1
        ends.success = few(ends.success)
    together = frozenset[Write]().union(*writes)
    ends.failure, ends.broken = (after(run.sorts, some, together) for some in (ends.failure, ends.broken))
    return ends


def _while_others_run(run: Run, node: TypedNode, number: int, ways: Ways, around: Around) -> Ends:
    """Look at a child as it begins, when what the others will have reached is not there yet."""
    return run.explore(run, node.children[number], mixed(run, ways, *_siblings(node, number)), around)


def _with_facts_of(state: State, other: State) -> State:
    """Return what is known in either: what one child has reached, no other may have touched."""
    return state.replaced(
        facts={**other.facts, **state.facts},
        alone={**other.alone, **state.alone},
        assigned=other.assigned | state.assigned,
    )


def _not_yet(state: State, others: frozenset[Write], known: frozenset[str]) -> State:
    """Return the state without the outputs that others assign meanwhile."""
    assigned = {write.name for write in others if isinstance(write, Assigned)}
    return state.replaced(assigned=state.assigned - (assigned - known))


def _siblings(node: TypedNode, number: int) -> tuple[TypedNode, ...]:
    return (*node.children[:number], *node.children[number + 1 :])


def _others(writes: list[frozenset[Write]], number: int) -> frozenset[Write]:
    return frozenset().union(*(each for index, each in enumerate(writes) if index != number))


def stopped(run: Run, node: TypedNode, ways: Ways, around: Around) -> dict[State, Way]:
    """Return what is known after a node was halted, wherever it was."""
    return after(run.sorts, mixed(run, ways, node), run.writes(node) | around.disturbing)


def reactive_sequence(run: Run, node: TypedNode, ways: Ways, around: Around) -> Ends:
    """`reactive seq`: children before a running one may run again; in the end the result of each still holds."""
    writes = [run.writes(child) for child in node.children]
    together = frozenset[Write]().union(*writes)
    ends = Ends(success={**after(run.sorts, ways, together), **ways})
    for number, child in enumerate(node.children):
        earlier = frozenset[Write]().union(*writes[:number])
        one = run.explore(run, child, few(mixed(run, ends.success, *node.children)), around.beside(earlier))
        ends.success = one.success
        ends.add_failures(one)
    ends.success = _lasting(run, node, writes, after(run.sorts, ends.success, together))
    ends.failure, ends.broken = (after(run.sorts, some, together) for some in (ends.failure, ends.broken))
    return ends


def _lasting(run: Run, node: TypedNode, writes: list[frozenset[Write]], ways: Ways) -> dict[State, Way]:
    found: dict[State, Way] = {}
    for state, way in ways.items():
        known = state
        for number, child in enumerate(node.children):
            later = frozenset[Write]().union(*writes[number + 1 :])
            known = forgotten(run.sorts, known, later) if later else known
            known = _still(run, child, known)
        add(found, known, way)
    return found


def _still(run: Run, child: TypedNode, state: State) -> State:
    """Return the state, knowing that the child would end in success again."""
    match child.written:
        case s.CheckNode() | s.WaitUntil():
            return learned(run.sorts, state, child.clauses[0].meaning) or state
        case s.CallSkill() if child.call is not None and child.call.skill is not None:
            return _promised(run, child.call, state, run.sorts)
    return state


def _promised(run: Run, call: Call, state: State, sorts: Sorts) -> State:
    binding = bound(sorts, state, call, required(run.program, call, "pre"))
    for post in required(run.program, call, "post"):
        state = learned(sorts, state, binding.at_end(post.clause.meaning)) or state
    return state


def reactive_selector(run: Run, node: TypedNode, ways: Ways, around: Around) -> Ends:
    """`reactive sel`: children before a running one are tried again each tick."""
    writes = [run.writes(child) for child in node.children]
    together = frozenset[Write]().union(*writes)
    ends, broken = Ends(), False
    entry: dict[State, Way] = {**after(run.sorts, ways, together), **ways}
    for number, child in enumerate(node.children):
        earlier = frozenset[Write]().union(*writes[:number])
        last = number == len(node.children) - 1
        entry = few(mixed(run, entry, *node.children))
        one = run.explore(run, child, entry, (around if last else around.catching()).beside(earlier))
        merge(ends.success, one.success)
        broken |= bool(one.broken)
        ends.failure = one.failed
        ends.broken = dict(one.failed) if broken else {}
        entry = {**after(run.sorts, one.failed, together), **one.failed}
    ends.success = after(run.sorts, ends.success, together)
    return ends
