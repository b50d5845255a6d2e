"""Values of the wrong type, of the wrong dimension, or without a unit."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import chain
from typing import TypeAlias

import msgspec

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.labels import label_values
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Parameter, Refinement, TypedNode
from skillc_compiler.program.types import (
    INT,
    TEXT,
    UNKNOWN,
    Direction,
    ListOf,
    Measure,
    Thing,
    Type,
    Vector,
    describe_type,
    fits,
    type_of,
)
from skillc_dsl import syntax as s
from skillc_dsl.descriptions.rows import SlotKind
from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.source import Span
from skillc_dsl.units import NUMBER, TIME, UNITS, Dimension
from skillc_model.conditions import Individual, Invoke, ListValue, Literal, Variable
from skillc_rdf.vocabulary.types import Vocabulary, local_name

NAMES = ("wrong-type", "wrong-dimension", "missing-unit")
NEEDS = Need.NAMES
READS = Reads.DECLARATION
_QUANTITY = re.compile(r"\s*+(-?\d++(?:\.\d++)?+)\s*+([A-Za-z/0-9]*+)\s*$")


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each value that does not fit the expected type."""
    vocabulary = program.vocabulary
    wrong = [(place,) for place in type_constraints(program) if not fits(vocabulary, place.value.type, place.wanted)]
    for group in _by_cause(_by_cause(wrong, _reading, 2), _stating, 3):
        yield _report(vocabulary, group)


def _by_cause(groups: Iterable[Group], cause: Callable[[TypeConstraint], Span | None], least: int) -> Iterator[Group]:
    """Join groups with one cause, a declaration that gives or expects one type instead of another, if they are many.

    From `least` groups on, the declaration is more likely wrong than all of them.
    """
    joined: dict[object, list[Group]] = defaultdict(list)
    for group in groups:
        value, declared = group[0].value, cause(group[0])
        joined[value.span if declared is None else (declared, value.type, group[0].wanted)].append(group)
    for alike in joined.values():
        yield from [tuple(chain.from_iterable(alike))] if len(alike) >= least else alike


def _reading(place: TypeConstraint) -> Span | None:
    return place.value.declared


def _stating(place: TypeConstraint) -> Span | None:
    return place.cause


def _report(vocabulary: Vocabulary, group: Group) -> Diagnostic:
    place, *others = sorted(group, key=lambda each: each.value.span)
    name, help_ = _problem(vocabulary, place)
    has = "this number has no unit" if name == "missing-unit" else f"this is {describe_type(place.value.type)}"
    stated = (Label(place.cause, "declared here"),) if place.cause else ()
    also = (Label(other.value.span, "also here") for other in others)
    return Diagnostic(
        name,
        place.value.span,
        f"{has}, where {describe_type(place.wanted)} is expected {place.by}",
        help=help_,
        labels=(*stated, *label_values(place.value), *also),
        fix=_fix(place) if name == "missing-unit" and not others else None,
    )


def _fix(place: TypeConstraint) -> Fix | None:
    """Return the edit that writes a number in the SI unit that is expected; another unit may be meant."""
    match place.wanted, place.value.meaning:
        case Measure(dimension=dimension), Literal(value=number):
            text = f"{number} {units_of(dimension)[0]}"
            return Fix(place.value.span, text, f"write `{text}`", safe=False)
    return None


def _problem(vocabulary: Vocabulary, place: TypeConstraint) -> tuple[str, str]:
    """Return the name of the problem and the help."""
    given, wanted, meaning = place.value.type, place.wanted, place.value.meaning
    match wanted, given, meaning:
        case Measure(dimension=dimension), _, Literal(value=number) if given in (INT, Measure(NUMBER)):
            return "missing-unit", f"write it with its unit: `{number} {units_of(dimension)[0]}`"
        case Measure(dimension=dimension), Measure(), _:
            units = () if dimension == NUMBER else units_of(dimension)
            return "wrong-dimension", f"write it in {' or '.join(units) or 'no unit'}"
        case Vector(), Vector() | Direction(), _:
            return "wrong-dimension", "multiply or divide it by a quantity of the missing dimension"
        case Direction(), Vector(), _:
            return "wrong-type", "a Direction is of length 1: use a property or a function that gives one"
        case Measure(dimension=dimension), _, Literal(value=str(text)) if given == TEXT:
            return "wrong-type", _suggest_unquoted(text, dimension)
        case Thing(), Thing(), _ if fits(vocabulary, wanted, given):
            return "wrong-type", f"not all of them are: declare or refine it as {describe_type(wanted)}"
        case _, Thing(), Variable() | Individual():
            return "wrong-type", _suggest_property(vocabulary, place)
    return "wrong-type", ""


def units_of(dimension: Dimension) -> tuple[str, ...]:
    """Return the units of a dimension, the SI unit first."""
    fitting = [(abs(unit.in_si - 1.0) > 0, name) for name, unit in UNITS.items() if unit.dimension == dimension]
    return tuple(name for _, name in sorted(fitting))


