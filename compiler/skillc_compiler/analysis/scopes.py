"""`with`: the undo of what a scoped skill wrote, and scoped skills that are called without it."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.caller_terms import hide_names
from skillc_compiler.analysis.calls import explore_call
from skillc_compiler.analysis.exploration import EvalContext, Exploration
from skillc_compiler.analysis.findings import LeakedChange
from skillc_compiler.analysis.knowledge.havoc import havoc
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import RelationWrite, Write, with_unknown_value
from skillc_compiler.analysis.paths import EndStates, Path, StatePaths, add_state
from skillc_compiler.program.typed import Call, Implementation, Task, TypedNode
from skillc_compiler.program.walk import calls_in
from skillc_dsl import syntax as s
from skillc_model.conditions import Anything


def explore_with(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Return how a `with` ends: facts that only the set-up changed are as before."""
    assert node.call is not None, "`with` has a call"
    ends = EndStates()
    undone, kept = _undone_and_kept(run, node, node.call)
    for before, path in states.items():
        opened = explore_call(run, node.call, {before: path}, context)
        inner = EndStates(success=opened.success)
        for child in node.children:
            one = run.explore(run, child, inner.success, context)
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


def _undone_and_kept(run: Exploration, node: TypedNode, call: Call) -> tuple[frozenset[Write], frozenset[Write]]:
    """Return the writes that are undone at the end, and those that the body leaves behind."""
    inside = (run.summaries.scoped_writes(other) for child in node.children for other in calls_in(child))
    set_up = run.summaries.writes_of_call(call).union(*inside)
    body = {write for child in node.children for write in run.writes(child)}
    return hide_names((back for write in set_up for back in _undoing_writes(write)), run.stable), frozenset(body)


def _undoing_writes(write: Write) -> Iterator[Write]:
    """Yield what undoing a write may write: replaced values are restored too."""
    yield with_unknown_value(write)
    if isinstance(write, RelationWrite):
        yield RelationWrite(write.subject, write.relation, Anything(), None)
        yield RelationWrite(Anything(), write.relation, write.object, None)


def _add_restored(
    run: Exploration,
    before: State,
    found: StatePaths,
    target: dict[State, Path],
    writes: tuple[frozenset[Write], frozenset[Write]],
) -> None:
    undone, kept = writes
    untouched = havoc(run.types, before, kept)
    for state, path in found.items():
        after = havoc(run.types, state, undone)
        facts = {**untouched.facts, **after.facts}
        alone = {**untouched.possible, **after.possible}
        restored = after.replace(facts=facts, possible=alone) if undone else state
        add_state(target, restored.replace(monitor=(state.monitor[0], before.monitor[1])), path)


def leaked_scopes(of: Implementation | Task, body: TypedNode) -> Iterator[LeakedChange]:
    """Yield the calls of scoped skills that no `with` encloses; a scoped skill may call them for its own set-up."""
    if not isinstance(of, Implementation) or "scoped" not in of.skill.flags:
        yield from _outside_with(body)


def _outside_with(node: TypedNode) -> Iterator[LeakedChange]:
    if isinstance(node.written, s.CallSkill) and node.call and node.call.skill and "scoped" in node.call.skill.flags:
        yield LeakedChange(node.call, None, None)
    if not isinstance(node.written, s.With):
        for child in (*node.children, *node.orelse):
            yield from _outside_with(child)
