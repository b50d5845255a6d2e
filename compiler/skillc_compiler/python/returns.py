"""What a method of a class may return, read from its text."""

from __future__ import annotations

import ast

from skillc_compiler.python.modules import Defined, Definition, Function, defined_by, definition


def returned(module: str, name: str, method: str) -> frozenset[str]:
    """Return the last name of everything that a method of a class may return; none where the text does not tell."""
    return _returned(definition(module, name), method, frozenset())


def _returned(found: Definition, method: str, seen: frozenset[str]) -> frozenset[str]:
    match found:
        case Defined(module=module, node=ast.ClassDef() as cls) if f"{module}:{cls.name}" not in seen:
            own = [part for part in cls.body if isinstance(part, Function) and part.name == method]
            if own:
                return frozenset(_last_name(node.value) for node in ast.walk(own[-1]) if isinstance(node, ast.Return))
            if len(cls.bases) == 1:
                return _returned(defined_by(module, cls.bases[0]), method, seen | {f"{module}:{cls.name}"})
    return frozenset()


def _last_name(value: ast.expr | None) -> str:
    match value:
        case ast.Attribute(attr=name) | ast.Name(id=name):
            return name
        case _:
            return "?"