def _suggest_unquoted(text: str, dimension: Dimension) -> str:
    found = _QUANTITY.match(text)
    if found is None:
        return f"write a number with its unit, {' or '.join(units_of(dimension))}"
    return f"write it without quotes: `{' '.join(part for part in found.groups() if part)}`"


def _suggest_property(vocabulary: Vocabulary, place: TypeConstraint) -> str:
    """Suggest a property of the individual that has the expected type, such as `grasp.pose`."""
    leading = sorted(
        local_name(term.iri)
        for term in vocabulary.properties.values()
        if type_of(term.type) == place.wanted
        and any(fits(vocabulary, place.value.type, Thing(domain)) for domain in term.domains)
    )
    if not isinstance(place.value.meaning, Variable) or not 0 < len(leading) <= 3:
        return ""
    return f"use a property of it: {' or '.join(f'`{place.value.meaning.name}.{name}`' for name in leading)}"


SECONDS = Measure(TIME)


class TypeConstraint(msgspec.Struct, frozen=True):
    """A value and the type expected of it.

    `by` continues "is expected"; `cause` is the place that states the type.
    """

    value: TypedExpression
    wanted: Type
    by: str
    cause: Span | None = None


Group: TypeAlias = tuple[TypeConstraint, ...]


def type_constraints(program: Program) -> Iterator[TypeConstraint]:
    """Yield every value for which a type is expected."""
    for skill in program.skills.values():
        for parameter in skill.parameters:
            yield from _parameter_constraints(parameter, parameter.name, parameter.span)
    yield from _stated_times(program)
    for implementation in program.implementations:
        for new in implementation.refinements:
            yield from _parameter_constraints(new, new.written.name.text, new.written.name.span)
        for output in implementation.outputs:
            if output.of is not None:
                by = f"by the output `{output.of.name}`"
                yield TypeConstraint(output.value, output.of.type, by, output.of.span)
    for call in program.calls:
        yield from argument_constraints(call)
    for node in program.nodes:
        yield from _node_constraints(node)
    for value in program.values:
        if isinstance(value.meaning, Invoke):
            yield from _function_constraints(program, value, value.meaning)
        if isinstance(value.meaning, ListValue) and isinstance(value.type, ListOf):
            yield from (TypeConstraint(item, value.type.element, "in this list") for item in value.parts)


def _stated_times(program: Program) -> Iterator[TypeConstraint]:
    for implementation in program.implementations:
        yield from _time_constraint(implementation.duration, "by `duration`")
    for skill in program.skills.values():
        yield from _time_constraint(skill.duration, "by `duration`")
        yield from _time_constraint(skill.pause.keep if skill.pause else None, "by `keep`")
        if skill.cost is not None:
            yield TypeConstraint(skill.cost, Measure(NUMBER), "by `cost`")
    for task in program.tasks:
        yield from _time_constraint(task.within, "by `within`")


def _node_constraints(node: TypedNode) -> Iterator[TypeConstraint]:
    match node.written:
        case s.Decorator(row=row):
            for value, slot in zip(node.values, row.slots, strict=True):
                yield TypeConstraint(value, *_SLOTS[slot.kind])
        case s.While():
            yield TypeConstraint(node.values[0], *_SLOTS["count"])
        case s.Wait():
            yield from _time_constraint(node.values[0], "as time")
        case s.For():
            yield TypeConstraint(node.values[0], ListOf(UNKNOWN), "to go through")
        case _:
            pass


def argument_constraints(call: Call) -> Iterator[TypeConstraint]:
    """Yield the arguments of a call that a parameter takes."""
    for argument in call.arguments:
        parameter = call.skill.parameter(argument.name.text) if call.skill else None
        if call.skill and parameter:
            by = f"by the parameter `{parameter.name}` of `{call.skill.name}`"
            yield TypeConstraint(argument.value, parameter.type, by, parameter.span)


def _parameter_constraints(parameter: Parameter | Refinement, name: str, declared: Span) -> Iterator[TypeConstraint]:
    if parameter.default is not None:
        yield TypeConstraint(parameter.default, parameter.type, f"as the default of `{name}`", declared)
    for bound in (parameter.low, parameter.high):
        if bound is not None:
            yield TypeConstraint(bound, parameter.type, f"as a bound of `{name}`", declared)


_SLOTS: Mapping[SlotKind, tuple[Type, str]] = {
    "count": (INT, "as the number of rounds"),
    "time": (SECONDS, "as time"),
}


def _time_constraint(value: TypedExpression | None, by: str) -> Iterator[TypeConstraint]:
    if value is not None:
        yield TypeConstraint(value, SECONDS, by)


def _function_constraints(program: Program, value: TypedExpression, meaning: Invoke) -> Iterator[TypeConstraint]:
    function = program.vocabulary.functions.get(meaning.function)
    if function is None or len(function.parameters) != len(value.parts):
        return  # which value is for which parameter is not known
    for argument, (name, kind) in zip(value.parts, function.parameters, strict=False):
        yield TypeConstraint(argument, type_of(kind), f"by `{name}` of the function `{function.name}`", value.declared)
