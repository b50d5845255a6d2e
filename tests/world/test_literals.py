"""Numbers of scene files: exact where they are integers, and told where they are too large."""

from __future__ import annotations

import pyoxigraph as ox
import pytest

from skillc_rdf.turtle.terms import XSD
from skillc_rdf.vocabulary.types import PlainType, PropertyTerm, VectorType
from skillc_runtime.store.literals import LiteralError, read_literal


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


def test_a_vector_with_a_number_that_is_too_large_says_so() -> None:
    term = PropertyTerm(iri="t:offset", domains=(), type=VectorType("Length"))
    with pytest.raises(LiteralError, match="a number of this vector is too large"):
        read_literal(ox.Literal("0 1e400 0"), term)
    with pytest.raises(LiteralError, match="is not three numbers"):
        read_literal(ox.Literal("0 inf 0"), term)
