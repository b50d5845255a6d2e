"""The page on ontologies is true: each row of its table is read, each of its commands is run."""

from __future__ import annotations

import re
import shlex
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from docs.pages import ROOT, blocks
from skillc.cli.main import skillc
from skillc.services.library import libraries
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import read_documents, sheet_documents
from vocabularies.reading import HEAD, beside

PAGE = ROOT / "docs" / "ontologies.md"
TERMS = """t:A a owl:Class . t:B a owl:Class . t:C a owl:Class .
t:r a owl:ObjectProperty . t:s a owl:ObjectProperty . t:p a owl:DatatypeProperty .
"""
ROW = re.compile(r"^\| (.*?) \| `([^`]* \.)` \| (.*) \|$", re.MULTILINE)
ROWS = {row[1]: (row[2], row[3]) for row in ROW.finditer(PAGE.read_text("utf-8"))}


def test_the_table_is_there() -> None:
    assert len(ROWS) >= 25


@pytest.mark.slow
@pytest.mark.parametrize("construct", ROWS)
def test_each_construct_has_the_effect_that_the_table_says(construct: str) -> None:
    turtle, effect = ROWS[construct]
    before, after = (beside(Source("t.ttl", HEAD + TERMS + text)) for text in ("", f"{turtle}\n"))
    assert before.diagnostics == () and after.ok
    assert bool(after.diagnostics) == ("reported" in effect)
    terms = [
        (each.value.classes, each.value.relations, each.value.properties, each.value.aliases, each.value.rules)
        for each in (before, after)
    ]
    assert (terms[0] != terms[1]) == (effect != "reported")


FOREIGN = re.compile(r"^\| (.*?) \| `(lab:[^`]* \.)` \|$", re.MULTILINE)


@pytest.mark.parametrize("said", [row[2] for row in FOREIGN.finditer(PAGE.read_text("utf-8"))])
def test_each_statement_that_is_not_understood_is_one_warning(said: str) -> None:
    vocabulary = beside(Source("t.ttl", HEAD + TERMS)).value
    text = f"{HEAD}@prefix lab: <http://example.org/lab#> .\nlab:S a t:A .\n{said}\n"
    problems = read_documents([Document("scene.ttl", text), *sheet_documents()], vocabulary).problems
    assert [(each.name, each.severity, each.span.line) for each in problems] == [
        ("not-understood", "warning", text.count("\n"))
    ]


def test_the_table_of_such_statements_is_there() -> None:
    assert len(FOREIGN.findall(PAGE.read_text("utf-8"))) >= 5


def write_files() -> None:
    """Write the files of the page into the current folder."""
    for block in blocks(PAGE):
        if block.words:
            Path(block.words).parent.mkdir(exist_ok=True)
            Path(block.words).write_text(block.text, "utf-8")


def test_the_imports_of_the_page_are_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    write_files()
    with catalogue.folder_scope([Path("kitchen")]):
        vocabulary = libraries.load_vocabulary()
    assert vocabulary.is_a("http://example.org/kitchen#Lunch", "http://example.org/food#Meal")


def test_the_commands_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copy(catalogue.scene_path("iiwa_table"), "cell.ttl")
    write_files()
    ran, printed = 0, ""
    for block in blocks(PAGE):
        if block.language == "text":
            assert block.text == printed
        for line in block.text.splitlines() if block.language == "sh" else ():
            result = CliRunner().invoke(skillc, shlex.split(line, comments=True)[1:])
            assert result.exit_code == 0, result.stderr
            ran, printed = ran + 1, result.stdout
    assert ran >= 9
