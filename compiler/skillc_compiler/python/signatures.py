"""Signatures of functions, read from the source text."""

from __future__ import annotations

import ast

from skillc_compiler.python.info import FunctionInfo, PythonSignature
from skillc_compiler.python.modules import Function, Module, dotted_name

PLAIN_DECORATORS = frozenset(
    (
        *("functools.cache", "functools.lru_cache", "typing.override", "typing.final", "typing_extensions.override"),
        *("numba.njit", "numba.jit", "abc.abstractmethod"),
    )
)
"""Decorators that do not change the signature."""


def inspect_function(module: Module, function: Function) -> FunctionInfo:
    """Return a function with its signature, None if a decorator may have changed it."""
    plain = all(dotted_name(module, each) in PLAIN_DECORATORS for each in function.decorator_list)
    return FunctionInfo(read_signature(function) if plain else None, isinstance(function, ast.AsyncFunctionDef))


def inspect_method(module: Module, function: Function) -> FunctionInfo:
    """Return a method with its signature without `self`."""
    found = inspect_function(module, function)
    return FunctionInfo(found.signature and found.signature.without_first(1), found.asynchronous)


def read_signature(function: Function) -> PythonSignature:
    """Return the parameters of a function."""
    arguments = function.args
    positional = [*arguments.posonlyargs, *arguments.args]
    optional = [*positional[len(positional) - len(arguments.defaults) :]] if arguments.defaults else []
    optional += [each for each, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True) if default]
    return PythonSignature(
        by_position=tuple(each.arg for each in positional),
        unnamed=len(arguments.posonlyargs),
        by_name=tuple(each.arg for each in arguments.kwonlyargs),
        needed=tuple(each.arg for each in (*positional, *arguments.kwonlyargs) if each not in optional),
        args=arguments.vararg is not None,
        named=arguments.kwarg is not None,
    )
