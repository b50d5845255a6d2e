"""Imports the Python classes of primitives, given as "module:Class", and checks that they can be called."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from importlib.util import find_spec
from typing import get_args

from skillc_model.skills import Parameter
from skillc_runtime.platforms.python_modules import import_named
from skillc_runtime.primitives.primitive import Activity, Phase, Primitive
from skillc_runtime.world.state.python_calls import (
    FOREIGN_ERRORS,
    EvaluationError,
    ForeignError,
    foreign_code,
    load_python,
)


class PrimitiveError(Exception):
    """A primitive's class cannot be imported or has other parameters; the message says what to change."""


CAN_RUN = find_spec("mujoco") is not None
"""Whether primitives can be imported: they need what is not installed where tasks are only checked and planned."""
METHOD_ARGUMENTS = {
    "start": (),
    "tick": (),
    "halt": ("why",),
    "pause": (),
    "withdraw": (),
    "approach": (),
    "resume": (),
    "release": (),
}
"""The methods of a primitive that are called, with placeholders for their arguments."""


@cache
def import_primitive(python: str) -> type[Primitive]:
    """Import "module:Class"; PrimitiveError if it does not exist or is not a Primitive whose methods can be called.

    Where none can run, nothing is known of any: `Primitive` stands for it.
    """
    if not CAN_RUN:
        return Primitive
    module_name, _, class_name = python.partition(":")
    try:
        with foreign_code:
            module = import_named(module_name)
    except FOREIGN_ERRORS as error:  # user code: whatever it raises, it cannot be used
        reason = error if isinstance(error, ImportError | ForeignError) else f"{type(error).__name__}: {error}"
        raise PrimitiveError(f"the Python module of `{python}` cannot be imported: {reason}") from error
    found = getattr(module, class_name, None)
    if found is None:
        raise PrimitiveError(f"the Python module {module_name} has no class {class_name}")
    if not (isinstance(found, type) and issubclass(found, Primitive)):
        raise PrimitiveError(f"`{python}` is not a subclass of skillc_runtime.primitives.primitive.Primitive")
    if found.tick is Primitive.tick:
        raise PrimitiveError(f"`{python}` has no method `tick`")
    problem = _check_declarations(found, python)
    if problem is not None:
        raise PrimitiveError(problem)
    for name, values in METHOD_ARGUMENTS.items():
        problem = _check_call(getattr(found, name), None, *values)
        if problem is not None:
            raise PrimitiveError(f"the method `{name}` of `{python}` cannot be called: {problem}")
    return found


def _check_declarations(cls: type[Primitive], python: str) -> str | None:
    """Return which class attribute of a primitive has the wrong form, None if all are right."""
    if not _is_valid_text_names(cls.text_names):
        return f"`text_names` of `{python}` is not {{parameter: (parameter, relation, .., property)}}"
    if cls.activity not in get_args(Activity):
        return f"`activity` of `{python}` is none of {', '.join(filter(None, get_args(Activity)))}"
    if not _are_highlights(cls.highlights):
        return f"`highlights` of `{python}` is not ((begins or ends, parameter, word), ..)"
    if not _is_valid_moves(cls.moves):
        return f"`moves` of `{python}` is neither None nor {{parameter: parameter of the place or None}}"
    for name in ("uses_devices", "stays_put"):
        if not isinstance(getattr(cls, name), bool):
            return f"`{name}` of `{python}` is not True or False"
    return None


def _is_valid_text_names(names: object) -> bool:
    """Whether this has the form of `Primitive.text_names`."""
    return isinstance(names, Mapping) and all(
        isinstance(parameter, str)
        and isinstance(chain, tuple)
        and len(chain) > 1
        and all(isinstance(part, str) for part in chain)
        for parameter, chain in names.items()
    )


def _are_highlights(highlights: object) -> bool:
    """Whether this is of the form that `Primitive.highlights` has."""
    return isinstance(highlights, tuple) and all(
        isinstance(each, tuple)
        and len(each) == 3
        and all(isinstance(part, str) for part in each)
        and each[0] in get_args(Phase)
        for each in highlights
    )


def _is_valid_moves(moves: object) -> bool:
    """Whether this has the form of `Primitive.moves`."""
    return moves is None or (
        isinstance(moves, Mapping)
        and all(isinstance(thing, str) and (place is None or isinstance(place, str)) for thing, place in moves.items())
    )


def import_matching_primitive(python: str, parameters: Sequence[Parameter]) -> type[Primitive]:
    """Import a primitive's class and check that its constructor takes the cell and exactly these parameters by name.

    Outputs are not passed. PrimitiveError lists missing and unknown parameters.
    """
    cls = import_primitive(python)
    passed = tuple(parameter.name for parameter in parameters if parameter.direction != "out")
    problem = _check_constructor(python, passed) if CAN_RUN else None
    if problem is not None:
        raise PrimitiveError(f"{cls.__name__} in `{python}` {problem}; the skill passes ({', '.join(passed)})")
    return cls


@cache
def _check_constructor(python: str, passed: tuple[str, ...]) -> str | None:
    cls = import_primitive(python)
    reason = _check_call(cls, None, **dict.fromkeys(passed))
    if reason is None:
        return None
    taken = list(inspect.signature(cls).parameters.values())[1:]
    accepts_any = any(each.kind is each.VAR_KEYWORD for each in taken)
    unknown = [] if accepts_any else [name for name in passed if name not in {each.name for each in taken}]
    if unknown:
        return f"takes no parameter {', '.join(unknown)}"
    single = (each for each in taken if each.kind not in (each.VAR_POSITIONAL, each.VAR_KEYWORD))
    missing = sorted({each.name for each in single if each.default is each.empty} - set(passed))
    return f"needs the parameter {', '.join(missing)}" if missing else f"cannot be called: {reason}"


@cache
def check_function(python: str, count: int) -> str | None:
    """Return why "module:function" cannot be called with the world and `count` values, None if it can."""
    try:
        function = load_python(python)
    except EvaluationError as error:
        return str(error)
    reason = _check_call(function, None, *(None,) * count) if callable(function) else "it is not a function"
    return None if reason is None else f"the Python function {python} cannot be called with {count} values: {reason}"


def _check_call(called: Callable[..., object], /, *values: object, **named: object) -> str | None:
    """Return why Python would reject a call; None if it would not, or if that cannot be determined."""
    if inspect.iscoroutinefunction(called):
        return "it is `async` and would not be awaited"
    try:
        inspect.signature(called).bind(*values, **named)
    except TypeError as error:
        return str(error)
    except ValueError:
        return None
    return None
