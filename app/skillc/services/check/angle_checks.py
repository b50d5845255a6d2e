"""Checks angles in scenes: degrees where radians are read, and radians where degrees are."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import pyoxigraph as ox

from skillc.services.scene.diagnostics import with_shown_path
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.vocabulary.types import NumberType, Vocabulary
from skillc_runtime.scene.load import LoadedScene
from skillc_runtime.world.state.terms import ANGLES

_DECIMALS = re.compile(r"-?\d*\.(\d{2,})")
"""A number with two decimals or more: a rounded multiple of pi/4 has them, an angle in degrees rarely."""


def check_angles(scene: LoadedScene, path: str) -> Iterator[Diagnostic]:
    """Yield warnings for angles in the scene file at `path` that were probably written in the other unit."""
    vocabulary = scene.state.vocabulary
    for each in scene.said:
        if each.lines.path != path or not isinstance(each.object, ox.Literal):
            continue
        if each.predicate in ANGLES:
            yield from _radians_for_degrees(each, each.object.value, vocabulary)
        elif _is_in_radians(each.predicate, vocabulary):
            yield from _degrees_for_radians(each, each.object.value, vocabulary)


def _is_in_radians(property_: str, vocabulary: Vocabulary) -> bool:
    term = vocabulary.properties.get(property_)
    return term is not None and term.type == NumberType("Angle")


def _degrees_for_radians(stated: Statement, written: str, vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield a warning for more than one turn in rad."""
    angle = float(written)
    if math.isfinite(angle) and abs(angle) > 2 * math.pi:
        message = f"{vocabulary.short(stated.predicate)} is read in rad: this is {abs(angle) / (2 * math.pi):.1f} turns"
        yield _in_the_other_unit(stated, message, f"{written} deg", f"{math.radians(angle):.6g}")


def _radians_for_degrees(stated: Statement, written: str, vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield a warning for degrees that are a multiple of pi/4 up to 2 pi, rounded to the decimals that are written."""
    decimals = _DECIMALS.fullmatch(written)
    angle = float(written)
    eighths = round(4 * angle / math.pi)
    if decimals and 0 < abs(eighths) <= 8 and round(eighths * math.pi / 4, len(decimals[1])) == angle:
        name = vocabulary.short(stated.predicate)
        message = f"{name} is read in degrees, and {written} is a rounded multiple of pi/4"
        yield _in_the_other_unit(stated, message, f"{written} rad", f"{45 * eighths}")


def _in_the_other_unit(stated: Statement, message: str, meant: str, instead: str) -> Diagnostic:
    span = with_shown_path(stated.object_place)
    fix = Fix(span, instead, f"write `{instead}`", safe=False)
    help_ = f"if it was meant as {meant}, write `{instead}`"
    return Diagnostic("angle-in-other-unit", span, message, help_, "warning", fix=fix)
