"""The public names: documented, found by the docs, and nothing else is used there; importing them is cheap."""

from __future__ import annotations

import ast
import importlib
import inspect
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import pytest

import skillc
from docs.pages import ROOT, blocks
from waiting import LONG_S

PARTS = ("backends", "collision", "controllers", "devices", "events", "primitives", "space", "vision", "gym", "world")
MODULES = ("skillc", *(f"skillc.{part}" for part in PARTS))
PAGES = tuple(path for path in sorted((ROOT / "docs").rglob("*.md")) if path.name != "architecture.md")
HEAVY = ("mujoco", "numpy", "rich", "pyoxigraph", "msgspec", "lark", "pandas", "asyncio", "skillc.api")


def _members(name: str) -> Iterator[tuple[str, Any]]:
    """Yield the public names of a module, and the public methods and properties that their classes define."""
    module = importlib.import_module(name)
    for each in module.__all__:
        value = getattr(module, each)
        yield f"{name}.{each}", value
        for known in value.__mro__ if inspect.isclass(value) else ():
            if known.__module__.startswith(("skillc.api", "skillc.client", "skillc.values")):
                yield from ((f"{name}.{each}.{part}", found) for part, found in vars(known).items() if part[0] != "_")


def _needs_docstring(value: Any) -> bool:
    return inspect.isclass(value) or inspect.isroutine(value) or isinstance(value, property)


@pytest.mark.parametrize("module", MODULES)
def test_every_public_name_has_a_docstring(module: str) -> None:
    found = [(name, value) for name, value in _members(module) if _needs_docstring(value)]
    assert found
    assert not [name for name, value in found if not inspect.getdoc(value)]


def test_names_are_those_that_checkers_see() -> None:
    tree = ast.parse((ROOT / "app/skillc/__init__.py").read_text("utf-8"))
    imported = {
        alias.asname: node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) for alias in node.names
    }
    assert {name: imported[name] for name in skillc.__all__} == skillc._MODULES
    assert set(skillc.__all__) <= set(dir(skillc))


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'lod_library'"):
        skillc.lod_library  # noqa: B018


def _imports(text: str) -> Iterator[tuple[str, str]]:
    """Yield the module and the name of each import in a Python text."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield from ((node.module, alias.name) for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from ((alias.name, "") for alias in node.names)


def test_docs_import_public_modules_only_and_names_that_exist() -> None:
    own = []
    for page in PAGES:
        for block in blocks(page):
            if block.language in ("python", "py"):
                own += [(page.name, *each) for each in _imports(block.text) if each[0].startswith("skillc")]
    assert len(own) > 20
    private = [each for each in own if each[1] not in MODULES]
    assert not private
    missing = [each for each in own if each[2] and not hasattr(importlib.import_module(each[1]), each[2])]
    assert not missing


def test_importing_skillc_imports_nothing_heavy() -> None:
    program = f"import sys, skillc; print(sorted(set({HEAVY!r}) & set(sys.modules)), dir(skillc) != [])"
    done = subprocess.run((sys.executable, "-c", program), capture_output=True, text=True, timeout=LONG_S, check=True)
    assert done.stdout == "[] True\n"
