"""Understanding bodies: the values, conditions and calls of nodes, and where outputs have their values."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias, assert_never

from skillc_compiler.program import Step
from skillc_compiler.resolve.calls import call
from skillc_compiler.resolve.conditions import clause
from skillc_compiler.resolve.scope import Scope, Setting, Variable
from skillc_compiler.resolve.values import Wanted, value
from skillc_compiler.types import UNKNOWN, ListOf, Measure
from skillc_dsl import syntax as s
from skillc_dsl.units import TIME

SECONDS = Wanted(Measure(TIME))
_Decision: TypeAlias = Callable[[list[bool]], bool]


def step(setting: Setting, scope: Scope, written: s.Node) -> tuple[Step, Scope]:
    """Return what a node means, and the scope after it."""
    match written:
        case s.Block():
            return _block(setting, scope, written)
        case s.Counted(children=children):
            inner, after = _in_order(setting, scope, children)
            return Step(written, children=inner), after
        case s.Timeout(limit=limit, children=children):
            seconds = value(setting, scope, limit, SECONDS)
            inner, after = _in_order(setting, scope, children)
            return Step(written, (seconds,), children=inner), after
        case s.Wait(time=time):
            return Step(written, (value(setting, scope, time, SECONDS),)), scope
        case s.WaitUntil(condition=condition) | s.CheckNode(condition=condition):
            return Step(written, clauses=(clause(setting, scope, condition),)), scope
        case s.If():
            return _if(setting, scope, written)
        case s.While(condition=condition, children=children):
            guard = clause(setting, scope, condition)
            inner, after = _in_order(setting, scope, children)
            return Step(written, clauses=(guard,), children=inner), _either(scope, scope, after)
        case s.For():
            return _for(setting, scope, written)
        case s.ApplyPosts():
            return Step(written), scope
        case s.CallSkill():
            understood, after = call(setting, scope, written)
            return Step(written, call=understood), after
        case s.With(call=opening, children=children):
            understood, opened = call(setting, scope, opening)
            inner, after = _in_order(setting, opened, children)
            return Step(written, call=understood, children=inner), after
        case _:
            assert_never(written)


def _in_order(setting: Setting, scope: Scope, nodes: Sequence[s.Node]) -> tuple[tuple[Step, ...], Scope]:
    steps = []
    for node in nodes:
        understood, scope = step(setting, scope, node)
        steps.append(understood)
    return tuple(steps), scope


def _block(setting: Setting, scope: Scope, written: s.Block) -> tuple[Step, Scope]:
    if written.kind in ("seq", "reactive seq", "once"):
        inner, after = _in_order(setting, scope, written.children)
        return Step(written, children=inner), after
    if written.kind in ("try", "invert"):
        inner, after = _in_order(setting, scope, written.children)
        return Step(written, children=inner), _either(scope, scope, after)
    apart = [step(setting, scope, child) for child in written.children]
    afters = [after for _, after in apart]
    together = Step(written, children=tuple(understood for understood, _ in apart))
    match written.kind:
        case "par all":
            return together, _all(scope, *afters)
        case "par lead":
            return together, _all(_either(scope, scope, *afters), *afters[:1])
        case _:
            return together, _either(scope, *afters)


def _if(setting: Setting, scope: Scope, written: s.If) -> tuple[Step, Scope]:
    guard = clause(setting, scope, written.condition)
    then, after_then = _in_order(setting, scope, written.then)
    otherwise, after_else = _in_order(setting, scope, written.orelse or ())
    return Step(written, clauses=(guard,), children=then, orelse=otherwise), _either(scope, after_then, after_else)


def _for(setting: Setting, scope: Scope, written: s.For) -> tuple[Step, Scope]:
    items = value(setting, scope, written.items, Wanted(ListOf(UNKNOWN)))
    element = items.type.element if isinstance(items.type, ListOf) else UNKNOWN
    bound = setting.bind(scope, written.variable, Variable(element, "loop variable", written.variable.span))
    inner, after = _in_order(setting, bound, written.children)
    left = replace(after, variables={n: v for n, v in after.variables.items() if n != written.variable.text})
    return Step(written, (items,), children=inner), _either(scope, scope, left)


def _either(before: Scope, *afters: Scope) -> Scope:
    """Return the scope when one of several ways was taken: an output is sure if every way assigns it."""
    return _merged(before, afters, lambda sure: bool(sure) and all(sure))


def _all(before: Scope, *afters: Scope) -> Scope:
    """Return the scope when all ways were taken: an output is sure if one way assigns it."""
    return _merged(before, afters, any)


def _merged(before: Scope, afters: Sequence[Scope], decide: _Decision) -> Scope:
    merged = dict(before.variables)
    for name in dict.fromkeys(name for after in afters for name in after.variables):
        seen = next(after.variables[name] for after in afters if name in after.variables)
        sure = [name in after.variables and after.variables[name].sure for after in afters]
        merged[name] = replace(seen, sure=decide(sure) or (name in before.variables and before.variables[name].sure))
    return replace(before, variables=merged)
