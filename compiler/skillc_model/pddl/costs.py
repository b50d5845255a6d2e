"""Action costs: expected durations in seconds, as exact fractions, which planners get as whole units."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from fractions import Fraction
from math import floor, gcd, lcm, log10
from numbers import Real

from skillc_model.conditions import Expression, Invoke, PropertyOf
from skillc_model.pddl.domain import ComputedCost, Cost, CostFunction, FixedCost
from skillc_model.pddl.kebab import to_kebab
from skillc_model.pddl.names import make_unique
from skillc_model.pddl.symbols import Symbols
from skillc_model.pddl.translate import Scope, Untranslatable
from skillc_model.rewriting import constant_number
from skillc_model.skills import Implementation, Skill
from skillc_model.traversal import free_variables_in_order, walk
from skillc_rdf.vocabulary.types import ClassType

ASSUMED_SECONDS = Fraction(1)

MOST_UNITS = 10_000_000
"""The highest cost of an action, in units: planners sum costs as 32-bit integers."""

_ROUNDED_UNITS = 1_000_000
"""Durations without a common unit are rounded down so that the longest takes no more units than this."""

_MOST_DIGITS = 15
"""Decimal text of at most this many digits survives conversion to float; longer decimals were computed."""

_NOISE = 4e-15
"""Relative rounding error of floating-point computations."""

_MOST_DENOMINATOR = 10**6


def exact_seconds(value: object) -> Fraction:
    """Return a duration, in seconds, as a fraction without rounding errors; ValueError unless it is finite and >= 0."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise ValueError("it is not a number")
    seconds = float(value)
    if not 0.0 <= seconds < float("inf"):
        raise ValueError(f"it is {seconds:g} s")
    written = Fraction(repr(seconds))
    if _digits(written) <= _MOST_DIGITS:
        return written
    near = written.limit_denominator(_MOST_DENOMINATOR)
    return near if abs(near - written) <= _NOISE * written else written


def _digits(decimal: Fraction) -> int:
    """Return the number of significant digits of a decimal fraction."""
    scaled = decimal
    while scaled.denominator > 1:
        scaled *= 10
    return len(str(scaled.numerator).rstrip("0"))


def common_scale(durations: Iterable[Fraction]) -> Fraction:
    """Return the units per second with which all durations are whole numbers small enough for planners.

    If there is no such scale, the longest duration determines it and `PlanningDomain.units` rounds down.
    """
    different = set(durations)
    longest = max(different, default=Fraction(0))
    scale, unit = 1, 0
    for each in different:
        scale = lcm(scale, each.denominator)
        if scale > MOST_UNITS**3:
            return _rounding_scale(longest)
    if longest * scale <= MOST_UNITS:
        return Fraction(scale)
    for each in different:
        unit = gcd(unit, int(each * scale))
    if longest * scale <= MOST_UNITS * unit:
        return Fraction(scale, unit)
    return _rounding_scale(longest)


def _rounding_scale(longest: Fraction) -> Fraction:
    return Fraction(10) ** floor(log10(_ROUNDED_UNITS / longest))


def find_duration(skill: Skill, implementation: Implementation) -> Expression | None:
    """Return the duration of a skill when this implementation runs it, None if neither states one."""
    return skill.duration if implementation.duration is None else implementation.duration


def action_cost(
    skill: str, duration: Expression | None, scope: Scope, symbols: Symbols, taken: Collection[str]
) -> tuple[Cost, CostFunction | None]:
    """Return a duration as a cost (None: one second), with a cost function if it depends on the arguments.

    The function is evaluated once, in the initial world.
    """
    if duration is None:
        return FixedCost(ASSUMED_SECONDS), None
    seconds = constant_number(duration)
    if seconds is not None:
        try:
            return FixedCost(exact_seconds(seconds)), None
        except ValueError as reason:
            raise Untranslatable(f"its duration cannot be planned with: {reason}") from reason
    variables = free_variables_in_order(duration)
    for name in variables:
        if name not in scope:
            raise Untranslatable(f"its duration reads `{name}`, which a planner does not bind")
    places = tuple(scope[name].variable for name in variables)
    name = make_unique(f"cost-{to_kebab(skill)}", taken)
    function = CostFunction(name, places, variables, duration, skill, _moving(duration, symbols))
    return ComputedCost(name, tuple(each.name for each in places)), function


def _moving(expression: Expression, symbols: Symbols) -> str | None:
    """Return a term (IRI or function) that the duration depends on and skills may change, None if there is none."""
    functions = symbols.vocabulary.functions
    for each in walk(expression):
        match each:
            case PropertyOf(property=iri):
                computed = symbols.vocabulary.is_computed(iri) and symbols.decided_by(iri)
                if computed or symbols.affected(iri):
                    return iri
            case Invoke(function=name):
                if symbols.changing and any(isinstance(kind, ClassType) for _, kind in functions[name].parameters):
                    return name
            case _:
                pass
    return None
