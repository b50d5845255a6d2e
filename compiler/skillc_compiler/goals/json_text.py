"""Writes goals in JSON, the conditions of a compiled library, in the syntax of the language."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from typing import Any

import msgspec

from skillc_model.conditions import Condition
from skillc_model.format_condition import format_condition
from skillc_model.format_type import in_written_unit
from skillc_rdf.vocabulary.types import NumberType, Vocabulary

NAMES = frozenset(("iri", "relation", "property", "cls"))
"""The fields with the name of a term or an individual, an IRI or `prefix:name`."""


class JsonGoalError(Exception):
    """The text is not a goal in JSON; the message says why."""


def is_json(text: str) -> bool:
    """Whether a goal is written in JSON: in no other syntax it begins with a brace."""
    return text.lstrip().startswith("{")


def write_goal(text: str, vocabulary: Vocabulary, prefixes: Mapping[str, str]) -> str:
    """Return a goal in JSON in the syntax of the language, numbers with their SI units.

    JsonGoalError if it is none, RecursionError if it is nested too deeply.
    """
    known = msgspec.structs.replace(vocabulary, prefixes={**vocabulary.prefixes, **prefixes})
    try:
        written = _Writer(known).rewrite(msgspec.json.decode(text))
        return format_condition(msgspec.convert(written, Condition), known)
    except (msgspec.DecodeError, msgspec.ValidationError) as error:
        raise JsonGoalError(str(error)) from error


class _Writer:
    """Prepares conditions as plain data for `format_condition`: names are short, quantities have units."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary

    def rewrite(self, value: Any) -> Any:
        match value:
            case {"type": "compare", "left": left, "right": right}:
                sides = {"left": self._in_units(left, right), "right": self._in_units(right, left)}
                return {key: self.rewrite(sides.get(key, each)) for key, each in value.items()}
            case dict():
                return {key: self._shorten(each) if key in NAMES else self.rewrite(each) for key, each in value.items()}
            case list():
                return [self.rewrite(each) for each in value]
            case _:
                return value

    def _in_units(self, side: Any, other: Any) -> Any:
        """Return a side of a comparison; a number that is compared with a quantity as text with the SI unit."""
        match side, other:
            case ({"type": "literal", "value": int() | float() as number}, {"type": "property", "property": str(name)}):
                term = self._vocabulary.properties.get(self._expand(name))
                if term is not None and isinstance(term.type, NumberType):
                    return {"type": "variable", "name": _format_exactly(number, term.type)}
        return side

    def _shorten(self, name: Any) -> Any:
        return self._vocabulary.short(name) if isinstance(name, str) else name

    def _expand(self, name: str) -> str:
        prefix, _, _ = name.partition(":")
        return self._vocabulary.expand(name) if prefix in self._vocabulary.prefixes else name


def _format_exactly(number: float, type_: NumberType) -> str:
    """Return a number in SI units with its unit, with all its digits and without an exponent."""
    value, unit = in_written_unit(number, type_.dimension)
    return f"{Decimal(repr(value)):f} {unit}".strip()
