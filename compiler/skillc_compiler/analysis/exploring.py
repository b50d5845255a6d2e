"""From the states in which a node begins to those in which it ends: one function per kind of node."""

from __future__ import annotations

from typing import assert_never

from skillc_compiler.analysis import beside, loops
from skillc_compiler.analysis.binding import changes
from skillc_compiler.analysis.calling import called
from skillc_compiler.analysis.learning import learned
from skillc_compiler.analysis.opening import requirements_of
from skillc_compiler.analysis.run import Around, Run, disturbed, in_order
from skillc_compiler.analysis.state import State
from skillc_compiler.analysis.summaries import key_of
from skillc_compiler.analysis.trail import LIMIT, Ends, Way, Ways, add, decided, few, merge, step
from skillc_compiler.analysis.undoing import scoped
from skillc_compiler.analysis.waiting import awaited
from skillc_compiler.analysis.writes import Assigned
from skillc_compiler.analysis.writing import applied
from skillc_compiler.program.typed import TypedNode
from skillc_compiler.program.walk import within
from skillc_dsl import syntax as s

MOST_STEPS = 5_000
"""So often nodes of one body are followed from a state; what is then left is only taken for what it may write."""


def explore(run: Run, node: TypedNode, ways: Ways, around: Around) -> Ends:
    """Return how a node can end from each of these states; nothing starts where there is none.

    Loops and parallel nodes follow their children several times. What is followed again from the same states ends in
    the same way, so nested ones do not take exponential time.
    """
    if not ways:
        return Ends()
    if not run.quiet:
        run.reached.add(id(node))
    if len(ways) > LIMIT and run.crowded is None:
        run.crowded = node.written.span
    ways = few(ways) if run.watch is None else run.watch.sees(run, few(ways))
    if not (node.children or node.orelse):
        return _explored(run, node, ways, around)
    key = (id(node), frozenset(ways), around)
    noted, ends = run.known.get(key, (False, None))
    if ends is None or not (noted or run.quiet):
        ends = _explored(run, node, ways, around)
        run.known[key] = (not run.quiet, ends)
    return Ends(dict(ends.success), dict(ends.failure), dict(ends.broken))


def _explored(run: Run, node: TypedNode, ways: Ways, around: Around) -> Ends:
    run.steps += len(ways)
    if run.steps > MOST_STEPS:
        return _unfollowed(run, node, ways, around)
    run.read(node.values, node.clauses, ways)
    written = node.written
    match written:
        case s.Block():
            return _block(run, node, written, ways, around)
        case s.Counted() | s.While() | s.For():
            return loops.rounds(run, node, written, ways, around)
        case s.Timeout():
            return _timeout(run, node, ways, around)
        case s.Wait() | s.WaitUntil() | s.CheckNode():
            return _leaf(run, node, ways, around)
        case s.If():
            return _if(run, node, written, ways, around)
        case s.ApplyPosts():
            return _apply(run, node, written, ways, around)
        case s.CallSkill():
            assert node.call is not None, "a call is understood as one"
            return called(run, node.call, ways, around)
        case s.With():
            return scoped(run, node, ways, around)
        case _:
            assert_never(written)


def _unfollowed(run: Run, node: TypedNode, ways: Ways, around: Around) -> Ends:
    """Return how a node can end that is not looked into: in any way, wherever it was."""
    run.crowded = run.crowded or node.written.span
    run.reached.update(id(inner) for inner in within(node))
    left = beside.stopped(run, node, ways, around)
    done = {write.name for write in run.writes(node) if isinstance(write, Assigned)}
    assigned: dict[State, Way] = {}
    for state, way in left.items():
        add(assigned, state.replaced(assigned=state.assigned | done), way)
    return Ends(assigned, left, dict(left))


def _block(run: Run, node: TypedNode, written: s.Block, ways: Ways, around: Around) -> Ends:
    match written.kind:
        case "seq":
            return in_order(run, node.children, ways, around)
        case "sel":
            return _selector(run, node, ways, around)
        case "reactive seq":
            return beside.reactive_sequence(run, node, ways, around)
        case "reactive sel":
            return beside.reactive_selector(run, node, ways, around)
        case "par all" | "par any" | "par race" | "par lead":
            return beside.parallel(run, node, written.kind, ways, around)
        case "try" | "invert":
            return _turned(run, node, written, ways, around)
        case "once":
            return _once(run, node, ways, around)
        case _:
            assert_never(written.kind)


