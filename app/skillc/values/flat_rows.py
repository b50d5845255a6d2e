"""Structs as rows of a frame: numbers and texts only, under the names of their fields."""

from __future__ import annotations

from math import nan
from typing import TypeAlias, get_args

import msgspec

from skillc_runtime.world.state.labels.labelled import LabelledIri

Cell: TypeAlias = bool | int | float | str | None
"""A value in a frame. A missing text is None, a missing number is `nan`."""

AXES = ("x", "y", "z")


def make_flat_row(value: msgspec.Struct) -> dict[str, Cell]:
    """Return the fields of a struct as cells.

    A position such as `true_m` has a column for each axis, `true_x_m`. A nested struct adds its fields to those of the
    outer one. Several texts are joined with semicolons. The tag of the type, if any, is `type`.
    """
    tag = value.__struct_config__.tag
    row: dict[str, Cell] = {} if tag is None else {"type": str(tag)}
    for each in msgspec.structs.fields(value):
        cell = getattr(value, each.name)
        missing = cell is None and float in get_args(each.type)
        row |= _make_cells(each.name, nan if missing else cell, _count_axes(each.type))
    return row


def _count_axes(annotation: object) -> int:
    """Return how many axes the position of a field has; 0 if the field is no position."""
    for each in (annotation, *get_args(annotation)):
        numbers = get_args(each)
        if numbers in ((float,) * 2, (float,) * 3):
            return len(numbers)
    return 0


def _make_cells(name: str, value: object, axes: int) -> dict[str, Cell]:
    match value:
        case _ if axes:
            numbers = value if isinstance(value, tuple) else (nan,) * axes
            what, _, unit = name.rpartition("_")
            return {f"{what}_{axis}_{unit}": number for axis, number in zip(AXES, numbers, strict=False)}
        case None | bool() | int() | float() | str():
            return {name: value}
        case LabelledIri():
            return {name: str(value)}
        case msgspec.Struct():
            return {inner: cell for inner, cell in make_flat_row(value).items() if inner != "type"}
        case tuple():
            return {name: "; ".join(map(str, value))}
        case _:
            return {name: str(value)}
