"""The page on the architecture names packages, paths and functions that exist."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/architecture.md").read_text("utf-8")
CONTRACTS = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]["contracts"]
FOLDERS = ("dsl", "ontology", "compiler", "runtime", "app")
SOURCES = {path.name: path for folder in FOLDERS for path in (ROOT / folder).iterdir()}
STOPS = re.findall(r"`(skillc\w*(?:\.\w+)+):([\w.]+)`", PAGE)


def source_of(module: str) -> Path:
    package, *parts = module.split(".")
    path = SOURCES[package].joinpath(*parts)
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


@pytest.mark.parametrize(("module", "name"), STOPS, ids=[":".join(stop) for stop in STOPS])
def test_stops_exist(module: str, name: str) -> None:
    body = ast.parse(source_of(module).read_text("utf-8")).body
    for part in name.split("."):
        found = [each for each in body if isinstance(each, ast.FunctionDef | ast.ClassDef) and each.name == part]
        assert found, f"{module} defines no {name}"
        body = found[0].body


def test_there_are_three_walks_of_ten_stops() -> None:
    walks = PAGE.partition("## Three walks")[2].partition("\n## ")[0]
    assert len(re.findall(r"^\d+\. `", walks, re.M)) == 30


def layers(container: str | None) -> list[str]:
    """Return the layers of a contract of import-linter, the lowest first."""
    for contract in CONTRACTS:
        if contract["type"] == "layers" and contract.get("containers") == (container and [container]):
            return [name.strip() for layer in reversed(contract["layers"]) for name in layer.split("|")]
    raise AssertionError(f"no layers of {container}")


def test_every_package_is_listed_above_those_that_import_it() -> None:
    packages = re.findall(r"^\| `\w+/` \| `(\w+)` \|", PAGE, re.M)
    assert sorted(packages) == sorted(layers(None))
    assert packages.index("skillc_model") < packages.index("skillc_compiler") < packages.index("skillc")
    parts = re.findall(r"^\| `(\w+)` \| ", PAGE.partition("part of `skillc_runtime`")[2].partition("\n\n")[0], re.M)
    assert parts == layers("skillc_runtime")


@pytest.mark.parametrize("path", sorted(set(re.findall(r"`((?:compiler|runtime|tests|ontology)/[\w./]+)`", PAGE))))
def test_paths_exist(path: str) -> None:
    assert (ROOT / path).exists()
