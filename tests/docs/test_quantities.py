"""The documentation of functions for geometry, control and devices says the unit, shape and frame of each quantity.

Each argument that is a quantity is named there; where there are more than two, each has a line of its own.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Literal, NamedTuple, TypeAlias

import pytest

RUNTIME = Path(__file__).parents[2] / "runtime/skillc_runtime"
PACKAGES = ("collision", "control", "devices", "kinematics", "motion", "world/space")
MOST_IN_PROSE = 2
"""So many quantities may be described in sentences."""

Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef

DIMENSIONLESS = (  # and whatever is given in the units of something else
    r"\b(?:unit (?:vectors?|quaternions?|directions?|normals?|axis|axes)|share|ratio|factor|(?:no|any) unit|unitless)\b"
    r"|\brotations? \(3, 3\)|\baxes \(3, [3n]\)|\bdirections? \(3,\)"
)
UNIT = re.compile(
    rf"(?<![\w`.])(?:m|rad|s|N|kg|V|Hz|deg|seconds|Seconds|metres)(?![\w`(.]\w|[\w`(])|\b1/(?:s|kg)\b|{DIMENSIONLESS}"
)
"""An SI unit as a word of its own, or a word for a quantity that has none."""

SIZE = r"(?:n|m|k|nv|joints|\d+)(?: ?[*+] ?\d+)?"
SHAPE = re.compile(rf"\({SIZE},\)|\({SIZE}(?:, {SIZE})+\)")
SPATIAL = re.compile(r"\((?:n, )?[346],?\)|\((?:3|4|6|8), ?(?:n|nv|3|6)\)")
"""Shapes of points, directions, rotations, twists, wrenches and Jacobians."""

FRAME = re.compile(r"\b(?:[Ff]rames?|[Ww]orld|base|parent|joints?|along C|of C|axes of|same axes)\b")
NAMED_UNIT = re.compile(r"_(?:m|s|n|nm|rad|hz|kg|mps|deg|m_s|m_s2|m_s3|rad_s|n_m|per_s|share|ratio)$")
NAMED_FRAME = re.compile(r"(?:^|_)in_(?:world|base|tool|parent|surface|frame|tool_centre|fixed)$")
NUMBER = re.compile(r"float(?: \| None)?|tuple\[float(?:, float)*\]|Iterator\[float\]|Sequence\[float\]")
ARRAY = re.compile(r"\b(?:Array|Vector|Matrix|OutVector|OutMatrix|NDArray)\b")


Kind: TypeAlias = Literal["array", "number", "pose"]
IN_A_LINE: dict[Kind, tuple[re.Pattern[str], ...]] = {"array": (SHAPE, UNIT), "number": (UNIT,), "pose": (FRAME,)}
"""What the line of an argument says."""


class Documented(NamedTuple):
    """A public function and what its documentation says: for a method, that of its class as well."""

    name: str
    function: Function
    text: str


def public_functions(tree: ast.Module) -> Iterator[Documented]:
    """Yield the public functions of a module, and the methods of its public classes."""
    for node in tree.body:
        if isinstance(node, Function) and not node.name.startswith("_"):
            yield Documented(node.name, node, ast.get_docstring(node) or "")
        elif isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            about = ast.get_docstring(node) or ""
            for method in node.body:
                if isinstance(method, Function) and (not method.name.startswith("_") or method.name == "__init__"):
                    name = f"{node.name}.{method.name}"
                    yield Documented(name, method, f"{about}\n{ast.get_docstring(method) or ''}")


def kind_of(annotation: str) -> Kind | None:
    """Return which kind of quantity a type is, None for another type."""
    if ARRAY.search(annotation):
        return "array"
    if NUMBER.fullmatch(annotation):
        return "number"
    return "pose" if re.search(r"\bPose\b", annotation) else None


def undescribed(function: Function, text: str) -> list[str]:
    """Return the arguments that are not named, or that have no line of their own with what it should say."""
    arguments = [*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs]
    kinds = {each.arg: kind_of(ast.unparse(each.annotation)) for each in arguments if each.annotation}
    quantities = {name: kind for name, kind in kinds.items() if kind is not None}
    unsaid = {
        name: kind for name, kind in quantities.items() if not (NAMED_UNIT.search(name) or NAMED_FRAME.search(name))
    }
    if len(quantities) <= MOST_IN_PROSE:
        return [name for name in unsaid if not re.search(rf"\b{name}\b", text)]
    lines = {name: re.search(rf"^{name}: (.*)$", text, re.MULTILINE) for name in unsaid}
    said = {
        name: line and all(pattern.search(line[1]) for pattern in IN_A_LINE[unsaid[name]])
        for name, line in lines.items()
    }
    return [name for name, is_said in said.items() if not is_said]


def missing(function: Function, text: str) -> list[str]:
    """Return which of shape, unit and frame the documentation of a function does not say."""
    arguments = [*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs]
    typed = [(each.arg, ast.unparse(each.annotation)) for each in arguments if each.annotation]
    typed.append((function.name, ast.unparse(function.returns) if function.returns else ""))
    arrays = any(ARRAY.search(kind) for _, kind in typed)
    numbers = any(NUMBER.fullmatch(kind) and not NAMED_UNIT.search(name) for name, kind in typed)
    poses = any(re.search(r"\bPose\b", kind) and not NAMED_FRAME.search(name) for name, kind in typed)
    needed = {
        "shape": (arrays, SHAPE),
        "unit": (arrays or numbers, UNIT),
        "frame": (poses or (arrays and SPATIAL.search(text)), FRAME),
    }
    lacking = [what for what, (applies, pattern) in needed.items() if applies and not pattern.search(text)]
    return [*lacking, *(f"`{name}`" for name in undescribed(function, text))]


@pytest.mark.parametrize("package", PACKAGES)
def test_quantities_have_units_shapes_and_frames(package: str) -> None:
    looked, wrong = 0, []
    for path in sorted((RUNTIME / package).rglob("*.py")):
        for name, function, text in public_functions(ast.parse(path.read_text("utf-8"))):
            looked += 1
            if lacking := missing(function, text):
                wrong.append(f"{path.relative_to(RUNTIME)}:{function.lineno} {name}: {', '.join(lacking)}")
    assert looked > 3
    assert not wrong, "the docstring does not say:\n" + "\n".join(wrong)


CASES = {
    "def f(q: Array) -> None: 'Move to joints q (nv,) in rad.'": [],
    "def f(q: Array) -> None: 'Move to joints q in rad.'": ["shape"],
    "def f(q: Array) -> None: 'Move to joints q (nv,).'": ["unit"],
    "def f(point: Array) -> None: 'Move to a point (3,) in m of the world.'": [],
    "def f(point: Array) -> None: 'Move to a point (3,) in m.'": ["frame"],
    "def f(goal: Pose) -> None: 'Move to the goal.'": ["frame"],
    "def f(goal: Pose) -> None: 'Move there, in the world.'": ["`goal`"],
    "def f(q: Array, dq: Array, period: float) -> None: 'Move q, dq (nv,) in rad, rad/s, for a period in s.'": [
        "`q`",
        "`dq`",
        "`period`",
    ],
    "def f(q: Array, dq: Array, h: float) -> None: 'Move.\\nq: (nv,) in rad.\\ndq: (nv,) in rad/s.\\nh: s.'": [],
    "def f(q: Array, dq: Array, h: float) -> None: 'Move.\\nq: (nv,) in rad.\\ndq: in rad/s.\\nh: s.'": ["`dq`"],
    "def f(goal_in_base: Pose) -> None: 'Move there.'": [],
    "def f(speed: float) -> None: 'Move at this speed.'": ["unit"],
    "def f(speed: float) -> None: 'Move with a speed in m/s.'": [],
    "def f(speed_m_s: float) -> None: 'Move so fast.'": [],
    "def speed() -> float: 'Return the speed.'": ["unit"],
    "def f(name: str) -> None: 'Move an arm.'": [],
}


@pytest.mark.parametrize("source", CASES)
def test_what_documentation_lacks_is_found(source: str) -> None:
    (found,) = public_functions(ast.parse(source))
    assert missing(found.function, found.text) == CASES[source]
