"""Reads what a module says of a name."""

from __future__ import annotations

import ast

from skillc_compiler.python.classes import class_found
from skillc_compiler.python.found import Found
from skillc_compiler.python.modules import Defined, definition
from skillc_compiler.python.signatures import function_found


def read(module: str, name: str) -> Found:
    """Return what the name "module:name" is, as far as the texts of the modules tell."""
    found = definition(module, name)
    match found:
        case Defined(node=ast.ClassDef()):
            return class_found(found)
        case Defined(module=where, node=ast.FunctionDef() | ast.AsyncFunctionDef() as function):
            return function_found(where, function)
        case Defined():
            raise AssertionError(f"{module}:{name} is neither a class nor a function")
        case _:
            return found
