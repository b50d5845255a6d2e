"""The Python class of a primitive, found by its name "module:Class" and checked against the skill's parameters."""

from __future__ import annotations

import importlib
import inspect
from collections.abc import Sequence
from functools import cache

from skillc_compiler.library.skills import Parameter
from skillc_runtime.primitives.primitive import Primitive


class PrimitiveError(Exception):
    """A primitive's class cannot be had or takes other parameters; the message says what to change."""


@cache
def primitive_class(python: str) -> type[Primitive]:
    """Import "module:Class"; PrimitiveError when that is not there or no Primitive."""
    module_name, _, class_name = python.partition(":")
    try:
        module = importlib.import_module(module_name)
    except ImportError as error:
        raise PrimitiveError(f"the Python module of `{python}` cannot be imported: {error}") from error
    found = getattr(module, class_name, None)
    if found is None:
        raise PrimitiveError(f"the Python module {module_name} has no class {class_name}")
    if not (isinstance(found, type) and issubclass(found, Primitive)):
        raise PrimitiveError(f"`{python}` is no subclass of skillc_runtime.primitives.primitive.Primitive")
    return found


def fitting_class(python: str, parameters: Sequence[Parameter]) -> type[Primitive]:
    """Import a primitive's class and check that its constructor takes the cell and exactly these parameters by name.

    Outputs are not passed. PrimitiveError names what is missing or too much.
    """
    cls = primitive_class(python)
    given = tuple(parameter.name for parameter in parameters if parameter.direction != "out")
    problem = _mismatch(python, given)
    if problem is not None:
        raise PrimitiveError(f"{cls.__name__} in `{python}` {problem}; the skill gives ({', '.join(given)})")
    return cls


@cache
def _mismatch(python: str, given: tuple[str, ...]) -> str | None:
    _, *taken = inspect.signature(primitive_class(python)).parameters.values()
    if any(parameter.kind is parameter.VAR_KEYWORD for parameter in taken):
        return None
    names = {parameter.name for parameter in taken}
    needed = {parameter.name for parameter in taken if parameter.default is parameter.empty}
    untaken = [name for name in given if name not in names]
    ungiven = sorted(needed - set(given))
    if untaken:
        return f"takes no parameter {', '.join(untaken)}"
    return f"needs the parameter {', '.join(ungiven)}" if ungiven else None
