"""Quantities for people: one unit for all values of a parameter, the one in which they are easy to read."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_dsl.units import to_si
from skillc_model.words import quantity_text
from skillc_rdf.vocabulary.types import NumberType, ValueType

SMALL = 0.1


FINER = {"Length": "mm", "Time": "ms"}
FAMILIAR = {"Angle": "deg", "AngularSpeed": "deg/s"}


def quantity_texts(values: Sequence[float | None], type_: ValueType) -> tuple[str, ...]:
    """Return values in SI units as text with a common unit, "" for None.

    Lengths and times have a finer unit, taken when some value other than zero is below a tenth in SI.
    """
    dimension = type_.dimension if isinstance(type_, NumberType) else ""
    small = any(each is not None and 0 < abs(each) < SMALL for each in values)
    unit = FAMILIAR.get(dimension) or (FINER.get(dimension) if small else None)
    return tuple("" if each is None else _text(each, type_, unit) for each in values)


def _text(value: float, type_: ValueType, unit: str | None) -> str:
    return quantity_text(value, type_) if unit is None else f"{value / to_si(1.0, unit):g} {unit}"
