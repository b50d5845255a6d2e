"""Every diagnostic has a page in the manual, whose bad example has that problem alone and whose good one has none."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import get_args
from unittest.mock import patch

import pytest
from msgspec import structs
from shipped import shelf, vocabulary

from skillc.errors import DiagnosticsError
from skillc.services.check.checking import CheckRequest, check_paths
from skillc.services.check.known_checks import check_with
from skillc.services.library.check_inputs import CheckInputs
from skillc.services.library.files import find_library
from skillc.services.pddl_import.importing import import_pddl
from skillc.services.testing.suite import find_suites, run_suite
from skillc_compiler.goals.parsing import parse_goal
from skillc_compiler.manual import Page, load_pages, page_names, parse_page
from skillc_compiler.pipeline import compile
from skillc_compiler.program.unknown import UnknownKind
from skillc_dsl.encoding import decode
from skillc_dsl.formatting.formatter import check_layout
from skillc_dsl.parsing.parser import parse
from skillc_dsl.query import Memo
from skillc_dsl.source import Source
from skillc_ontology.catalogue import vocabulary_files
from skillc_rdf.vocabulary.conflicts import judge_conflicts
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import SceneError
from skillc_runtime.scene.load import read_scene

ROOT = Path(__file__).parent.parent.parent
GIVERS = {"Diagnostic", "report", "AxiomViolation", "SceneViolation", "_problem_name"}
PLACES = ("dsl", "compiler", "runtime/skillc_runtime/world", "runtime/skillc_runtime/scene", "app/skillc")
NAME = re.compile(r"[a-z]+(-[a-z]+)*")
LAB = "http://example.org/lab#"
SCENE = {
    f"{LAB}Iiwa-1": ["https://w3id.org/skillc/core#Iiwa14"],
    f"{LAB}Whiteboard-1": ["https://w3id.org/skillc/wiping#Whiteboard"],
}
SHOP = """
@prefix shop: <http://example.org/shop#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix vann: <http://purl.org/vocab/vann/> .
<http://example.org/shop> a owl:Ontology ;
    vann:preferredNamespacePrefix "shop" ; vann:preferredNamespaceUri "http://example.org/shop#" .
shop:Part a owl:Class .
shop:Item a owl:Class .
shop:Ware a owl:Class ; owl:deprecated true ; <http://purl.org/dc/terms/isReplacedBy> shop:Item .
"""
RULE = """
shop:Shelf a owl:Class .
shop:liesIn a owl:ObjectProperty .
shop:Offered a owl:Class ; owl:equivalentClass
    [ a owl:Restriction ; owl:onProperty shop:liesIn ; owl:someValuesFrom shop:Shelf ] .
