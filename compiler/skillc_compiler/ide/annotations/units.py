"""The units of the numbers in a scene, which are written without them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import pyoxigraph as ox

from skillc_compiler.ide.annotations.hints import Hint
from skillc_model.format_type import SI_UNITS
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.vocabulary.types import NumberType, Vocabulary


def find_units(statements: Iterable[Statement], vocabulary: Vocabulary, lines: range) -> Iterator[Hint]:
    """Yield the unit behind each number in some lines, from 1, that is the value of a property with a dimension."""
    for each in statements:
        term = vocabulary.properties.get(vocabulary.aliases.get(each.predicate, each.predicate))
        if term is None or not isinstance(term.type, NumberType) or not isinstance(each.object, ox.Literal):
            continue
        unit, place = SI_UNITS.get(term.type.dimension), each.object_place
        if unit and place.end_line in lines:
            yield Hint(place.end_line, place.end_column, f" {unit}", f"a {term.type.dimension} in {unit}", "type")
