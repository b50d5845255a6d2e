"""What trees mean, written as plainly as possible: each node is a generator that yields once for every tick it runs.

Closing a generator halts it. Nothing here is fast, reports, or survives anything; the engine is compared with it.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from skillc_compiler.library import tree
from skillc_compiler.library.conditions import Compare, Condition, Individual, PropertyOf, Variable
from skillc_compiler.library.conditions import Literal as Constant
from skillc_compiler.library.skills import Compound, Implementation, Skill, SkillLibrary
from tree.stage import Script


@dataclass(frozen=True)
class Result:
    """How a node ended, and whether it would still end so. `kind` is that of the failure, "" on success."""

    kind: str = ""
    still: Callable[[], bool] = lambda: True
    hold: bool = False
    refused: bool = False

    @property
    def ok(self) -> bool:
        return not self.kind


Life: TypeAlias = Generator[None, None, Result]


@dataclass
class Model:
    """The whole world of the reference: flags, time, scripts, locks, and the log."""

    library: SkillLibrary
    scripts: dict[str, list[Script]]
    flags: dict[str, bool]
    now: float = 0.0
    log: list[tuple[float, str, str]] = field(default_factory=list)
    starts: dict[str, int] = field(default_factory=dict)
    locks: dict[str, list[object]] = field(default_factory=dict)

    def tell(self, what: str, name: str) -> None:
        self.log.append((self.now, what, name))

    def next_script(self, name: str) -> Script:
        number = self.starts.get(name, 0)
        self.starts[name] = number + 1
        return self.scripts[name][number % len(self.scripts[name])]


@dataclass
class Scope:
    """What is around a node: bindings, results of `once`, things to release, the calls that hold locks."""

    bindings: dict[str, object] = field(default_factory=dict)
    once: dict[object, Result] = field(default_factory=dict)
    undo: list[tuple[str, object]] = field(default_factory=list)
    calls: tuple[object, ...] = ()


def run(node: tree.Node, model: Model, scope: Scope) -> Life:
    """Return the life of a node."""
    match node:
        case tree.Sequence(reactive=False):
            return _sequence(node, model, scope)
        case tree.Selector(reactive=False):
            return _selector(node, model, scope)
        case tree.Sequence() | tree.Selector():
            return _reactive(node, model, scope)
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
            return _call(node, model, scope)
        case tree.If():
            return _if(node, model, scope)
        case tree.Wait() | tree.WaitUntil() | tree.Check():
            return _leaf(node, model, scope)
    raise NotImplementedError(node)


def _sequence(node: tree.Sequence, model: Model, scope: Scope) -> Life:
    results = []
    for child in node.children:
        result = yield from run(child, model, scope)
        if not result.ok:
            return result
        results.append(result)
    return _all_still(results)


def _all_still(results: list[Result]) -> Result:
    return Result(still=lambda: all(result.still() for result in results))


def _selector(node: tree.Selector, model: Model, scope: Scope) -> Life:
    results = []
    for child in node.children:
        result = yield from run(child, model, scope)
        if result.ok:
            return result
        results.append(result)
    return _none_worked(results)


def _none_worked(results: list[Result]) -> Result:
    return Result("body", hold=any(result.hold for result in results))


class _Child:
    """A child that is advanced by hand."""

    def __init__(self, life: Life) -> None:
        self.life = life
        self.result: Result | None = None

    def step(self) -> Result | None:
        try:
            next(self.life)
        except StopIteration as end:
            self.result = end.value
        return self.result


def _reactive(node: tree.Sequence | tree.Selector, model: Model, scope: Scope) -> Life:
    going_on = isinstance(node, tree.Sequence)
    children: list[_Child | None] = [None] * len(node.children)
    try:
        while True:
            results: list[Result] = []
            for index, child in enumerate(node.children):
                current = children[index]
                former = current.result if current is not None else None
                if going_on and former is not None and former.ok and former.still():
                    results.append(former)
                    continue
                if current is None or current.result is not None:
                    current = children[index] = _Child(run(child, model, scope))
                result = current.step()
                if result is None or result.ok != going_on:
                    _close(children[index + 1 :])
                    children[index + 1 :] = [None if c and c.result is None else c for c in children[index + 1 :]]
                    if result is not None:
                        return result
                    break
                results.append(result)
            else:
                if not going_on:
                    return _none_worked(results)
                return _all_still(results)
            yield
    finally:
        _close(children)


def _close(children: list[_Child | None]) -> None:
    for child in reversed(children):
        if child is not None and child.result is None:
            child.life.close()


def _parallel(node: tree.Parallel, model: Model, scope: Scope) -> Life:
    children: list[_Child | None] = []
    try:
        for child in node.children:
            children.append(_Child(run(child, model, scope)))
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
        _close(children)


def _advance(child: _Child | None, node: tree.Parallel, first: bool) -> Result | None:
    assert child is not None
    result = child.step()
    if result is None:
        return None
    at_once = {"all": not result.ok, "any": result.ok, "lead": first, "race": False}
    return result if at_once[node.policy] else None


def _late(node: tree.Parallel, children: list[_Child | None]) -> Result | None:
    ended = [child.result for child in children if child is not None and child.result is not None]
    running = len(ended) < len(children)
    if node.policy == "race":
        failed = [result for result in ended if not result.ok]
        return (failed or ended)[0] if ended else None if running else Result()
    if running or node.policy == "lead":
        return Result() if not children else None
    return Result() if node.policy == "all" else _none_worked(ended)


def _with_still(result: Result, children: list[_Child | None]) -> Result:
    done = [child.result for child in children if child is not None and child.result is not None and child.result.ok]
    return Result(result.kind, lambda: all(each.still() for each in done), result.hold) if result.ok else result


def _loop(node: tree.Retry | tree.Repeat | tree.While, model: Model, scope: Scope) -> Life:
    rounds = 0
    while True:
        if isinstance(node, tree.While):
            if not _true(node.condition, model, scope):
                return Result(still=lambda: not _true(node.condition, model, scope))
            if rounds == node.limit:
                return Result("body")
        elif rounds == node.count:
            return Result()
        result = yield from run(node.child, model, scope)
        rounds += 1
        if isinstance(node, tree.Retry):
            if result.ok or rounds == node.count:
                return result
        elif not result.ok:
            return result
        elif isinstance(node, tree.Repeat) and rounds == node.count:
            return Result()
        yield


def _timeout(node: tree.Timeout, model: Model, scope: Scope) -> Life:
    assert isinstance(node.seconds, Constant)
    deadline = model.now + float(node.seconds.value) - 1e-9
    child = _Child(run(node.child, model, scope))
    try:
        while child.step() is None:
            yield
            if model.now >= deadline:
                return Result("timeout")
        assert child.result is not None
        return child.result
    finally:
        _close([child])


def _decorated(node: tree.Try | tree.Invert | tree.Once, model: Model, scope: Scope) -> Life:
    if isinstance(node, tree.Once) and node.source in scope.once:
        return _lasting(scope.once[node.source])
    result = yield from run(node.child, model, scope)
    if isinstance(node, tree.Once):
        scope.once[node.source] = result
        return _lasting(result)
    if result.hold:
        return result
    if isinstance(node, tree.Try):
        return Result(still=result.still) if result.ok else Result()
    is_check = isinstance(node.child, tree.Check)
    return Result("body") if result.ok else Result(still=lambda: not result.still() if is_check else True)


def _lasting(result: Result) -> Result:
    return Result(result.kind, hold=result.hold)


def _if(node: tree.If, model: Model, scope: Scope) -> Life:
    truth = _true(node.condition, model, scope)
    branch = node.then if truth else node.orelse
    result = Result() if branch is None else (yield from run(branch, model, scope))
    if not result.ok:
        return result
    return Result(still=lambda: _true(node.condition, model, scope) == truth and result.still())


def _leaf(node: tree.Wait | tree.WaitUntil | tree.Check, model: Model, scope: Scope) -> Life:
    match node:
        case tree.Wait(seconds=Constant(value=seconds)):
            until = model.now + float(seconds) - 1e-9
            while model.now < until:
                yield
            return Result()
        case tree.WaitUntil(condition=condition):
            while not _true(condition, model, scope):
                yield
            return Result(still=lambda: _true(condition, model, scope))
        case tree.Check(condition=condition):
            truth = _true(condition, model, scope)
            return Result("" if truth else "body", still=lambda: _true(condition, model, scope))
    raise NotImplementedError(node)


def _with(node: tree.With, model: Model, scope: Scope) -> Life:
    inner = Scope(scope.bindings, scope.once, [], scope.calls)
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


def _call(node: tree.Call, model: Model, scope: Scope) -> Life:
    skill = model.library.skills[node.skill]
    bindings = {name: _value(expression, scope) for name, expression in node.arguments.items()}
    results = []
    for implementation in model.library.implementations_of(node.skill):
        result = yield from _implementation(skill, implementation, model, replace(scope, bindings=bindings, once={}))
        if result.ok or not (result.refused or skill.fallback):
            return result
        results.append(result)
    return results[0] if len(results) == 1 else Result(_furthest(results), hold=any(each.hold for each in results))


def _implementation(skill: Skill, implementation: Implementation, model: Model, scope: Scope) -> Life:
    device = str(scope.bindings["device"]) if skill.uses else ""
    holders = model.locks.setdefault(device, [])
    if not all(_true(pre.condition, model, scope) for pre in implementation.pre):
        return Result("pre", refused=True)
    if not all(_true(hold.condition, model, scope) for hold in implementation.hold):
        return Result("hold", hold=True, refused=True)
    if device and holders and holders[-1] not in scope.calls:
        return Result("lock", refused=True)
    key = object()
    holders.append(key)
    try:
        result = yield from _held(skill, implementation, model, replace(scope, calls=(*scope.calls, key)))
    finally:
        holders.remove(key)
    return _written(implementation, model, scope) if result.ok else result


def _held(skill: Skill, implementation: Implementation, model: Model, scope: Scope) -> Life:
    holds = [hold.condition for hold in implementation.hold]
    if not isinstance(implementation.body, Compound):
        return (yield from _watched(_primitive(skill.scoped, model, scope), holds, model, scope))
    result = yield from _watched(run(implementation.body.node, model, scope), holds, model, scope)
    return replace(result, refused=False)


def _written(implementation: Implementation, model: Model, scope: Scope) -> Result:
    posts = [post.condition for post in implementation.post]
    if posts:
        model.flags[str(scope.bindings["flag"])] = bool(scope.bindings["value"])
    return Result(still=lambda: all(_true(post, model, scope) for post in posts))


def _furthest(results: list[Result]) -> str:
    """Of several implementations the one that came furthest says what the call failed of."""
    order = ["inference", "pre", "hold", "lock"]
    early = [result for result in results if result.refused and result.kind in order]
    started = [result for result in results if result not in early and result.refused]
    ran = [result for result in results if not result.refused]
    return (ran or started or sorted(early, key=lambda result: -order.index(result.kind)))[0].kind


def _watched(life: Life, holds: list[Condition], model: Model, scope: Scope) -> Life:
    child = _Child(life)
    try:
        while child.step() is None:
            yield
            if not all(_true(hold, model, scope) for hold in holds):
                return Result("hold", hold=True)
        assert child.result is not None
        return child.result
    finally:
        _close([child])


def _primitive(scoped: bool, model: Model, scope: Scope) -> Life:
    name = str(scope.bindings["name"])
    script = model.next_script(name)
    model.tell("start", name)
    if script.ending == "refuse":
        return Result("body", refused=True)
    entry, ended, lasts = (name, object()), False, False
    if scoped:
        scope.undo.append(entry)
    try:
        if script.ending == "crash at start":
            return Result("error", refused=True)
        for number in range(script.ticks):
            model.tell("tick", name)
            if number < script.ticks - 1:
                yield
        if script.ending == "crash":
            return Result("error")
        if script.ending == "fail":
            return Result("body")
        ended = lasts = True
        return Result()
    finally:
        if not ended:
            model.tell("halt", name)
        if scoped and not lasts:
            scope.undo.remove(entry)
            model.tell("release", name)


def _true(condition: Condition, model: Model, scope: Scope) -> bool:
    """Whether a flag is as compared with."""
    assert isinstance(condition, Compare) and isinstance(condition.left, PropertyOf)
    return model.flags[str(_value(condition.left.of, scope))] == _value(condition.right, scope)


def _value(expression: object, scope: Scope) -> object:
    match expression:
        case Individual(iri=iri):
            return iri
        case Constant(value=value):
            return value
        case Variable(name=name):
            return scope.bindings[name]
    raise NotImplementedError(expression)
