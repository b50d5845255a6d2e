"""The lines that a remedy adds to a skill, and the edit that adds them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msgspec import structs

from skillc_compiler.analysis.findings import Remedy, Taken
from skillc_compiler.analysis.knowledge.alias_types import ANY_PREFIX, is_any_individual
from skillc_compiler.analysis.knowledge.possible import FactWrite, with_term
from skillc_compiler.analysis.knowledge.writes import RelationWrite
from skillc_compiler.logic.sums import Sum, sum_of
from skillc_compiler.program.typed import Skill
from skillc_dsl.diagnostics import Fix
from skillc_dsl.units import in_units_of
from skillc_model.conditions import (
    Adjust,
    Anything,
    Arithmetic,
    Compare,
    Condition,
    ForEach,
    HasProperty,
    Holds,
    Not,
    PropertyOf,
    Variable,
)
from skillc_model.format_condition import format_condition, format_each, format_expression, format_quantified
from skillc_model.format_type import format_type, in_written_unit
from skillc_model.rewriting import ALWAYS
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import NumberType, Vocabulary

EACH = "each"
"""The variable of what may have been done to any individual."""


def remedy_lines(remedy: Remedy, vocabulary: Vocabulary, written: Iterable[str]) -> tuple[str, ...]:
    """Return the lines of a remedy in the syntax of the language, in the units of the texts that it is for."""
    lines = (
        *(f"infer {name}: {vocabulary.short(cls)}" for name, cls in remedy.parameters),
        *(f"out {name}: {format_type(type_, vocabulary)}" for name, type_ in remedy.outputs),
        *(f"pre {format_condition(each, vocabulary)}" for each in remedy.required),
        *(f"post {_format_effect(each, vocabulary)}" for each in remedy.after),
        *((f"post {_format_taken(remedy.some, vocabulary)}",) if remedy.some is not None else ()),
        *((f"post possible {_format_possible(remedy.possible, vocabulary)}",) if remedy.possible is not None else ()),
    )
    return tuple(in_units_of(each, written) for each in lines)


def _format_effect(effect: Condition | ForEach | Adjust, vocabulary: Vocabulary) -> str:
    match effect:
        case Adjust():
            return format_change(effect, vocabulary)
        case ForEach(variable=variable, cls=cls, when=when, effect=Adjust() as change):
            text = format_change(change, vocabulary)
            limited = text if when == ALWAYS else f"{text} when {format_condition(when, vocabulary)}"
            return format_quantified("forall", variable, vocabulary.short(cls), limited)
        case ForEach():
            return format_each(effect, vocabulary)
    return format_condition(effect, vocabulary)


def _format_taken(some: Taken, vocabulary: Vocabulary) -> str:
    effect, where = (format_condition(each, vocabulary) for each in (some.effect, some.where))
    return format_quantified("some", some.name, vocabulary.short(some.cls), f"{effect} where {where}")


def _format_possible(write: FactWrite, vocabulary: Vocabulary) -> str:
    """Return what may have been written: on any individual by `forall`, on any other one by `_`."""
    ends = (write.subject, write.object) if isinstance(write, RelationWrite) else (write.subject,)
    every = next((each for each in ends if isinstance(each, Variable) and is_any_individual(each)), None)
    if all(map(is_any_individual, ends)) and isinstance(write, RelationWrite):
        write = structs.replace(write, object=Anything())
    own = EACH if write.when is None or EACH not in free_variables(write.when) else f"{EACH}_one"
    named = write if every is None else with_term(write, every.name, Variable(own))
    if isinstance(named, RelationWrite):
        subject, object_ = (Anything() if is_any_individual(each) else each for each in (named.subject, named.object))
        said: Condition = Holds(subject, named.relation, object_)
        said = Not(said) if named.value is False else said
    else:
        subject = named.subject
        assert not isinstance(subject, Anything), "a property is that of something"
        said = HasProperty(subject, named.property)
        said = said if named.value is None else Compare(PropertyOf(subject, named.property), "==", named.value)
    text = format_condition(said, vocabulary)
    if every is None:
        return text
    limited = text if named.when is None else f"{text} when {format_condition(named.when, vocabulary)}"
    return format_quantified("forall", own, vocabulary.short(every.name[len(ANY_PREFIX) :]), limited)


def format_change(effect: Adjust, vocabulary: Vocabulary) -> str:
    """Return a change of a number as a postcondition states it."""
    number = PropertyOf(effect.subject, effect.property)
    ends = [None if each is None else sum_of(each) for each in (effect.low, effect.high)]
    is_set = not any(each is not None and number in dict(each.terms) for each in ends)
    low, high = (each if each is None or is_set else each.plus(sum_of(number), -1.0) for each in ends)
    least = high if low is None else low
    is_less = (
        not is_set and least is not None and _is_below_zero(least) and (high in (None, Sum()) or _is_below_zero(high))
    )
    if is_less:
        low, high = (None if each is None else Sum().plus(each, -1.0) for each in (high, low))
    term = vocabulary.properties.get(effect.property)
    dimension = term.type.dimension if term is not None and isinstance(term.type, NumberType) else ""
    dimension = f"{dimension}Difference" if dimension == "Temperature" and not is_set else dimension
    said = [_format_sum(each, dimension, vocabulary) for each in (low, high)]
    amount = said[0] if low == high else " .. ".join(said)
    operator = ":=" if is_set else "-=" if is_less else "+="
    return f"{format_expression(number, vocabulary)} {operator} {amount}"


def _is_below_zero(sum_: Sum | None) -> bool:
    if sum_ is None or sum_ == Sum():
        return False
    return sum_.number < 0 or (sum_.number == 0 and all(factor < 0 for _, factor in sum_.terms))


def _format_sum(sum_: Sum | None, dimension: str, vocabulary: Vocabulary) -> str:
    if sum_ is None:
        return "_"
    number, unit = in_written_unit(sum_.number, dimension)
    texts = [f"{number:.12g} {unit}".strip()] if sum_.number or not sum_.terms else []
    for value, factor in sum_.terms:
        text = format_expression(value, vocabulary)
        text = f"({text})" if isinstance(value, Arithmetic) else text
        size = text if abs(factor) == 1 else f"{abs(factor):.12g} * {text}"
        texts.append(f"{'-' if factor < 0 else '+'} {size}" if texts else f"{'-' if factor < 0 else ''}{size}")
    return " ".join(texts)


def quote_all(texts: Iterable[str]) -> str:
    """Return texts as a message names them: each once, as in `` `a` and `b` ``."""
    return " and ".join(f"`{each}`" for each in dict.fromkeys(texts))


def add_lines(lines: Sequence[str], skill: Skill) -> Fix:
    """Return the edit that adds lines at the end of a skill."""
    end = skill.span.after
    place = end._replace(column=end.column - 1, end_column=end.column - 1)
    is_one_line = skill.span.line == skill.span.end_line
    text = f"{' '.join(lines)} " if is_one_line else "".join(f"    {line}\n" for line in lines)
    what = quote_all(lines) if len(lines) == 1 else f"these {len(lines)} lines to `{skill.name}`"
    return Fix(place, text, f"add {what}", safe=False)
