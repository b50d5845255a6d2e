"""What trees mean, written as plainly as possible: each node is a generator that yields once for every tick it runs.

Closing a generator halts it. Nothing here is fast, reports, or survives anything; the engine is compared with it.
"""

from __future__ import annotations

from dataclasses import replace

from skillc_model import tree
from skillc_model.conditions import Literal as Constant
from tree.reference_calls import call
from tree.reference_model import Child, Life, Model, Result, Scope, all_still, close, none_worked, true, value_of
from tree.reference_reactive import reactive_selector, reactive_sequence


def run(node: tree.Node, model: Model, scope: Scope) -> Life:
    """Return the life of a node."""
    match node:
        case tree.Sequence(reactive=reactive):
            return reactive_sequence(node, model, scope, run) if reactive else _sequence(node, model, scope)
        case tree.Selector(reactive=reactive):
            return reactive_selector(node, model, scope, run) if reactive else _selector(node, model, scope)
        case tree.Parallel():
            return _parallel(node, model, scope)
        case tree.Retry() | tree.Repeat() | tree.While():
            return _loop(node, model, scope)
        case tree.Timeout():
            return _timeout(node, model, scope)
        case tree.Try() | tree.Invert() | tree.Once():
            return _decorated(node, model, scope)
        case tree.With():
            return _with(node, model, scope)
        case tree.Call():
            return call(node, model, scope, run)
        case tree.OnFailure() | tree.Finally():
            return _two_blocks(node, model, scope)
        case tree.If():
            return _if(node, model, scope)
        case tree.Wait() | tree.WaitUntil() | tree.Check() | tree.Fail():
            return _leaf(node, model, scope)
    raise NotImplementedError(node)


def _sequence(node: tree.Sequence, model: Model, scope: Scope) -> Life:
    results = []
    for child in node.children:
        result = yield from run(child, model, scope)
        if not result.ok:
            return result
        results.append(result)
    return all_still(results)


def _two_blocks(node: tree.OnFailure | tree.Finally, model: Model, scope: Scope) -> Life:
    result = yield from run(node.child, model, scope)
    if isinstance(node, tree.Finally):
        if result.ok or not model.dry:
            yield from run(node.last, model, scope)
        return result
    if result.ok:
        return result
    then = yield from run(node.handler, model, scope)
    return then if then.ok else none_worked([then, result])


def _selector(node: tree.Selector, model: Model, scope: Scope) -> Life:
    results = []
    for child in node.children:
        result = yield from run(child, model, scope)
        if result.ok:
            return result
        results.append(result)
    return none_worked(results)


def _parallel(node: tree.Parallel, model: Model, scope: Scope) -> Life:
    children: list[Child | None] = []
    try:
        for child in node.children:
            children.append(Child(run(child, model, scope)))
            decided = _advance(children[-1], node, len(children) == 1)
            if decided is not None:
                return _with_still(decided, children)
        while True:
            decided = _late(node, children)
            if decided is not None:
                return _with_still(decided, children)
            yield
            for index, current in enumerate(children):
                if current is not None and current.result is None:
                    decided = _advance(current, node, index == 0)
                    if decided is not None:
                        return _with_still(decided, children)
    finally:
        close(children)


def _advance(child: Child | None, node: tree.Parallel, first: bool) -> Result | None:
    assert child is not None
    result = child.step()
    if result is None:
        return None
    at_once = {"all": not result.ok, "any": result.ok, "lead": first, "race": False}
    return result if at_once[node.policy] else None


def _late(node: tree.Parallel, children: list[Child | None]) -> Result | None:
    ended = [child.result for child in children if child is not None and child.result is not None]
    running = len(ended) < len(children)
    if node.policy == "race":
        failed = [result for result in ended if not result.ok]
        return (failed or ended)[0] if ended else None if running else Result()
    if running or node.policy == "lead":
        return Result() if not children else None
    return Result() if node.policy == "all" else none_worked(ended)


def _with_still(result: Result, children: list[Child | None]) -> Result:
    done = [child.result for child in children if child is not None and child.result is not None and child.result.ok]
    return Result(result.kind, lambda: all(each.still() for each in done), result.hold) if result.ok else result


def _loop(node: tree.Retry | tree.Repeat | tree.While, model: Model, scope: Scope) -> Life:
    rounds, count = 0, 0 if isinstance(node, tree.While) else node.count
    count = count if isinstance(count, int) else value_of(count, scope)
    while True:
        if isinstance(node, tree.While):
            if not true(node.condition, model, scope):
                return Result(still=lambda: not true(node.condition, model, scope))
            if rounds == node.limit:
                return Result("body")
        elif rounds == count:
            return Result()
        result = yield from run(node.child, model, scope)
        rounds += 1
        if isinstance(node, tree.Retry):
            if result.ok or rounds == count or model.dry:
                return result
        elif not result.ok:
            return result
        elif isinstance(node, tree.Repeat) and rounds == count:
            return Result()
        yield


def _timeout(node: tree.Timeout, model: Model, scope: Scope) -> Life:
    assert isinstance(node.seconds, Constant)
    deadline = model.now + float(node.seconds.value) + 1e-4
    child = Child(run(node.child, model, scope))
    try:
        while child.step() is None:
            yield
            if model.now > deadline:
                return Result("timeout")
        assert child.result is not None
        return child.result
    finally:
        close([child])


def _decorated(node: tree.Try | tree.Invert | tree.Once, model: Model, scope: Scope) -> Life:
    if isinstance(node, tree.Once) and node.source in scope.once:
        return _lasting(scope.once[node.source])
    result = yield from run(node.child, model, scope)
    if isinstance(node, tree.Once):
        scope.once[node.source] = result
        return _lasting(result)
    if result.hold and not model.dry:
        return result
    if isinstance(node, tree.Try):
        return Result(still=result.still) if result.ok else Result()
    is_check = isinstance(node.child, tree.Check)
    return Result("body") if result.ok else Result(still=lambda: not result.still() if is_check else True)


def _lasting(result: Result) -> Result:
    return Result(result.kind, hold=result.hold)


def _if(node: tree.If, model: Model, scope: Scope) -> Life:
    truth = true(node.condition, model, scope)
    branch = node.then if truth else node.orelse
    result = Result() if branch is None else (yield from run(branch, model, scope))
    if not result.ok:
        return result
    return Result(still=lambda: true(node.condition, model, scope) == truth and result.still())


def _leaf(node: tree.Wait | tree.WaitUntil | tree.Check | tree.Fail, model: Model, scope: Scope) -> Life:
    match node:
        case tree.Wait(seconds=Constant(value=seconds)):
            until = model.now + float(seconds) - 1e-4
            while model.now < until:
                yield
            return Result()
        case tree.WaitUntil(condition=condition):
            while not true(condition, model, scope):
                yield
            return Result(still=lambda: true(condition, model, scope))
        case tree.Check(condition=condition):
            truth = true(condition, model, scope)
            return Result("" if truth else "body", still=lambda: true(condition, model, scope))
        case tree.Fail():
            return Result("body")
    raise NotImplementedError(node)


def _with(node: tree.With, model: Model, scope: Scope) -> Life:
    inner = replace(scope, undo=[])
    try:
        result = yield from run(node.call, model, inner)
        if not result.ok:
            return result
        return (yield from run(node.child, model, inner))
    finally:
        unwind(model, inner)


def unwind(model: Model, scope: Scope) -> None:
    """Release what was set up, the last first."""
    while scope.undo:
        model.tell("release", scope.undo.pop()[0])
