"""What a function takes, read from its text."""

from __future__ import annotations

import ast

from skillc_compiler.python.found import FunctionFound, Signature
from skillc_compiler.python.modules import Function, dotted

PLAIN_DECORATORS = frozenset(
    (
        *("functools.cache", "functools.lru_cache", "typing.override", "typing.final", "typing_extensions.override"),
        *("numba.njit", "numba.jit", "abc.abstractmethod"),
    )
)
"""Decorators that leave what a function takes as it is."""


def function_found(module: str, function: Function) -> FunctionFound:
    """Return a function's signature, None for one that a decorator may have changed."""
    plain = all(dotted(module, each) in PLAIN_DECORATORS for each in function.decorator_list)
    return FunctionFound(signature_of(function) if plain else None, isinstance(function, ast.AsyncFunctionDef))


def method_found(module: str, function: Function) -> FunctionFound:
    """Return a method's signature without `self`."""
    found = function_found(module, function)
    return FunctionFound(found.signature and found.signature.without_first(1), found.asynchronous)


def signature_of(function: Function) -> Signature:
    """Return all parameters of a function."""
    arguments = function.args
    positional = [*arguments.posonlyargs, *arguments.args]
    optional = [*positional[len(positional) - len(arguments.defaults) :]] if arguments.defaults else []
    optional += [each for each, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True) if default]
    return Signature(
        by_position=tuple(each.arg for each in positional),
        unnamed=len(arguments.posonlyargs),
        by_name=tuple(each.arg for each in arguments.kwonlyargs),
        needed=tuple(each.arg for each in (*positional, *arguments.kwonlyargs) if each not in optional),
        args=arguments.vararg is not None,
        named=arguments.kwarg is not None,
    )
