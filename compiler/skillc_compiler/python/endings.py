"""How a function can end: what it returns, and whether it can end without returning anything."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeAlias

from skillc_compiler.python.modules import Function

NeverReturns: TypeAlias = Callable[[ast.Call], bool]
"""Whether a call never returns, since what it calls always raises."""


def open_end(function: Function, never_returns: NeverReturns) -> ast.stmt | None:
    """Return the last statement if a function may end after it without `return`; None if it may not."""
    return function.body[-1] if _goes_on(function.body, never_returns) else None


def returned(function: Function) -> Iterator[tuple[ast.Return, ast.expr | None]]:
    """Yield each value that a function may return, None for a bare `return`."""
    for node in own_nodes(function):
        if isinstance(node, ast.Return):
            for value in _alternatives(node.value) if node.value is not None else (None,):
                yield node, value


def loops_forever(function: Function) -> ast.While | None:
    """Return a loop without end in a function that returns nothing; None if there is none."""
    nodes = list(own_nodes(function))
    if any(isinstance(node, ast.Return | ast.Yield | ast.YieldFrom) for node in nodes):
        return None
    loops = (node for node in nodes if isinstance(node, ast.While) and _is_true(node.test))
    return next((each for each in loops if not _has_break(each.body)), None)


def own_nodes(function: Function) -> Iterator[ast.AST]:
    """Yield the nodes of a function, without those of functions and classes inside it."""
    waiting: list[ast.AST] = list(function.body)
    while waiting:
        node = waiting.pop(0)
        yield node
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Lambda):
            waiting += ast.iter_child_nodes(node)


def always_raises(function: Function, never_returns: NeverReturns) -> bool:
    """Whether a function returns nothing and does not end by itself."""
    return not _goes_on(function.body, never_returns) and not any(
        isinstance(node, ast.Return | ast.Yield | ast.YieldFrom) for node in own_nodes(function)
    )


def _alternatives(value: ast.expr) -> Iterator[ast.expr]:
    if isinstance(value, ast.IfExp):
        yield from _alternatives(value.body)
        yield from _alternatives(value.orelse)
    else:
        yield value


def _goes_on(body: Sequence[ast.stmt], never_returns: NeverReturns) -> bool:
    """Whether what follows statements may be reached."""
    return all(_passes(statement, never_returns) for statement in body)


def _passes(statement: ast.stmt, never_returns: NeverReturns) -> bool:
    match statement:
        case ast.Return() | ast.Raise() | ast.Break() | ast.Continue():
            return False
        case ast.Expr(value=ast.Call() as call):
            return not never_returns(call)
        case ast.Assert(test=ast.Constant(value=False)):
            return False
        case ast.If(test=test, body=body, orelse=orelse):
            branches = (body,) if _is_true(test) else (body, orelse)
            return any(_goes_on(each, never_returns) for each in branches)
        case ast.While(test=test):
            return not _is_true(test) or _has_break(statement.body)
        case ast.Try() | ast.TryStar():
            return _passes_try(statement, never_returns)
        case ast.With(items=items, body=body) | ast.AsyncWith(items=items, body=body):
            return any(map(_may_suppress, items)) or _goes_on(body, never_returns)
        case ast.Match(cases=cases):
            return not _may_be_all(cases) or any(_goes_on(each.body, never_returns) for each in cases)
        case _:
            return True


def _may_be_all(cases: Sequence[ast.match_case]) -> bool:
    """Whether cases may be all that there are: one is for all others, or all are of members."""
    if any(each.guard is None and isinstance(each.pattern, ast.MatchAs) and not each.pattern.pattern for each in cases):
        return True
    patterns = (part for each in cases for part in ast.walk(each.pattern))
    values = (isinstance(part, ast.MatchValue) and isinstance(part.value, ast.Constant) for part in patterns)
    return not any(each.guard is not None for each in cases) and not any(values)


def _passes_try(statement: ast.Try | ast.TryStar, never_returns: NeverReturns) -> bool:
    if not _goes_on(statement.finalbody, never_returns):
        return False
    ways = ([*statement.body, *statement.orelse], *(handler.body for handler in statement.handlers))
    return any(_goes_on(way, never_returns) for way in ways)


def _may_suppress(item: ast.withitem) -> bool:
    match item.context_expr:
        case ast.Call(func=ast.Name(id="suppress") | ast.Attribute(attr="suppress")):
            return True
        case _:
            return False


def _has_break(body: Iterable[ast.stmt]) -> bool:
    """Whether a loop may be left by a `break` of its own."""
    return any(isinstance(each, ast.Break) or _has_break(_inside(each)) for each in body)


def _inside(statement: ast.stmt) -> Iterator[ast.stmt]:
    """Yield the statements inside another one to which its `break` belongs."""
    match statement:
        case ast.For() | ast.AsyncFor() | ast.While():
            yield from statement.orelse
        case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
            return
        case _:
            for node in ast.iter_child_nodes(statement):
                yield from _statements_of(node)


def _statements_of(part: ast.AST) -> Iterator[ast.stmt]:
    """Yield a part of a statement that is a statement itself, or those of a handler or a case."""
    match part:
        case ast.stmt():
            yield part
        case ast.ExceptHandler() | ast.match_case():
            yield from part.body


def _is_true(test: ast.expr) -> bool:
    return isinstance(test, ast.Constant) and bool(test.value)
