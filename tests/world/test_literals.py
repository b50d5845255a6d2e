"""Numbers of scene files: exact where they are integers, and told where they are too large."""

from __future__ import annotations

import pyoxigraph as ox
import pytest

from skillc_rdf.turtle.terms import XSD
from skillc_rdf.vocabulary.types import PlainType, PropertyTerm, VectorType
from skillc_runtime.store.literals import LiteralError, read_literal, text_literal
from skillc_runtime.world.state.consistency.value_types import value_error


def literal(text: str, kind: str) -> ox.Literal:
    return ox.Literal(text, datatype=ox.NamedNode(XSD + kind))


COUNT = PropertyTerm(iri="t:count", domains=(), type=PlainType("Int"))


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("3", "integer", 3),
        ("-0003", "integer", -3),
        ("3.0", "decimal", 3),
        ("3e2", "double", 300),
        ("9007199254740993", "integer", 2**53 + 1),
        (str(2**63 - 1), "integer", 2**63 - 1),
    ],
)
def test_integers_are_exact(text: str, kind: str, value: int) -> None:
    assert read_literal(literal(text, kind), COUNT) == value


@pytest.mark.parametrize("text", ["1e-400", "5.0000000000000000000000000001", "1e-99999999999999999999999"])
def test_a_number_that_is_whole_only_as_a_float_is_none(text: str) -> None:
    with pytest.raises(LiteralError, match=r"not a whole number|too many digits"):
        read_literal(literal(text, "decimal"), COUNT)


@pytest.mark.parametrize(("text", "kind"), [(str(2**63), "integer"), ("-1e300", "double"), ("9" * 5000, "integer")])
def test_an_integer_that_is_too_large_says_so(text: str, kind: str) -> None:
    with pytest.raises(LiteralError, match="this number is too large"):
        read_literal(literal(text, kind), COUNT)


DATES = [
    ("dateTime", "2026-11-29T08:30:00.5+01:00"),
    ("dateTimeStamp", "2024-02-29T24:00:00Z"),
    ("date", "-0044-03-15"),
    ("time", "08:30:00"),
    ("gYear", "2026"),
    ("gMonthDay", "--02-29"),
    ("duration", "-P1Y2M3DT4H5M6.7S"),
    ("dayTimeDuration", "PT5M"),
    ("yearMonthDuration", "P1Y"),
    ("hexBinary", "0fB7"),
    ("token", "any text"),
]
NO_DATES = [
    ("dateTime", "2026-11-29 08:30:00"),
    ("dateTimeStamp", "2026-11-29T08:30:00"),
    ("date", "2026-02-29"),
    ("date", "yesterday"),
    ("time", "24:30:00"),
    ("gMonthDay", "--02-30"),
    ("duration", "P"),
    ("duration", "P1DT"),
    ("dayTimeDuration", "P1Y"),
    ("hexBinary", "0f7"),
]


def dated(kind: str) -> PropertyTerm:
    return PropertyTerm(iri="t:when", domains=(), type=PlainType("Text"), datatype=XSD + kind)


@pytest.mark.parametrize(("kind", "text"), DATES)
def test_a_date_is_read_as_its_text_and_written_with_its_datatype(kind: str, text: str) -> None:
    assert read_literal(literal(text, kind), dated(kind)) == text == read_literal(ox.Literal(text), dated(kind))
    assert text_literal(text, dated(kind)) == literal(text, kind)
    assert value_error(dated(kind), text) is None


@pytest.mark.parametrize(("kind", "text"), NO_DATES)
def test_what_is_no_date_says_how_one_is_written(kind: str, text: str) -> None:
    with pytest.raises(LiteralError, match=f"is no xsd:{kind}") as told:
        read_literal(literal(text, kind), dated(kind))
    assert f'"^^xsd:{kind}' in told.value.help
    assert "as in" in (value_error(dated(kind), text) or "")


def test_a_date_is_no_value_of_another_property() -> None:
    for term in (dated("time"), PropertyTerm(iri="t:text", domains=(), type=PlainType("Text"))):
        with pytest.raises(LiteralError, match="it takes a text"):
            read_literal(literal("2026-11-29", "date"), term)


def test_a_vector_with_a_number_that_is_too_large_says_so() -> None:
    term = PropertyTerm(iri="t:offset", domains=(), type=VectorType("Length"))
    with pytest.raises(LiteralError, match="a number of this vector is too large"):
        read_literal(ox.Literal("0 1e400 0"), term)
    with pytest.raises(LiteralError, match="is not three numbers"):
        read_literal(ox.Literal("0 inf 0"), term)
