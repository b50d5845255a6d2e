"""Reads facts in the syntax in which they are shown, `lab:Board-1.isClean == false`, as statements of Turtle."""

from __future__ import annotations

import re
from collections.abc import Iterable
from difflib import get_close_matches

from skillc.errors import RequestError
from skillc_dsl.units import DIMENSIONS, UNITS, dimension_of, to_si
from skillc_model.format_type import SI_UNITS, format_quantity
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import DirectionType, NumberType, PropertyTerm, VectorType, Vocabulary, local_name

FORMS = "`lab:Board-1.isClean == true` or `lab:Tray-1 contain lab:Part-1`, with `not` before it for what does not hold"
_VALUE = re.compile(r"(?P<subject>\S+)\.(?P<term>[\w:-]+)\s*(?P<sign>==?)\s*(?P<value>.+)", re.DOTALL)
_LINK = re.compile(r"(?P<subject>\S+)\s+(?P<term>[A-Za-z][\w-]*)\s+(?P<object>[^\s\"']+)")
_NUMBER = r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?"
_QUANTITY = re.compile(rf"({_NUMBER})\s*(\S*)")
_VECTOR = re.compile(rf"\(\s*({_NUMBER})\s*,\s*({_NUMBER})\s*,\s*({_NUMBER})\s*\)\s*(\S*)")


def write_statement(text: str, vocabulary: Vocabulary) -> str:
    """Return a fact as a statement of Turtle, numbers in SI units; a text of another form is returned as it is.

    RequestError for a term that the vocabulary does not have, and a unit that does not fit.
    """
    if found := _VALUE.fullmatch(text):
        if found["sign"] == "=":
            raise RequestError("a fact about a value has `==`")
        term = _find_term(found["term"], "property", vocabulary.properties, vocabulary)
        return f"{found['subject']} <{term}> {_write_value(found['value'].strip(), vocabulary.properties[term])}"
    found = _LINK.fullmatch(text)
    if found is None or found["term"] == "a":
        return text
    if found["term"] == "is":
        cls = _find_term(found["object"], "class", vocabulary.classes, vocabulary)
        return f"{found['subject']} <{RDF_TYPE}> <{cls}>"
    relation = _find_term(found["term"], "relation", vocabulary.relations, vocabulary)
    return f"{found['subject']} <{relation}> {found['object']}"


def _find_term(name: str, kind: str, terms: Iterable[str], vocabulary: Vocabulary) -> str:
    """Return the IRI of a term; the prefix of its name may be left out if no other term of its kind has it."""
    by_name = dict[str, list[str]]()
    for iri in sorted(terms):
        for written in (local_name(iri), vocabulary.short(iri)):
            by_name.setdefault(written, []).append(iri)
    prefix, colon, local = name.partition(":")
    iri = vocabulary.prefixes[prefix] + local if colon and prefix in vocabulary.prefixes else ""
    found = by_name.get(vocabulary.short(vocabulary.aliases.get(iri, iri)) if iri else name, [])
    if len(found) == 1:
        return found[0]
    alike = [each for each in by_name if (":" in each) == bool(colon)]
    near = [vocabulary.short(each) for each in found] or get_close_matches(name, alike, n=3)
    cure = f"; did you mean {' or '.join(near)}?" if near else ""
    raise RequestError(f"there is {'more than one' if found else 'no'} {kind} {name}{cure}")


def _write_value(text: str, term: PropertyTerm) -> str:
    """Return a value as Turtle writes it; RequestError if it is not one of the property."""
    match term.type:
        case NumberType(dimension):
            found, example = _QUANTITY.fullmatch(text), format_quantity(0.1, term.type)
        case VectorType(dimension):
            found, example = _VECTOR.fullmatch(text), f"(0, 0, 1) {SI_UNITS.get(dimension, '')}".strip()
        case DirectionType():
            dimension, found, example = "Number", _VECTOR.fullmatch(text), "(0, 0, 1)"
        case _:
            return text
    if found is None:
        raise RequestError(f"{local_name(term.iri)} is written like `{example}`, and this is `{text}`")
    *numbers, unit = found.groups()
    values = [repr(_in_si(float(each), unit, dimension, term)) for each in numbers]
    return values[0] if isinstance(term.type, NumberType) else f'"{" ".join(values)}"'


def _in_si(number: float, unit: str, dimension: str, term: PropertyTerm) -> float:
    """Return a number in SI units; RequestError if its unit is not one of the dimension."""
    if not unit:
        return number
    if unit in UNITS and dimension_of(unit) == DIMENSIONS[dimension]:
        return to_si(number, unit)
    fitting = [each for each in UNITS if dimension_of(each) == DIMENSIONS[dimension]]
    counts = f"is in {', '.join(fitting)}" if fitting else "has no unit"
    raise RequestError(f"{local_name(term.iri)} {counts}, and this is in {unit}")
