"""`with`: what the scoped skill wrote is taken back when the block ends."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.calling import called
from skillc_compiler.analysis.forgetting import forgotten
from skillc_compiler.analysis.run import Around, Run
from skillc_compiler.analysis.state import State
from skillc_compiler.analysis.summaries import calls_in, hidden
from skillc_compiler.analysis.trail import Ends, Way, Ways, add
from skillc_compiler.analysis.writes import Related, Write, either_way
from skillc_compiler.program.typed import Call, TypedNode
from skillc_model.conditions import Anything


def scoped(run: Run, node: TypedNode, ways: Ways, around: Around) -> Ends:
    """Return how a `with` ends: facts that the set-up alone changed are as before."""
    assert node.call is not None, "`with` has a call"
    ends = Ends()
    undone, kept = _writes(run, node, node.call)
    for before, way in ways.items():
        opened = called(run, node.call, {before: way}, around)
        inner = Ends(success=opened.success)
        for child in node.children:
            one = run.explore(run, child, inner.success, around)
            inner.success = one.success
            inner.add_failures(one)
        inner.add_failures(opened)
        for target, found in (
            (ends.success, inner.success),
            (ends.failure, inner.failure),
            (ends.broken, inner.broken),
        ):
            _add_restored(run, before, found, target, (undone, kept))
    return ends


def _writes(run: Run, node: TypedNode, call: Call) -> tuple[frozenset[Write], frozenset[Write]]:
    """Return what is undone in the end, and what the body writes besides."""
    inside = (run.summaries.lasting(other) for child in node.children for other in calls_in(child))
    set_up = run.summaries.of_call(call).union(*inside)
    body = {write for child in node.children for write in run.writes(child)}
    return hidden((back for write in set_up for back in _undone(write)), run.stable), frozenset(body)


def _undone(write: Write) -> Iterator[Write]:
    """Yield what taking a write back may write: also those that it had replaced come back."""
    yield either_way(write)
    if isinstance(write, Related):
        yield Related(write.subject, write.relation, Anything(), None)
        yield Related(Anything(), write.relation, write.object, None)


def _add_restored(
    run: Run, before: State, found: Ways, target: dict[State, Way], writes: tuple[frozenset[Write], frozenset[Write]]
) -> None:
    undone, kept = writes
    untouched = forgotten(run.sorts, before, kept)
    for state, way in found.items():
        after = forgotten(run.sorts, state, undone)
        facts = {**untouched.facts, **after.facts}
        alone = {**untouched.alone, **after.alone}
        restored = after.replaced(facts=facts, alone=alone) if undone else state
        add(target, restored.replaced(monitor=(state.monitor[0], before.monitor[1])), way)
