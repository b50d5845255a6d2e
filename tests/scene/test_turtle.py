"""The Turtle reader: it reads what RDF parsers read, refuses what they refuse, and knows the place of every term."""

from __future__ import annotations

import os
from collections import Counter
from random import Random

import pytest

from scene.mutations import mutants
from scene.turtle_texts import BASE, EVERYTHING, by_oxigraph, by_rdflib, random_text, shown
from skillc_dsl.diagnostics import Fix
from skillc_dsl.source import Span
from skillc_ontology import catalogue
from skillc_rdf.turtle.parser import parse
from skillc_rdf.turtle.statements import Parsed
from skillc_rdf.turtle.tokens import tokens

SEEDS = int(os.environ.get("TURTLE_SEEDS", "30"))
FILES = [("everything", EVERYTHING), *catalogue.vocabulary_files()]
FILES += [(name, catalogue.scene_path(name).read_text("utf-8")) for name in catalogue.scene_names()]
CHARACTERS = ".;,[]()<>\"'\\@^_:#a1 \n%{}|`\x00\x7fé\u2028"
PREFIXES = "@prefix : <http://e.org/> .\n@prefix lab: <http://e.org/lab#> .\n"
KNOWN = {"skiros": "http://rvmi.aau.dk/ontologies/skiros.owl#"}


def read(text: str) -> Parsed:
    return parse("scene.ttl", text, BASE, KNOWN)


def triples(parsed: Parsed) -> Counter[tuple[str, str, str]]:
    return Counter((shown(s.subject), s.predicate, shown(s.object)) for s in parsed.statements)


@pytest.mark.parametrize(("name", "text"), FILES, ids=[name for name, _ in FILES])
def test_files_are_read_as_other_parsers_read_them(name: str, text: str) -> None:
    parsed = read(text)
    assert not parsed.problems
    assert triples(parsed) == by_oxigraph(text)
    assert name == "everything" or set(triples(parsed)) == by_rdflib(text), "rdflib does not know all of Turtle"


def test_random_texts_are_read_as_other_parsers_read_them() -> None:
    sizes = []
    for seed in range(SEEDS):
        plain, text = random_text(seed)
        parsed = read(text)
        assert not parsed.problems, (seed, parsed.problems)
        assert triples(parsed) == by_oxigraph(text), seed
        assert set(triples(parsed)) == by_rdflib(plain), seed
        sizes.append(len(parsed.statements))
    assert len(sizes) == SEEDS and max(sizes) > 15


def test_what_other_parsers_refuse_is_refused_and_nothing_else() -> None:
    refused = 0
    for seed in range(5 * SEEDS):
        random = Random(seed)
        _, text = random.choice(FILES)
        at = random.randrange(len(text))
        text = text[:at] + random.choice(CHARACTERS) + text[at + random.randrange(2) :]
        parsed, other = parse("scene.ttl", text, BASE), by_oxigraph(text)
        assert (other is None) == bool(parsed.problems), (seed, parsed.problems)
        assert other is None or triples(parsed) == other, seed
        refused += other is None
    assert refused > SEEDS


def test_exchanged_tokens_are_refused_just_as_by_other_parsers() -> None:
    refused = 0
    for mutant in mutants(EVERYTHING, range(5 * SEEDS)):
        parsed, other = read(mutant.text), by_oxigraph(mutant.text)
        assert (other is None) == bool(parsed.problems), (mutant, parsed.problems)
        assert other is None or triples(parsed) == other, mutant
        refused += other is None
    assert refused > SEEDS


def test_every_term_is_where_its_place_says() -> None:
    text = '@prefix : <http://e/> .\n:x  a :Y ;\n\t:p  "ä", [ :q 1.5 ] .\n'
    lines = text.split("\n")

    def at(place: Span) -> str:
        assert place.line == place.end_line
        return lines[place.line - 1][place.column - 1 : place.end_column - 1]

    found = [(at(s.subject_place), at(s.predicate_place), at(s.object_place)) for s in read(text).statements]
    assert sorted(found) == sorted([(":x", "a", ":Y"), (":x", ":p", '"ä"'), (":x", ":p", "["), ("[", ":q", "1.5")])


