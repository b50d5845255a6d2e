"""What a `tick` certainly returns that is no status: in itself, by its names, and by what it calls."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import NamedTuple

from skillc_compiler.python.classes import Lineage, find_method, qualified_name
from skillc_compiler.python.endings import (
    NeverReturns,
    loops_forever,
    open_end,
    own_nodes,
    returned,
)
from skillc_compiler.python.modules import Defined, Function, resolve_expression

STATUS = "skillc_runtime.primitives.primitive:Status"
ALLOWED = ("RUNNING", "SUCCESS")
NO_STATUS = frozenset(("None", "bool", "int", "float", "str", "bytes", "list", "dict", "tuple", "set"))
ENUMS = frozenset(("Enum", "IntEnum", "StrEnum", "Flag", "IntFlag"))
MOST_CALLS = 3
"""How many calls are followed, one inside the other."""


class Wrong(NamedTuple):
    """What is wrong, and the statement at which it is, in the module of which class or function."""

    of: Defined
    at: ast.stmt
    what: str


class Reader(NamedTuple):
    """Reads a function of a class or module: `of` is where it is defined, `lineage` whose method `self` has."""

    of: Defined
    function: Function
    lineage: Lineage
    never_returns: NeverReturns
    depth: int = MOST_CALLS

    def find_wrong(self) -> Iterator[Wrong]:
        """Yield what is wrong: the annotation, what it returns, where it ends without a status, that it never ends."""
        function = self.function
        if function.returns is not None and _annotated(function.returns) in NO_STATUS:
            yield Wrong(self.of, function, f"is annotated to return `{ast.unparse(function.returns)}`")
        if any(isinstance(node, ast.Yield | ast.YieldFrom) for node in own_nodes(function)):
            yield Wrong(self.of, function, "is a generator, as it has a `yield`")
            return
        for line, value in returned(function):
            if value is None:
                yield Wrong(self.of, line, "returns nothing")
                continue
            if wrong := self._find_no_status(value):
                yield Wrong(self.of, line, f"returns {wrong}")
            yield from self._find_in_called(value)
        end = open_end(function, self.never_returns)
        if end is not None:
            yield Wrong(self.of, end, "can end without `return`")
        elif (loop := loops_forever(function)) is not None:
            yield Wrong(self.of, loop, "never returns, as it has a loop without end")

    def _find_no_status(self, value: ast.expr) -> str:
        """Return the text of a value that is certainly neither RUNNING nor SUCCESS; empty if it may be one of them."""
        text = f"`{ast.unparse(value)}`"
        match value:
            case ast.Constant() | ast.JoinedStr() | ast.List() | ast.Tuple() | ast.Dict() | ast.Set() | ast.Compare():
                return text
            case ast.UnaryOp(op=ast.Not()):
                return text
            case ast.BoolOp(op=ast.And(), values=[*first, _]) if any(map(_is_truth_value, first)):
                return f"{text}, which may be `False`"
            case ast.Attribute(value=of, attr=name):
                return "" if name in ALLOWED or not self._is_other_enum(of) else text
            case ast.Name(id=name):
                return self._find_in_name(name)
            case _:
                return ""

    def _is_other_enum(self, of: ast.expr) -> bool:
        """Whether a member of it, but for those allowed of `Status`, is no status for certain."""
        if isinstance(of, ast.Name) and _bindings(self.function, of.id):
            return False
        match resolve_expression(self.of.module, of):
            case Defined(node=ast.ClassDef(bases=bases)):
                return any(ast.unparse(each).rpartition(".")[2] in ENUMS for each in bases)
            case _:
                return ast.unparse(of).rpartition(".")[2] == "Status"

    def _find_in_name(self, name: str) -> str:
        """Return what is wrong with the value of a name: the only one, or the last one if it is for returning alone."""
        bindings = _bindings(self.function, name)
        if not bindings:
            found = resolve_expression(self.of.module, ast.Name(name, ast.Load()))
            return f"the class `{name}`" if isinstance(found, Defined) and qualified_name(found) == STATUS else ""
        last = bindings[-1]
        if any(not isinstance(each, ast.Assign) for each in bindings) or not isinstance(last, ast.Assign):
            return ""
        loads = [n for n in own_nodes(self.function) if isinstance(n, ast.Name) and n.id == name]
        read = sum(isinstance(each.ctx, ast.Load) for each in loads)
        only_returned = read == sum(isinstance(v, ast.Name) and v.id == name for _, v in returned(self.function))
        is_member = isinstance(last.value, ast.Attribute)
        if isinstance(last.value, ast.Name) or not (only_returned or (len(bindings) == 1 and not is_member)):
            return ""
        wrong = self._find_no_status(last.value)
        return f"`{name}`, which is {wrong}" if wrong else ""

    def _find_in_called(self, value: ast.expr) -> Iterator[Wrong]:
        """Yield what is wrong with a method of `self`, or a function, whose result is returned."""
        called = self._find_called(value)
        if called is None or not self.depth or called.function.decorator_list:
            return
        if isinstance(called.function, ast.AsyncFunctionDef):
            return
        for each in called.find_wrong():
            yield each._replace(what=f"returns `{ast.unparse(value)}`, and `{called.function.name}` {each.what}")

    def _find_called(self, value: ast.expr) -> Reader | None:
        match value:
            case ast.Call(func=ast.Attribute(value=ast.Name(id="self"), attr=name)):
                known = (each for each in self.lineage if isinstance(each, Defined))
                found = ((each, method) for each in known if (method := find_method(each, name)) is not None)
                cls, method = next(found, (None, None))
                if cls is None or method is None:
                    return None
                return self._replace(of=cls, function=method, depth=self.depth - 1)
            case ast.Call(func=ast.Name(id=name)) if not _bindings(self.function, name):
                target = resolve_expression(self.of.module, value.func)
                if isinstance(target, Defined) and isinstance(target.node, Function):
                    return self._replace(of=target, function=target.node, depth=self.depth - 1)
        return None


def _annotated(returns: ast.expr) -> str:
    return str(returns.value) if isinstance(returns, ast.Constant) else ast.unparse(returns).partition("[")[0]


def _is_truth_value(value: ast.expr) -> bool:
    return isinstance(value, ast.Compare) or (isinstance(value, ast.UnaryOp) and isinstance(value.op, ast.Not))


def _bindings(function: Function, name: str) -> list[ast.AST]:
    """Return what gives a name a value in a function, in the order of the text: assignments, and other nodes."""
    found: list[ast.AST] = [each for each in ast.walk(function.args) if isinstance(each, ast.arg) and each.arg == name]
    assigned: list[ast.AST] = []
    for node in own_nodes(function):
        match node:
            case ast.Assign(targets=[ast.Name(id=target)]) if target == name:
                assigned.append(node)
            case ast.Global(names=names) | ast.Nonlocal(names=names) if name in names:
                found.append(node)
            case ast.FunctionDef(name=own) | ast.ClassDef(name=own) | ast.MatchAs(name=own) if own == name:
                found.append(node)
            case ast.ExceptHandler(name=own) | ast.MatchStar(name=own) if own == name:
                found.append(node)
            case ast.alias(name=own, asname=other) if name in (own, other):
                found.append(node)
    stored = [
        each
        for each in own_nodes(function)
        if isinstance(each, ast.Name) and each.id == name and not isinstance(each.ctx, ast.Load)
    ]
    if len(stored) != len(assigned):
        found += stored
    return [*sorted(assigned, key=lambda each: (each.lineno, each.col_offset)), *found]  # type: ignore[attr-defined]