def _selector(run: Run, node: TypedNode, ways: Ways, around: Around) -> Ends:
    """One must succeed; when none does, a hold that broke in any of them has broken."""
    ends, broken = Ends(), False
    for number, child in enumerate(node.children, 1):
        last = number == len(node.children)
        one = explore(run, child, ways, around if last else around.catching())
        merge(ends.success, one.success)
        broken |= bool(one.broken)
        ways = one.failed
    ends.failure, ends.broken = dict(ways), dict(ways) if broken else {}
    return ends


def _turned(run: Run, node: TypedNode, written: s.Block, ways: Ways, around: Around) -> Ends:
    inner = in_order(run, node.children, ways, around.catching())
    ends = Ends(broken=inner.broken)
    for state, way in inner.failure.items():
        add(ends.success, state, step(way, written.span, f"the failure is caught by `{written.kind}`"))
    if written.kind == "try":
        merge(ends.success, inner.success)
    else:
        for state, way in inner.success.items():
            add(ends.failure, state, step(way, written.span, "the success is a failure by `invert`"))
    return ends


def _once(run: Run, node: TypedNode, ways: Ways, around: Around) -> Ends:
    key, ends = key_of(node), Ends()
    fresh = {state: way for state, way in ways.items() if state.done.get(key) is None}
    for state, way in ways.items():
        if key in state.done:
            for result, ended in ((True, ends.success), (False, ends.failure)):
                if state.done[key] in (None, result):
                    add(ended, state, way)
    inner = in_order(run, node.children, fresh, around)
    for result, found, ended in (
        (True, inner.success, ends.success),
        (False, inner.failure, ends.failure),
        (False, inner.broken, ends.broken),
    ):
        for state, way in found.items():
            add(ended, state.replaced(done={**state.done, key: result}), way)
    return ends


def _timeout(run: Run, node: TypedNode, ways: Ways, around: Around) -> Ends:
    ends = in_order(run, node.children, ways, around)
    for state, way in beside.stopped(run, node, ways, around).items():
        add(ends.failure, state, step(way, node.written.span, "the time is up"))
    return ends


def _leaf(run: Run, node: TypedNode, ways: Ways, around: Around) -> Ends:
    ends = Ends()
    for state, way in ways.items():
        match node.written:
            case s.CheckNode(text=text, span=span):
                for holds, ended in ((True, ends.success), (False, ends.failure)):
                    known = learned(run.sorts, state, node.clauses[0].meaning, holds)
                    if known is not None:
                        add(ended, disturbed(run, known, around), decided(state, known, way, span, text, holds))
            case s.WaitUntil():
                run.watch_holds(state, way)
                add(ends.success, disturbed(run, awaited(run.sorts, state, node.clauses[0].meaning), around), way)
            case _:
                run.watch_holds(state, way)
                add(ends.success, disturbed(run, state, around), way)
    return ends


def _if(run: Run, node: TypedNode, written: s.If, ways: Ways, around: Around) -> Ends:
    ends = Ends()
    for holds, branch in ((True, node.children), (False, node.orelse)):
        chosen: dict[State, Way] = {}
        for state, way in ways.items():
            known = learned(run.sorts, state, node.clauses[0].meaning, holds)
            if known is not None:
                trail = decided(state, known, way, node.clauses[0].span, written.text, holds)
                add(chosen, disturbed(run, known, around), trail)
        one = in_order(run, branch, chosen, around)
        merge(ends.success, one.success)
        ends.add_failures(one)
    return ends


def _apply(run: Run, node: TypedNode, written: s.ApplyPosts, ways: Ways, around: Around) -> Ends:
    ends = Ends()
    if run.implementation is None:
        return Ends(success=dict(ways))
    labels = {name.text for name in written.labels}
    posts = [p for p in requirements_of(run.implementation, "post") if p.label and p.label.text in labels]
    effects = [effect for post in posts if not post.sensed for _, effect in changes([post])]
    for state, way in ways.items():
        after = applied(run.sorts, state, effects)
        event = "`apply` writes " + " and ".join(f"`{label}`" for label in sorted(labels))
        add(ends.success, disturbed(run, after, around), step(way, written.span, event))
    return ends
