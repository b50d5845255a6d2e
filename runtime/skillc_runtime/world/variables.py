"""The names that a condition or expression leaves to the scope around it."""

from __future__ import annotations

from functools import lru_cache
from typing import assert_never

from skillc_compiler.library.conditions import (
    And,
    Anything,
    Arithmetic,
    Compare,
    Condition,
    Exists,
    Expression,
    Forall,
    Given,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Variable,
)

NO_NAMES: frozenset[str] = frozenset()


@lru_cache(maxsize=4096)
def free_variables(condition: Condition) -> frozenset[str]:
    """Return the names a condition reads; the parameter of `given` is one."""
    match condition:
        case Holds(left, _, right) | Same(left, right):
            return _names(left) | _names(right)
        case Compare(left, _, right):
            return _names(left) | _names(right)
        case HasProperty(subject, _) | IsA(subject, _):
            return _names(subject)
        case Given(parameter):
            return frozenset({parameter})
        case Not(body):
            return free_variables(body)
        case And(parts) | Or(parts):
            return NO_NAMES.union(*map(free_variables, parts))
        case Exists(variable, _, body) | Forall(variable, _, body):
            return free_variables(body) - {variable}
        case _:
            assert_never(condition)


def _names(part: Expression | Anything) -> frozenset[str]:
    match part:
        case Variable(name):
            return frozenset({name})
        case PropertyOf(of, _):
            return _names(of)
        case Arithmetic(_, left, right):
            return _names(left) | _names(right)
        case Invoke(_, arguments):
            return NO_NAMES.union(*map(_names, arguments))
        case Literal() | Individual() | Anything():
            return NO_NAMES
        case _:
            assert_never(part)
