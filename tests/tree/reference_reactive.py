"""What reactive sequences and selectors mean: at most one child is active, and it is halted before another starts."""

from __future__ import annotations

from dataclasses import replace

from skillc_model import tree
from tree.reference_calls import Run
from tree.reference_model import Child, Life, Model, Result, Scope, all_still, close, none_worked


def reactive_sequence(node: tree.Sequence, model: Model, scope: Scope, run: Run) -> Life:
    """Return the life of a sequence that looks in each tick whether what came before is still so."""
    results: list[Result | None] = [None] * len(node.children)
    active, running = 0, None
    try:
        while True:
            for index, each in enumerate(node.children):
                former = results[index]
                if former is not None and former.still():
                    continue
                if running is None or index != active:
                    close([running])
                    active, running, results[index] = index, Child(run(each, model, scope)), None
                result = running.step()
                if result is None:
                    break
                running = None
                if not result.ok:
                    return result
                results[index] = result
            else:
                return all_still([result for result in results if result is not None])
            yield
    finally:
        close([running])


def reactive_selector(node: tree.Selector, model: Model, scope: Scope, run: Run) -> Life:
    """Return the life of a selector that lets an earlier child take over when it could start."""
    lives = [(each, replace(scope, branch=(*scope.branch, object()))) for each in node.children]
    results: list[Result] = [Result()] * len(lives)
    active, running = 0, None
    spent: set[int] = set()
    try:
        while True:
            for index in range(active):
                if _fails_at_once(*lives[index], model, run, lives[active][1]):
                    spent.discard(index)
                elif index not in spent:
                    close([running])
                    active, running = index, None
                    break
            while active < len(lives):
                running = running or Child(run(lives[active][0], model, lives[active][1]))
                result = running.step()
                if result is None:
                    break
                running = None
                if result.ok:
                    return result
                results[active] = result
                if not _fails_at_once(*lives[active], model, run, None):
                    spent.add(active)
                active += 1
            else:
                return none_worked(results)
            yield
    finally:
        close([running])


def _fails_at_once(node: tree.Node, scope: Scope, model: Model, run: Run, leaving: Scope | None) -> bool:
    """Whether a node would fail in its first tick, tried in a copy of the world in which `leaving` holds no locks."""
    branch = leaving.branch[-1] if leaving is not None else None
    locks = {device: [key for key in keys if branch not in key] for device, keys in model.locks.items()}
    waits = [wait for wait in model.waits if branch not in wait.key]
    look = replace(
        model, flags=dict(model.flags), log=[], starts=dict(model.starts), locks=locks, waits=waits, dry=True
    )
    child = Child(run(node, look, replace(scope, once=dict(scope.once), undo=[])))
    result = child.step()
    close([child])
    return result is not None and not result.ok
