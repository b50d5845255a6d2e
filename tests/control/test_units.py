"""Public functions that take or return arrays say their shapes."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import skillc_runtime

ROOT = Path(skillc_runtime.__file__).parent
PACKAGES = ("control", "devices", "motion")
ARRAYS = re.compile(r"\b(Array|Vector|Matrix|OutVector|OutMatrix)\b")
SHAPE = re.compile(r"\((?:n|m|k|nv|\d+),(?: ?(?:n|m|k|nv|\d+))*\)")


def undocumented(path: Path) -> Iterator[str]:
    """Yield the public functions of a module whose docstrings, or those of their classes, give no shape of an array."""
    module = ast.parse(path.read_text("utf-8"))
    classes = [node for node in module.body if isinstance(node, ast.ClassDef)]
    for owner in (module, *classes):
        beside = "" if owner is module else ast.get_docstring(owner) or ""
        for function in owner.body:
            if isinstance(function, ast.FunctionDef) and not function.name.startswith("_"):
                annotations = [each.annotation for each in ast.walk(function.args) if isinstance(each, ast.arg)]
                text = " ".join(ast.unparse(each) for each in (*annotations, function.returns) if each)
                said = (ast.get_docstring(function) or "") + beside
                if ARRAYS.search(text) and not SHAPE.search(said):
                    yield f"{path.name}:{function.lineno} {function.name}"


@pytest.mark.parametrize("package", PACKAGES)
def test_shapes_are_said(package: str) -> None:
    files = sorted((ROOT / package).rglob("*.py"))
    assert len(files) > 5
    assert [each for path in files for each in undocumented(path)] == []
