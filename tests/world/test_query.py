"""Queries over a scene: typed answers with short names, and what is said of those that have none."""

from __future__ import annotations

import pytest

from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.query import QueryAnswer, QueryError, run_query
from world.lab import NS, VOCABULARY

SCENE = Document(
    "scene.ttl",
    f"""@prefix t: <{NS}> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    t:Box a t:Product ; t:weight 3 ; t:label "red"@en . t:Rod a t:Product ; t:weight 1.5e0 . t:Far t:weight 1e999 .
    t:Board a t:Board ; t:isClean false ; rdfs:label "board" .
    """,
)


def ask(sparql: str) -> QueryAnswer:
    return run_query([SCENE], sparql, VOCABULARY)


def test_answers_are_typed_and_individuals_are_short() -> None:
    answer = ask("SELECT ?x ?w ?l { ?x a t:Product ; t:weight ?w OPTIONAL { ?x t:label ?l } } ORDER BY ?x")
    assert answer.columns == ("x", "w", "l")
    assert answer.rows == (("t:Box", 3, "red"), ("t:Rod", 1.5, None))
    assert [type(row[1]) for row in answer.rows] == [int, float]
    assert ask("SELECT ?c { t:Board t:isClean ?c }").rows == ((False,),)
    assert ask("ASK { ?x a t:Robot }") == QueryAnswer(("answer",), ((False,),))


def test_what_json_cannot_say_stays_text() -> None:
    assert ask("SELECT ?w { t:Far t:weight ?w }").rows == (("INF",),)


def test_terms_of_rdf_and_owl_are_short_and_need_no_declaration() -> None:
    predicates = {row[1] for row in ask("CONSTRUCT { t:Board ?p ?o } WHERE { t:Board ?p ?o }").rows}
    assert predicates == {"rdf:type", "rdfs:label", "t:isClean"}
    assert ask("SELECT ?l { ?x rdfs:label ?l }").rows == (("board",),)


REFUSED = [
    ("SELECT ?x { ?x t:weight", "not SPARQL: the query is incomplete", (1, 24)),
    ("SELEC ?s", "a query begins with SELECT, ASK, CONSTRUCT or DESCRIBE", (1, 1)),
    ("", "a query begins with SELECT", (1, 1)),
    ("SELECT ?a ?a {}", "duplicated variable name in SELECT", (1, 16)),
    ("SELECT ?x {\n\t?x foo:bar 3 }", "no prefix `foo:`; there are owl, rdf, rdfs, t, xsd", (2, 5)),
    ("PREFIX a: <http://a/> SELECT ?x { ?x a:b 3 ; c:d 4 }", "no prefix `c:`; there are a, owl", (1, 46)),
    ("DELETE WHERE { ?s ?p ?x }", "queries only: DELETE would change data", (1, 1)),
    ("PREFIX a: <http://a/>\ninsert data { a:b a:c 3 }", "queries only: INSERT", (2, 1)),
    ("SELECT ?x {\n SERVICE <http://a.b/> { ?x ?p ?y } }", "do not use the network", (2, 2)),
    ("SELECT ?x " + "{ " * 8000, "more than 100 brackets are open here", (1, 211)),
    ("ASK { FILTER(" + "!STR(" * 40, "more than 8 brackets after a `!` are open here", (1, 58)),
    ("ASK { service silent <http://a.b/> { ?x ?p ?y } }", "do not use the network", (1, 7)),
]


@pytest.mark.parametrize(("sparql", "words", "place"), REFUSED)
def test_a_refused_query_is_shown_with_a_caret(sparql: str, words: str, place: tuple[int, int]) -> None:
    with pytest.raises(QueryError) as caught:
        ask(sparql)
    sentence, line, caret = str(caught.value).split("\n")
    assert words in sentence and sentence.endswith(f"(line {place[0]}, column {place[1]})")
    assert line == "  " + ([*sparql.splitlines(), ""][place[0] - 1])
    assert len(caret) == place[1] + 2 and caret.endswith("^")


def test_a_failure_of_the_evaluation_is_an_error_of_the_query() -> None:
    with pytest.raises(QueryError, match=r"cannot be answered: .*http://foo/f"):
        ask("SELECT (<http://foo/f>(3) AS ?x) {}")


def test_words_in_texts_comments_and_names_are_no_keywords() -> None:
    text = 'SELECT ?service { ?service t:label "SERVICE"@en-service } # SERVICE <http://a.b/> {}'
    assert ask(text) == QueryAnswer(("service",), ())
