"""The page on the architecture names packages, paths and functions that exist."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path

import click
import pytest

from skillc.cli.main import COMMANDS, SECTIONS, skillc
from skillc.services.library.files import find_library
from skillc.services.library.libraries import compile_library
from skillc_compiler import checks, emit
from skillc_compiler.emit.artifacts import make_artifacts
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.types import Vocabulary

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/architecture.md").read_text("utf-8")
CONTRACTS = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]["contracts"]
FOLDERS = ("dsl", "ontology", "compiler", "runtime", "app")
SOURCES = {path.name: path for folder in FOLDERS for path in (ROOT / folder).iterdir()}
CHECK = """
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic

NAMES, NEEDS, READS = ("short-name",), Need.TEXT, Reads.LIBRARY

def check(program):
    return [Diagnostic("short-name", each.span, "this is short") for each in program.skills.values()]
"""
EMITTER = "def emit(library):\n    return {'skills.txt': ', '.join(library.skills)}\n"
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


@pytest.mark.parametrize(
    ("table", "folder"), [("part of `skillc` |", "app/skillc"), ("room of `services`", "app/skillc/services")]
)
def test_every_room_of_the_program_is_listed(table: str, folder: str) -> None:
    listed = re.findall(r"^\| `(\w+)` \| ", PAGE.partition(table)[2].partition("\n\n")[0], re.M)
    assert sorted(listed) == sorted(each.parent.name for each in (ROOT / folder).glob("*/__init__.py"))


@pytest.mark.parametrize("path", sorted(set(re.findall(r"`((?:compiler|runtime|tests|ontology)/[\w./]+)`", PAGE))))
def test_paths_exist(path: str) -> None:
    assert (ROOT / path).exists()


ROWS = re.findall(r"^\| (.*?) \| (.*?) \| (.*?) \|$", PAGE.partition("## Where things are added")[2], re.M)[1:]
BASES = ("", "docs", "runtime/skillc_runtime", "app/skillc", "app/skillc/services", "compiler/skillc_compiler")
"""Where names of files in the table may begin."""
WORD = re.compile(r"[A-Za-z_]\w{3,}")


def named_files(row: tuple[str, ...]) -> dict[str, list[Path]]:
    """Return the files and folders that a row names, by its words; a relative name is below another one of the row."""
    words = [word for cell in row for quoted in re.findall(r"`([^`]+)`", cell) for word in expand(quoted)]
    paths = [
        word for word in words if re.fullmatch(r"[\w./-]+", word) and ("/" in word or word.endswith((".py", ".md")))
    ]
    found: dict[str, list[Path]] = {}
    for word in sorted(paths, key=lambda each: -each.count("/")):
        near = [
            above
            for known in found.values()
            for path in known
            for above in (path, *path.parents)
            if ROOT in above.parents
        ]
        places = [*(ROOT / base for base in BASES), *near]
        found[word] = [place / word for place in places if (place / word).exists()][:1]
    return found


def expand(quoted: str) -> list[str]:
    """Return what is quoted, each alternative of its braces, without parts that stand for any name."""
    quoted = re.sub(r"\bNAME\.md$", "", quoted)
    braces = re.search(r"\{(.*?)\}", quoted)
    return [quoted.replace(braces[0], each) for each in braces[1].split(",")] if braces else [quoted]


@pytest.mark.parametrize("row", ROWS, ids=[row[0][:40] for row in ROWS])
def test_what_a_row_names_exists(row: tuple[str, ...]) -> None:
    files = named_files(row)
    assert [word for word, found in files.items() if word and not found] == []
    sources = [
        path
        for found in files.values()
        for each in found
        for path in ([each] if each.is_file() else each.rglob("*.py"))
    ]
    text = "\n".join(path.read_text("utf-8") for path in sources if path.suffix == ".py")
    names = {quoted for quoted in re.findall(r"`(\w+)`", row[2]) if WORD.fullmatch(quoted)}
    assert {name for name in names if text and not re.search(rf"\b{name}\b", text)} == set()


def test_a_check_is_found_by_its_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "short_names.py").write_text(CHECK, "utf-8")
    monkeypatch.setattr(checks, "__path__", [*checks.__path__, str(tmp_path)])
    checks.load_checks.cache_clear()
    try:
        sources = [Source("a.skill", "skill Go {\n    noplan\n}\n")]
        assert "short-name" in {each.name for each in compile(sources, Vocabulary(), {}, "a").diagnostics}
    finally:
        checks.load_checks.cache_clear()


def test_an_emitter_is_found_by_its_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "listing_of_skills.py").write_text(EMITTER, "utf-8")
    monkeypatch.setattr(emit, "__path__", [*emit.__path__, str(tmp_path)])
    library = compile_library(find_library(Path("wiping"))).value
    assert "Wipe" in make_artifacts(library)["skills.txt"]


def test_each_command_is_found_by_its_name_and_stands_in_a_section_of_the_help() -> None:
    assert {each.stem for each in COMMANDS.glob("[!_]*.py")} == {name for names in SECTIONS.values() for name in names}
    assert all(skillc.get_command(click.Context(skillc), name) is not None for name in ("check", "fix", "schema"))
