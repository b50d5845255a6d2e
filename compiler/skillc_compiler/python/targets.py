"""What a Python target is, and what its methods may return, read from the source text."""

from __future__ import annotations

import ast
from functools import cache
from typing import NamedTuple

from skillc_compiler.program.program import Program
from skillc_compiler.python.classes import inspect_class
from skillc_compiler.python.contracts import Contract, read_contract
from skillc_compiler.python.info import TargetInfo
from skillc_compiler.python.modules import Defined, Definition, Function, Modules, find_definition, resolve_expression
from skillc_compiler.python.signatures import inspect_function


class Targets:
    """Reads what Python targets are; each, and each module that it takes, is read once until `refresh`."""

    def __init__(self) -> None:
        self._begin()

    def refresh(self) -> None:
        """Forget everything if a module that was looked for is another one now, or has changed."""
        if not self._modules.are_current():
            self._begin()

    @property
    def version(self) -> object:
        """The same object as long as nothing was forgotten."""
        return self._modules

    def _begin(self) -> None:
        self._modules = Modules()
        self.read = cache(self._read)
        self.method_returns = cache(self._method_returns)
        self.contract = cache(self._contract)

    def _read(self, module: str, name: str) -> TargetInfo:
        """Return what "module:name" is, as far as the source text of the modules determines it."""
        return _describe(find_definition(self._modules[module], name))

    def _method_returns(self, module: str, name: str, method: str) -> frozenset[str]:
        """Return the last name of every value that a method may return; empty if the text does not determine it."""
        return _returns(find_definition(self._modules[module], name), method, frozenset())

    def _contract(self, module: str, name: str) -> Contract:
        """Return what the text of a primitive says of its `tick` and of its outputs."""
        found = find_definition(self._modules[module], name)
        return (
            read_contract(found) if isinstance(found, Defined) and isinstance(found.node, ast.ClassDef) else Contract()
        )


class NamedPython(NamedTuple):
    """A program with what reads the Python that it names."""

    program: Program
    targets: Targets


def _describe(found: Definition) -> TargetInfo:
    match found:
        case Defined(node=ast.ClassDef()):
            return inspect_class(found)
        case Defined(module=where, node=ast.FunctionDef() | ast.AsyncFunctionDef() as function):
            return inspect_function(where, function)
        case Defined():
            raise AssertionError(f"{found} is neither a class nor a function")
        case _:
            return found


def _returns(found: Definition, method: str, seen: frozenset[str]) -> frozenset[str]:
    match found:
        case Defined(module=module, node=ast.ClassDef() as cls) if f"{module.name}:{cls.name}" not in seen:
            own = [part for part in cls.body if isinstance(part, Function) and part.name == method]
            if own:
                return frozenset(_last_name(node.value) for node in ast.walk(own[-1]) if isinstance(node, ast.Return))
            if len(cls.bases) == 1:
                return _returns(resolve_expression(module, cls.bases[0]), method, seen | {f"{module.name}:{cls.name}"})
    return frozenset()


def _last_name(value: ast.expr | None) -> str:
    match value:
        case ast.Attribute(attr=name) | ast.Name(id=name):
            return name
        case _:
            return "?"
