"""Objectives and constraints: arithmetic over figures, and comparisons of such."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, cast

from skillc.errors import RequestError
from skillc.services.learning.figures import Figures, all_figures

TOLERANCE = 1e-9
"""The relative difference up to which two numbers are equal."""

_OPERATORS: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
_FUNCTIONS: Mapping[str, Callable[..., float]] = {"abs": abs, "max": max, "min": min}
_NUMBER = r"(?<![\w.])(?>(\d+(?:\.\d*)?(?:[eE][+-]?\d+)?|\.\d+))"
_COMPARISON = re.compile(r"(<=|>=|==|<|>)")
_FORM = "write numbers, names of figures, + - * /, parentheses, abs, min and max"

Names = Callable[[str], str]
"""Returns the figure that a name stands for."""


@dataclass(frozen=True, slots=True)
class Measure:
    """An expression over figures, as it is written, and the figures that it reads."""

    text: str
    figures: tuple[str, ...]
    _tree: ast.expr

    def compute(self, figures: Mapping[str, float]) -> float | None:
        """Return the value; None if a figure was not measured, or for a division by 0."""
        if any(name not in figures for name in self.figures):
            return None
        try:
            return _compute(self._tree, figures)
        except ZeroDivisionError:
            return None


@dataclass(frozen=True, slots=True)
class Constraint:
    """A comparison that every trial has to meet: two measures, and the operator between them."""

    text: str
    left: Measure
    operator: str
    right: Measure

    @property
    def figures(self) -> tuple[str, ...]:
        """The figures that are read."""
        return tuple(dict.fromkeys((*self.left.figures, *self.right.figures)))

    def violation(self, figures: Mapping[str, float]) -> float | None:
        """Return by how much it is missed, as a share of the right side, 0 if it is met; None if not measured.

        Where the right side is 0, the share is of 1.
        """
        left, right = self.left.compute(figures), self.right.compute(figures)
        if left is None or right is None:
            return None
        scale = abs(right) or 1.0
        over = (left - right) / scale
        match self.operator:
            case "==":
                missed = abs(over)
            case ">=" | ">":
                missed = -over
            case _:
                missed = over
        if self.operator in ("<", ">"):
            return max(missed, TOLERANCE) if missed >= 0.0 else 0.0
        return missed if missed > TOLERANCE else 0.0


def check_expressions(minimise: str, subject_to: str) -> None:
    """Raise RequestError for what no task can measure; which figures one measures is known after a run."""
    if minimise.strip(" ,"):
        _Reader(all_figures(), all_figures().require).read(minimise, subject_to)


def read_expressions(
    minimise: str, subject_to: str, figures: Figures
) -> tuple[tuple[Measure, ...], tuple[Constraint, ...]]:
    """Read objectives, expressions between commas, and constraints, comparisons between commas.

    RequestError for what is none, or is not of these figures.
    """
    return _Reader(figures, figures.find).read(minimise, subject_to)


def split(text: str) -> Iterator[str]:
    """Yield the parts of a text between the commas that are not in parentheses; empty ones are left out."""
    depth, part = 0, ""
    for character in f"{text},":
        depth += (character == "(") - (character == ")")
        if character == "," and depth <= 0:
            if part.strip():
                yield part.strip()
            part = ""
        else:
            part += character
    if part.strip(" ,"):
        raise RequestError(f"`{part.rstrip(',').strip()}` has an opening parenthesis without a closing one")


@dataclass(frozen=True, slots=True)
class _Reader:
    figures: Figures
    find: Names

    def read(self, minimise: str, subject_to: str) -> tuple[tuple[Measure, ...], tuple[Constraint, ...]]:
        objectives = tuple(self._require_figures(self.measure(part, part)) for part in split(minimise))
        if not objectives:
            raise RequestError(f"nothing is to be minimised; the figures are {self.figures.listed}")
        return objectives, tuple(map(self.read_constraint, split(subject_to)))

    def read_constraint(self, text: str) -> Constraint:
        parts = _COMPARISON.split(text)
        if len(parts) != 3:
            raise RequestError(f"`{text}` is no constraint: compare two expressions, as in `impact <= 2`")
        left, how, right = parts
        constraint = Constraint(text, self.measure(left, text), how, self.measure(right, text))
        if not constraint.figures:
            raise RequestError(f"`{text}` has no figure; the figures are {self.figures.listed}")
        return constraint

    def measure(self, text: str, whole: str) -> Measure:
        """Read an expression that is part of a text; its units are those of the figures in the whole."""
        plain = self._drop_units(text, whole)
        try:
            tree = ast.parse(plain.strip(), mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise RequestError(f"`{text.strip()}` in `{whole}` is no expression over figures: {_FORM}") from None
        named = _rename(tree, whole, self.find)
        names = dict.fromkeys(each.id for each in ast.walk(named) if isinstance(each, ast.Name))
        return Measure(text.strip(), tuple(each for each in names if each not in _FUNCTIONS), named)

    def _require_figures(self, measure: Measure) -> Measure:
        if not measure.figures:
            raise RequestError(f"`{measure.text}` has no figure; the figures are {self.figures.listed}")
        return measure

    def _drop_units(self, text: str, whole: str) -> str:
        """Return a text without the units of its numbers. RequestError for a unit that no figure of the whole has."""
        units = {unit for name in self._names(whole) for unit in self.figures.units[self.find(name)]}
        units |= {unit.split()[0] for unit in units}

        def drop(found: re.Match[str]) -> str:
            if found[2] not in units:
                raise RequestError(
                    f"`{found[0]}` in `{whole}`: its figures are in {', '.join(sorted(units)) or 'no unit'}"
                )
            return found[1]

        return _unit_pattern().sub(drop, text)

    def _names(self, text: str) -> Iterator[str]:
        words = re.findall(r"(?<![\w.])[A-Za-z_]\w*", _unit_pattern().sub(r"\1", text))
        return (word for word in words if word not in _FUNCTIONS)


@cache
def _unit_pattern() -> re.Pattern[str]:
    """Return what finds a number with a unit, known ones of several words first."""
    units = {unit for each in all_figures().units.values() for unit in each if " " in unit}
    known = "|".join(re.escape(unit) for unit in sorted(units, key=len, reverse=True))
    return re.compile(rf"{_NUMBER}\s*({known}|%|[A-Za-z][A-Za-z/]*)")


def _rename(tree: ast.expr, whole: str, figure: Names) -> ast.expr:
    """Return an expression with whole names of figures. RequestError for what is not allowed in it."""
    match tree:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return tree
        case ast.Name(id=name):
            return ast.Name(figure(name))
        case ast.UnaryOp(op=ast.USub() | ast.UAdd() as sign, operand=operand):
            return ast.UnaryOp(sign, _rename(operand, whole, figure))
        case ast.BinOp(left=left, op=how, right=right) if type(how) in _OPERATORS:
            return ast.BinOp(_rename(left, whole, figure), how, _rename(right, whole, figure))
        case ast.Call(func=ast.Name(id=name) as called, args=[_, *_] as args, keywords=[]) if name in _FUNCTIONS:
            if name == "abs" and len(args) != 1:
                raise RequestError(f"`abs` in `{whole}` takes one value")
            if name != "abs" and len(args) < 2:
                raise RequestError(f"`{name}` in `{whole}` takes two values or more")
            return ast.Call(called, [_rename(each, whole, figure) for each in args], [])
        case _:
            raise RequestError(f"`{ast.unparse(tree)}` in `{whole}` cannot be computed: {_FORM}")


def _compute(tree: Any, figures: Mapping[str, float]) -> float:
    match tree:
        case ast.Constant(value=value):
            return float(cast(float, value))
        case ast.Name(id=name):
            return figures[name]
        case ast.UnaryOp(op=sign, operand=operand):
            value = _compute(operand, figures)
            return -value if isinstance(sign, ast.USub) else value
        case ast.BinOp(left=left, op=how, right=right):
            return _OPERATORS[type(how)](_compute(left, figures), _compute(right, figures))
        case ast.Call(func=ast.Name(id=name), args=args):
            return _FUNCTIONS[name](*(_compute(each, figures) for each in args))
    raise AssertionError("reading lets nothing else through")
