"""The Python class of a primitive, found by its name "module:Class" and checked against the skill's parameters."""

from __future__ import annotations

import importlib
import inspect
from collections.abc import Callable, Mapping, Sequence
from functools import cache

from skillc_compiler.library.skills import Parameter
from skillc_runtime.primitives.primitive import Primitive
from skillc_runtime.world.state.python_calls import EvaluationError, load_python


class PrimitiveError(Exception):
    """A primitive's class cannot be had or takes other parameters; the message says what to change."""


CALLED_WITH = {"start": (), "tick": (), "halt": ("why",), "pause": (), "resume": (), "release": ()}
"""The methods of a primitive that are called, with what."""


@cache
def primitive_class(python: str) -> type[Primitive]:
    """Import "module:Class"; PrimitiveError when that is not there, or no Primitive whose methods can be called."""
    module_name, _, class_name = python.partition(":")
    try:
        module = importlib.import_module(module_name)
    except (Exception, SystemExit) as error:  # foreign code: whatever it raises, it cannot be used
        reason = error if isinstance(error, ImportError) else f"{type(error).__name__}: {error}"
        raise PrimitiveError(f"the Python module of `{python}` cannot be imported: {reason}") from error
    found = getattr(module, class_name, None)
    if found is None:
        raise PrimitiveError(f"the Python module {module_name} has no class {class_name}")
    if not (isinstance(found, type) and issubclass(found, Primitive)):
        raise PrimitiveError(f"`{python}` is no subclass of skillc_runtime.primitives.primitive.Primitive")
    if found.tick is Primitive.tick:
        raise PrimitiveError(f"`{python}` has no method `tick`")
    if not _are_text_names(found.text_names):
        raise PrimitiveError(f"`text_names` of `{python}` is not {{parameter: (parameter, relation, .., property)}}")
    for name, values in CALLED_WITH.items():
        problem = _refused(getattr(found, name), None, *values)
        if problem is not None:
            raise PrimitiveError(f"the method `{name}` of `{python}` cannot be called: {problem}")
    return found


def _are_text_names(names: object) -> bool:
    """Whether this is of the form that `Primitive.text_names` has."""
    return isinstance(names, Mapping) and all(
        isinstance(parameter, str)
        and isinstance(chain, tuple)
        and len(chain) > 1
        and all(isinstance(part, str) for part in chain)
        for parameter, chain in names.items()
    )


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
    cls = primitive_class(python)
    reason = _refused(cls, None, **dict.fromkeys(given))
    if reason is None:
        return None
    taken = list(inspect.signature(cls).parameters.values())[1:]
    anything = any(each.kind is each.VAR_KEYWORD for each in taken)
    untaken = [] if anything else [name for name in given if name not in {each.name for each in taken}]
    if untaken:
        return f"takes no parameter {', '.join(untaken)}"
    single = (each for each in taken if each.kind not in (each.VAR_POSITIONAL, each.VAR_KEYWORD))
    ungiven = sorted({each.name for each in single if each.default is each.empty} - set(given))
    return f"needs the parameter {', '.join(ungiven)}" if ungiven else f"cannot be called: {reason}"


@cache
def function_problem(python: str, count: int) -> str | None:
    """Return why "module:function" cannot be called with the world and so many values, None when it can."""
    try:
        function = load_python(python)
    except EvaluationError as error:
        return str(error)
    reason = _refused(function, None, *(None,) * count) if callable(function) else "it is no function"
    return None if reason is None else f"the Python function {python} cannot be called with {count} values: {reason}"


def _refused(called: Callable[..., object], /, *values: object, **named: object) -> str | None:
    """Return why Python would refuse a call; None when it would not, or when that cannot be told."""
    if inspect.iscoroutinefunction(called):
        return "it is `async`, which is never waited for"
    try:
        inspect.signature(called).bind(*values, **named)
    except TypeError as error:
        return str(error)
    except ValueError:
        return None
    return None
