"""The JSON Schemas that ship are those of the code, what skillc writes fits them, and names in it mean one thing."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from jsonschema import Draft202012Validator

from skillc.cli.commands.schema import NAMES
from skillc.cli.main import skillc
from skillc.services.library.schemas import SCHEMAS, format_schema, make_schema, read_schema

IRI = re.compile(r"https?://\S+#\S+")
PREFIXED = re.compile(r"(lab|skiros|skillc|wiping|std):[\w-]+")
TEXTS = ("label", "message", "failure", "reason", "quality", "plan_quality", "variation", "detail", "why", "text")
"""Fields for people."""


def closed(schema: Any) -> Any:
    """Return a schema that allows no fields but those that it lists."""
    if isinstance(schema, list):
        return [closed(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    inner = {key: closed(value) for key, value in schema.items()}
    return {**inner, "additionalProperties": False} if "properties" in schema and "title" in schema else inner


def check(name: str, document: object) -> None:
    validator = Draft202012Validator(closed(make_schema(name)))
    problems = [f"{each.json_path}: {each.message[:300]}" for each in validator.iter_errors(document)]
    assert problems == []


def strings(node: Any, field: str = "") -> Iterator[tuple[str, str]]:
    """Yield every text of a document with the name of its field."""
    if isinstance(node, dict):
        for key, value in node.items():
            yield from strings(value, key)
    elif isinstance(node, list):
        for each in node:
            yield from strings(each, field)
    elif isinstance(node, str):
        yield field, node


@pytest.mark.parametrize("name", SCHEMAS)
def test_the_schemas_that_ship_are_those_of_the_code(name: str) -> None:
    schema = make_schema(name)
    assert read_schema(name) == format_schema(schema), (
        "make accept; a field that changed its meaning needs a new version"
    )
    Draft202012Validator.check_schema(schema)
    assert schema["$id"].endswith(f"/{name}-{schema['version']}.json") and schema["title"] and schema["description"]
    assert CliRunner().invoke(skillc, ["schema", name]).stdout == read_schema(name)
    assert tuple(SCHEMAS) == NAMES


@pytest.mark.slow
def test_a_compiled_library_fits_and_a_changed_one_does_not(tmp_path: Path) -> None:
    result = CliRunner().invoke(skillc, ["compile", "skills_src/skillc_skills/contact", "-o", str(tmp_path)])
    assert result.exit_code == 0, result.output
    library = json.loads((tmp_path / "library.json").read_text())
    check("library", library)
    assert not any(
        re.fullmatch(r"(lab|skiros|contact|skillc):[\w-]+", text) for field, text in strings(library) if field == "iri"
    )
    for changed in ({**library, "format": "4"}, {key: value for key, value in library.items() if key != "vocabulary"}):
        with pytest.raises(AssertionError):
            check("library", changed)
    with pytest.raises(AssertionError):
        check("library", {**library, "colour": "red"})


def test_diagnostics_fit(tmp_path: Path) -> None:
    (tmp_path / "own.skill").write_text("use skiros\n\nskill Wave {\n    in arm: Arms\n}\n")
    result = CliRunner().invoke(skillc, ["check", str(tmp_path), "--json"])
    document = json.loads(result.stdout)
    check("diagnostics", document)
    assert document and result.exit_code == 1


def test_a_manifest_fits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert CliRunner().invoke(skillc, ["new", "cell", "--template", "press"]).exit_code == 0
    manifest = tomllib.loads(Path("cell/skillc.toml").read_text())
    check("project", manifest)
    with pytest.raises(AssertionError):
        check("project", {**manifest, "nmae": "cell"})


@pytest.mark.sim
def test_a_run_fits_and_its_names_mean_one_thing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    task = ["run", "contact:press_button", "--no-film", "--out", "out", "--signals", "csv", "--json"]
    run = CliRunner().invoke(skillc, task)
    assert run.exit_code == 0, run.output
    events = [json.loads(line) for line in Path("out/events.jsonl").read_text().splitlines()]
    for event in events:
        check("events", event)
    result = json.loads(Path("out/result.json").read_text())
    check("result", result)
    assert json.loads(run.stdout) == result
    check("signals", json.loads(Path("out/signals.json").read_text()))
    for document in (events, result, json.loads(Path("out/signals.json").read_text())):
        assert [
            (field, text) for field, text in strings(document) if PREFIXED.fullmatch(text) and field not in TEXTS
        ] == []
    individuals = {text for field, text in strings(events) if field == "iri" and IRI.fullmatch(text)}
    assert {text for field, text in strings(result) if field == "iri"} <= individuals
    assert {field for field, text in strings(result) if IRI.fullmatch(text)} == {"iri"}


@pytest.mark.slow
@pytest.mark.parametrize(
    "command",
    [
        ("tasks",),
        ("plan", "clean_table"),
        ("plan", "share_eraser", "--minimise", "makespan"),
        ("world", "iiwa_table"),
        ("world", "iiwa_table", "--all"),
        ("scene", "show", "iiwa_table.ttl"),
        ("doctor",),
    ],
    ids=" ".join,
)
def test_what_a_command_prints_as_json_has_the_names_that_people_type(
    command: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    printed = CliRunner().invoke(skillc, [*command, "--json"])
    assert printed.exit_code == 0, printed.output
    found = list(strings(json.loads(printed.stdout)))
    assert found and [(field, text) for field, text in found if IRI.search(text)] == []
