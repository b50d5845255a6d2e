"""What calls in trees mean: implementations one after the other, their conditions, locks, and scripted primitives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

from skillc_model import tree
from skillc_model.conditions import Condition
from skillc_model.skills import Compound, Implementation, Skill
from tree.reference_model import Child, Life, Model, Result, Scope, Wait, close, true, value_of
from tree.reference_waits import queue

Run: TypeAlias = Callable[[tree.Node, Model, Scope], Life]
"""How a node that is a body is run."""


def call(node: tree.Call, model: Model, scope: Scope, run: Run) -> Life:
    """Return the life of a call."""
    skill = model.library.skills[node.skill]
    bindings = {name: value_of(expression, scope) for name, expression in node.arguments.items()}
    device = str(bindings["device"]) if skill.uses else ""
    key = (object(), *scope.branch)
    inner = replace(scope, bindings=bindings, once={}, calls=(*scope.calls, key) if device else scope.calls)
    if not device:
        return (yield from _implementations(node.skill, model, inner, run))
    free = yield from queue(Wait(key, device, scope.calls), model)
    if not free:
        return Result("lock")
    model.locks.setdefault(device, []).append(key)
    try:
        return (yield from _implementations(node.skill, model, inner, run))
    finally:
        model.locks[device].remove(key)


def _implementations(name: str, model: Model, scope: Scope, run: Run) -> Life:
    skill, results = model.library.skills[name], []
    for implementation in model.library.implementations_of(name):
        result = yield from _implementation(skill, implementation, model, scope, run)
        if result.ok or not (result.refused or skill.fallback):
            return result
        results.append(result)
    return results[0] if len(results) == 1 else Result(_furthest(results), hold=any(each.hold for each in results))


def _implementation(skill: Skill, implementation: Implementation, model: Model, scope: Scope, run: Run) -> Life:
    if not all(true(pre.condition, model, scope) for pre in implementation.pre):
        return Result("pre", refused=True)
    if not all(true(hold.condition, model, scope) for hold in implementation.hold):
        return Result("hold", hold=True, refused=True)
    result = yield from _held(skill, implementation, model, scope, run)
    return _written(implementation, model, scope) if result.ok else result


def _held(skill: Skill, implementation: Implementation, model: Model, scope: Scope, run: Run) -> Life:
    holds = [hold.condition for hold in implementation.hold]
    if not isinstance(implementation.body, Compound):
        return (yield from _watched(_primitive(skill.scoped, model, scope), holds, model, scope))
    result = yield from _watched(run(implementation.body.node, model, scope), holds, model, scope)
    return replace(result, refused=False)


def _written(implementation: Implementation, model: Model, scope: Scope) -> Result:
    posts = [post.condition for post in implementation.post]
    if posts:
        model.flags[str(scope.bindings["flag"])] = bool(scope.bindings["value"])
    return Result(still=lambda: all(true(post, model, scope) for post in posts))


def _furthest(results: list[Result]) -> str:
    """Of several implementations the one that came furthest says what the call failed of."""
    order = ["inference", "pre", "hold", "lock"]
    early = [result for result in results if result.refused and result.kind in order]
    started = [result for result in results if result not in early and result.refused]
    ran = [result for result in results if not result.refused]
    return (ran or started or sorted(early, key=lambda result: -order.index(result.kind)))[0].kind


def _watched(life: Life, holds: list[Condition], model: Model, scope: Scope) -> Life:
    child = Child(life)
    try:
        while child.step() is None:
            yield
            if not all(true(hold, model, scope) for hold in holds):
                return Result("hold", hold=True)
        assert child.result is not None
        return child.result
    finally:
        close([child])


def _primitive(scoped: bool, model: Model, scope: Scope) -> Life:
    while model.dry:
        yield
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
