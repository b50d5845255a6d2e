"""A value of the wrong type, of the wrong dimension, or without its unit."""

from __future__ import annotations

import re
from collections.abc import Iterator

from skillc_compiler.program.expected import Place, places
from skillc_compiler.program.typed import Program
from skillc_compiler.program.types import INT, TEXT, Direction, Measure, Thing, Vector, describe, fits, of_library
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.units import NUMBER, UNITS, Dimension
from skillc_model.conditions import Individual, Literal, Variable
from skillc_rdf.vocabulary.types import Vocabulary, local_name

NAMES = ("wrong-type", "wrong-dimension", "missing-unit")
_QUANTITY = re.compile(r"\s*(-?\d+(?:\.\d+)?)\s*([A-Za-z/0-9]*)\s*$")


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each value that does not fit where it stands."""
    for place in places(program):
        if not fits(program.vocabulary, place.value.type, place.wanted):
            name, help_ = _problem(program.vocabulary, place)
            has = "this number has no unit" if name == "missing-unit" else f"this is {describe(place.value.type)}"
            yield Diagnostic(
                name,
                place.value.span,
                f"{has}, where {describe(place.wanted)} is expected {place.by}",
                help=help_,
                labels=(Label(place.cause, "declared here"),) if place.cause else (),
            )


def _problem(vocabulary: Vocabulary, place: Place) -> tuple[str, str]:
    """Return the name of the problem and what to type."""
    given, wanted, meaning = place.value.type, place.wanted, place.value.meaning
    match wanted, given, meaning:
        case Measure(dimension=dimension), _, Literal(value=number) if given in (INT, Measure(NUMBER)):
            return "missing-unit", f"write it with its unit: `{number} {units_of(dimension)[0]}`"
        case Measure(dimension=dimension), Measure(), _:
            return "wrong-dimension", f"write it in {' or '.join(units_of(dimension)) or 'no unit'}"
        case Vector(), Vector() | Direction(), _:
            return "wrong-dimension", "multiply or divide it by a quantity of the missing dimension"
        case Direction(), Vector(), _:
            return "wrong-type", "a Direction is of length 1: take a property or a function that gives one"
        case Measure(dimension=dimension), _, Literal(value=str(text)) if given == TEXT:
            return "wrong-type", _unquoted(text, dimension)
        case Thing(), Thing(), _ if fits(vocabulary, wanted, given):
            return "wrong-type", f"not all of them are: declare or refine it as {describe(wanted)}"
        case _, Thing(), Variable() | Individual():
            return "wrong-type", _by_property(vocabulary, place)
    return "wrong-type", ""


def units_of(dimension: Dimension) -> tuple[str, ...]:
    """Return the units of a dimension, the SI unit first."""
    fitting = [(abs(unit.in_si - 1.0) > 0, name) for name, unit in UNITS.items() if unit.dimension == dimension]
    return tuple(name for _, name in sorted(fitting))


def _unquoted(text: str, dimension: Dimension) -> str:
    found = _QUANTITY.match(text)
    if found is None:
        return f"write a number with its unit, {' or '.join(units_of(dimension))}"
    return f"write it without quotes: `{' '.join(part for part in found.groups() if part)}`"


def _by_property(vocabulary: Vocabulary, place: Place) -> str:
    """Suggest a property that leads from the individual to what is wanted, such as `grasp.pose`."""
    leading = sorted(
        local_name(term.iri)
        for term in vocabulary.properties.values()
        if of_library(term.type) == place.wanted
        and any(fits(vocabulary, place.value.type, Thing(domain)) for domain in term.domains)
    )
    if not isinstance(place.value.meaning, Variable) or not 0 < len(leading) <= 3:
        return ""
    return f"take a property of it: {' or '.join(f'`{place.value.meaning.name}.{name}`' for name in leading)}"
