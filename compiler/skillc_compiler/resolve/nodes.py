"""Understanding bodies: the values, conditions and calls of nodes, and where outputs have their values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import assert_never

from skillc_compiler.program.typed import Step
from skillc_compiler.program.types import UNKNOWN, ListOf, Measure
from skillc_compiler.resolve.calls import call
from skillc_compiler.resolve.conditions import clause
from skillc_compiler.resolve.scope import Scope, Setting, Variable
from skillc_compiler.resolve.values import Wanted, value
from skillc_dsl import syntax as s
from skillc_dsl.units import TIME

SECONDS = Wanted(Measure(TIME))


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
            return Step(written, clauses=(guard,), children=inner), _together(scope, after)
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
    if written.kind in ("seq", "reactive seq", "once", "try", "invert"):
        inner, after = _in_order(setting, scope, written.children)
        return Step(written, children=inner), after
    apart = [step(setting, scope, child) for child in written.children]
    children = tuple(understood for understood, _ in apart)
    return Step(written, children=children), _together(scope, *(after for _, after in apart))


def _if(setting: Setting, scope: Scope, written: s.If) -> tuple[Step, Scope]:
    guard = clause(setting, scope, written.condition)
    then, after_then = _in_order(setting, scope, written.then)
    otherwise, after_else = _in_order(setting, scope, written.orelse or ())
    return Step(written, clauses=(guard,), children=then, orelse=otherwise), _together(after_then, after_else)


def _for(setting: Setting, scope: Scope, written: s.For) -> tuple[Step, Scope]:
    items = value(setting, scope, written.items, Wanted(ListOf(UNKNOWN)))
    element = items.type.element if isinstance(items.type, ListOf) else UNKNOWN
    bound = setting.bind(scope, written.variable, Variable(element, "loop variable", written.variable.span))
    inner, after = _in_order(setting, bound, written.children)
    left = replace(after, variables={n: v for n, v in after.variables.items() if n != written.variable.text})
    return Step(written, (items,), children=inner), _together(scope, left)


def assignable(scope: Scope) -> Scope:
    """Return the scope of a body, in which outputs may be read; whether they have a value there is proved later."""
    return replace(scope, variables={name: replace(v, sure=True) for name, v in scope.variables.items()})


def _together(*scopes: Scope) -> Scope:
    """Return a scope with the names of all."""
    merged = {name: variable for scope in reversed(scopes) for name, variable in scope.variables.items()}
    return replace(scopes[0], variables=merged)