"""


def problems(page: Page, text: str) -> list[str]:
    """Return the names of the diagnostics of an example."""
    match page.found_by:
        case "check" if page.name == "unchecked-space":
            with patch("skillc.services.check.task_checks.missing_extras", lambda *extras: extras):
                return in_library(text)
        case "check":
            return beside_scene(text) if page.language == "turtle" else in_library(text)
        case "vocabulary":
            return in_vocabulary(text)
        case "scene" if page.name == "unclassified-individuals":
            with patch("skillc_runtime.scene.classification.find_spec", lambda name: None):
                return in_scene(text)
        case "scene":
            return in_scene(text)
        case "formatter":
            warning = check_layout(Source("example.skill", text))
            return [warning.name] if warning else []
        case "goal":
            boards = {iri: classes for iri, classes in SCENE.items() if "board" in iri}
            return [d.name for d in parse_goal(text.strip(), vocabulary(), boards, {"lab": LAB}).diagnostics]
        case "project":
            return in_project(text)
        case "test":
            return in_tests(text)
        case "pddl":
            return in_domain(text)
        case _:
            return in_skill_file(page.name, text)


def in_skill_file(name: str, text: str) -> list[str]:
    """Return the names of the problems that the compiler finds in a text."""
    if name == "file-too-large":
        return [d.name for d in parse(Source("example.skill", text * 1000)).diagnostics]
    if name == "encoding":
        return [d.name for d in parse(decode("example.skill", text.encode("latin-1"))).diagnostics]
    terms = with_shop() if "shop" in text else vocabulary()
    outcome = compile([Source("example.skill", text)], terms, shelf(), "example", {"rest": SCENE})
    return [d.name for d in outcome.diagnostics]


def in_project(text: str) -> list[str]:
    """Return the names of the problems of a `skillc.toml`, beside a library `grasping` and a lock file."""
    with TemporaryDirectory() as folder:
        Path(folder, "example.skill").write_text("use skiros\nclass Rag < Product\n", "utf-8")
        Path(folder, "skillc.toml").write_text(text, "utf-8")
        Path(folder, "skillc.lock").write_text("", "utf-8")
        Path(folder, "grasping").mkdir()
        Path(folder, "grasping/skillc.toml").write_text('name = "grasping"\n', "utf-8")
        return [d.name for d in check_paths(CheckRequest((Path(folder),))).diagnostics]


def in_domain(text: str) -> list[str]:
    """Return the names of the problems of a domain in PDDL that is imported."""
    with TemporaryDirectory() as folder:
        domain = Path(folder, "domain.pddl")
        domain.write_text(text, "utf-8")
        try:
            return [d.name for d in import_pddl(domain, None, Path(folder, "example")).warnings]
        except DiagnosticsError as error:
            return [d.name for d in error.diagnostics]


def in_tests(text: str) -> list[str]:
    """Return the names of the problems that the tests in a library of one file have."""
    with TemporaryDirectory() as folder:
        Path(folder, "example.skill").write_text(text, "utf-8")
        suites = find_suites([folder])
        return [d.name for suite in suites for each in run_suite(suite, suite.new_coverage()) for d in each.problems]


@cache
def with_shop() -> Vocabulary:
    """Return the shipped terms and those of the shop."""
    shipped = [Source(path, turtle) for path, turtle in vocabulary_files()]
    return load([*shipped, Source("shop.ttl", SHOP)]).value


@cache
def with_rules() -> Vocabulary:
    """Return the shipped terms, those of the shop, and a rule about what skills change."""
    shipped = [Source(path, turtle) for path, turtle in vocabulary_files()]
    return structs.replace(
        load(shipped, [Source("shop.ttl", SHOP + RULE)]).value, changing=("http://example.org/shop#liesIn",)
    )


def in_vocabulary(text: str) -> list[str]:
    """Return the names of the problems of a vocabulary."""
    shipped = [Source(path, turtle) for path, turtle in vocabulary_files()]
    found = load(shipped, [Source("example.ttl", text)])
    return [d.name for d in judge_conflicts(found.diagnostics, found.value, {})]


def in_scene(text: str) -> list[str]:
    """Return the names of the problems of a scene."""
    with TemporaryDirectory() as folder:
        scene = Path(folder, "example.ttl")
        scene.write_text(text, "latin-1" if "saved as Latin-1" in text else "utf-8")
        try:
            return [
                problem.name
                for problem in read_scene(scene, with_rules() if "shop:Item" in text else vocabulary()).problems
            ]
        except SceneError as error:
            return [problem.name for problem in error.problems]


def in_library(text: str) -> list[str]:
    """Return the names of the problems that `skillc check` finds in a library of one file."""
    with TemporaryDirectory() as folder:
        Path(folder, "example.skill").write_text(text, "utf-8")
        Path(folder, "skillc.toml").write_text('name = "example"\nversion = "1.0.0"\nedition = 2\n', "utf-8")
        return [d.name for d in check_with(Memo(), None, CheckInputs.of(find_library(Path(folder)), None))]


def beside_scene(text: str) -> list[str]:
    """Return the names of the problems that `skillc check --scene` finds in a scene beside a small library."""
    with TemporaryDirectory() as folder:
        Path(folder, "example.skill").write_text("use skiros\nclass Rag < Product\n", "utf-8")
        Path(folder, "example.ttl").write_text(text, "utf-8")
        return [
            d.name
            for d in check_with(Memo(), None, CheckInputs.of(find_library(Path(folder)), Path(folder, "example.ttl")))
        ]


@pytest.mark.slow
@pytest.mark.parametrize("page", load_pages().values(), ids=lambda page: page.name)
def test_the_examples_show_the_problem_and_its_cure(page: Page) -> None:
    assert problems(page, page.bad) == [page.name]
    assert problems(page, page.good) == []


@pytest.mark.parametrize("page", load_pages().values(), ids=lambda page: page.name)
def test_pages_are_short_and_complete(page: Page) -> None:
    assert page.title[0].isupper() or page.title[0] == "`"
    assert "##" not in page.prose and all(len(line) <= 100 for line in page.prose.splitlines())
    assert len(page.bad.splitlines()) <= 20 and len(page.good.splitlines()) <= 20


@pytest.mark.slow
def test_every_diagnostic_has_a_page() -> None:
    given = {name for folder in PLACES for file in (ROOT / folder).rglob("*.py") for name in named(file)}
    given |= {f"unknown-{kind}" for kind in get_args(UnknownKind)}
    assert len(given) > 100
    assert given - page_names() == set()


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("family: names", "family: nouns", "says `nouns`, which is none of"),
        ("# unknown-class", "# unknown-klass", "unknown-class.md explains `unknown-klass`"),
        ("skill good", "skill better", "unknown-class.md is not of the form"),
    ],
)
def test_a_page_that_is_no_page_is_refused(old: str, new: str, says: str) -> None:
    text = (ROOT / "compiler/skillc_compiler/manual/unknown-class.md").read_text("utf-8")
    assert parse_page("unknown-class", text) == load_pages()["unknown-class"]
    with pytest.raises(ValueError, match=says):
        parse_page("unknown-class", text.replace(old, new))


def named(file: Path) -> Iterator[str]:
    """Yield the names of the diagnostics that a file makes."""
    tree = ast.parse(file.read_text())
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Name(id=function) | ast.Attribute(attr=function), args=[first, *rest]):
                if function in GIVERS:
                    given = (text for argument in (first, *rest[:1]) for text in texts(argument))
                    yield from (text for text in given if NAME.fullmatch(text))
            case ast.FunctionDef(name="_problem_name"):
                returned = [each.value for each in ast.walk(node) if isinstance(each, ast.Return) and each.value]
                yield from (name for value in returned for name in texts(value) if NAME.fullmatch(name))
            case ast.Assign(targets=[ast.Name(id="NAMES")], value=ast.Tuple(elts=elements)) if "checks" in file.parts:
                yield from (name for element in elements for name in texts(element))


def texts(node: ast.expr) -> Iterator[str]:
    """Yield what an expression may be, where it is a text, one of two texts or `unknown-` with a kind of term."""
    match node:
        case ast.Constant(value=str(text)):
            yield text
        case ast.IfExp(body=one, orelse=other):
            yield from (*texts(one), *texts(other))
        case ast.JoinedStr(values=[ast.Constant(value="unknown-"), _]):
            yield from (f"unknown-{kind}" for kind in ("class", "relation", "property", "function", "skill"))