MISTAKES = [
    (":x a :Y ;\n  :p 1\n:z a :Y .", 4, "a `.` is missing after `1`", ":x a :Y ;\n  :p 1 .\n:z a :Y ."),
    (":x a :Y\n  :p 1 .", 3, "a `;` is missing after `:Y`", ":x a :Y ;\n  :p 1 ."),
    (":x :p :y :z .", 3, "a `,` is missing after `:y`", ":x :p :y , :z ."),
    (":x a :Y ;\n\n:z a :Y .", 3, "begins a new statement", ":x a :Y .\n\n:z a :Y ."),
    (":x a :Y .\n  :p 1 ; :q 2 .", 3, "the statement continues after", ":x a :Y ;\n  :p 1 ; :q 2 ."),
    (":x a :Y ; :p .", 3, "`:p` has no value", None),
    (":x a .", 3, "`a` has no value", None),
    (":x :p 1, .", 3, "a value is missing after this `,`", None),
    (":x :p 3 N .", 3, "unexpected `N` after the number 3", None),
    (":x :p tru .", 3, "`tru` is not a value", ":x :p true ."),
    (":x :p True .", 3, "`True` is not a value", ":x :p true ."),
    (":x :p Y . :Y a :Z .", 3, "`Y` has no prefix", ":x :p :Y . :Y a :Z ."),
    (':x :p "open .\n:z a :Y .', 3, "has no closing quote", None),
    (':x :p """open .\n:z a :Y .', 3, "has no closing quote", None),
    (":x :p <http://open .\n:z a :Y .", 3, "has no `>`", None),
    (":x :p http://e.org/y .", 3, "`http://e.org/y` is not a name", None),
    (":x :p [ a :Y .\n:z a :Y .", 3, "the `[` that begins here has no `]`", None),
    (":x :p ( 1 2 .\n:z a :Y .", 3, "the `(` that begins here has no `)`", None),
    (":x a :Y . .", 3, "this `.` ends no statement", None),
    ("// a comment\n:x a :Y .", 3, "`//` is not Turtle", None),
    (':x :p "a\\qb" .', 3, "has `\\q`, which is not an escape", None),
    (':x :p "a"@e-n .', 3, "is not a language tag", None),
    (':x :p "a"^^ .', 3, "a datatype is missing", None),
    ("@prefix lab2 <http://e.org/> .", 3, "this is not a valid declaration of a prefix", None),
    ("@prefx l: <http://e.org/> .", 3, "there is no `@prefx`", None),
    (
        "l: <http://e.org/> .\nl:x a :Y .",
        3,
        "`@prefix` is missing before this",
        "@prefix l: <http://e.org/> .\nl:x a :Y .",
    ),
    ("@prefix l: <http://e.org/>\nl:x a :Y .", 3, "a `.` is missing", "@prefix l: <http://e.org/> .\nl:x a :Y ."),
    ("PREFIX l: <http://e.org/> .\nl:x a :Y .", 3, "does not end with a `.`", None),
    (":x a labb:Y . :y a lab:Z .", 3, "the prefix `labb:` is not declared", ":x a lab:Y . :y a lab:Z ."),
    (":x a skiros:Y, skiros:Z .", 3, "the prefix `skiros:` is not declared", None),
    (":x .", 3, "nothing is stated about `:x`", None),
    (":x :p " + "[ :p " * 120 + "1" + " ]" * 120 + " .", 3, "nested too deeply", None),
]


@pytest.mark.parametrize(("text", "line", "words", "cured"), MISTAKES)
def test_a_mistake_is_told_once_with_its_cure(text: str, line: int, words: str, cured: str | None) -> None:
    (problem,) = read(PREFIXES + text).problems
    assert (problem.span.line, words in problem.message) == (line, True), problem
    if cured is not None:
        assert problem.fix is not None
        assert edited(PREFIXES + text, problem.fix) == PREFIXES + cured


def edited(text: str, edit: Fix) -> str:
    lines = text.split("\n")
    line = lines[edit.span.line - 1]
    lines[edit.span.line - 1] = line[: edit.span.column - 1] + edit.text + line[edit.span.end_column - 1 :]
    return "\n".join(lines)


def test_several_mistakes_are_told_and_the_rest_is_read() -> None:
    text = ":a a :Y\n :p 1 .\n:b a :Y ; :q ; :r 2 .\n:c a :Y ; :s 3 x ; :t 4 .\n:d a nope:Y .\n"
    parsed = read(PREFIXES + text)
    assert [problem.span.line for problem in parsed.problems] == [3, 5, 6, 7]
    predicates = {s.predicate.removeprefix("http://e.org/") for s in parsed.statements}
    assert {"p", "r", "s", "t"} <= predicates and "q" not in predicates
    assert "http://e.org/b" in parsed.doubtful and "http://e.org/a" not in parsed.doubtful


def test_a_misspelt_namespace_is_told_at_its_declaration() -> None:
    parsed = read("@prefix skiros: <http://rvmi.aau.dk/ontologies/skirs.owl#> .\n\n\nskiros:x a skiros:Y, skiros:Z .\n")
    (problem,) = parsed.problems
    assert (problem.name, problem.span.line) == ("unknown-vocabulary", 1)
    assert {s.object.value for s in parsed.statements} == {KNOWN["skiros"] + "Y", KNOWN["skiros"] + "Z"}


@pytest.mark.parametrize(
    ("text", "format_"),
    [
        ('<?xml version="1.0"?>\n<rdf:RDF></rdf:RDF>', "RDF/XML"),
        ('<rdf:RDF xmlns:rdf="x"></rdf:RDF>', "RDF/XML"),
        ('{ "@context": {} }', "JSON"),
        ("<!DOCTYPE html><html>", "RDF/XML"),
        ("<html><body>", "HTML"),
        ("# a library\nuse skiros, wiping\n\nskill X {\n}\n", "a skill library"),
    ],
)
def test_another_format_is_told_once(text: str, format_: str) -> None:
    (problem,) = read(text).problems
    assert problem.name == "not-turtle" and f"this is {format_}, not Turtle" == problem.message


@pytest.mark.parametrize(("name", "text"), FILES, ids=[name for name, _ in FILES])
def test_a_letter_beyond_ascii_anywhere_changes_no_other_token(name: str, text: str) -> None:
    plain = text.encode("ascii", "ignore").decode()
    assert list(tokens(f"{plain}\n# \u00e9"))[:-1] == list(tokens(plain))[:-1]
