"""One token of a shipped scene is changed: nothing crashes, and what is no Turtle any more is told beside it."""

from __future__ import annotations

import os

import rdflib
from rdflib.plugins.parsers.notation3 import BadSyntax

from scene.mutations import Mutant, mutants
from skillc.services.library import libraries
from skillc_dsl.diagnostics import Diagnostic
from skillc_ontology import catalogue
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import read_documents

SEEDS = int(os.environ.get("SCENE_SEEDS", "6"))
SHEETS = tuple(Document(name, text) for name, text in catalogue.vocabulary_files())


def graph(text: str) -> rdflib.Graph | None:
    """Return what the text says, None where it is no Turtle."""
    try:
        return rdflib.Graph().parse(data=text, format="turtle")
    except (BadSyntax, ValueError, AttributeError, IndexError):
        return None


def is_near(mutant: Mutant, problem: Diagnostic) -> bool:
    places = [problem.span, *(note.span for note in problem.labels)]
    return any(place.line - 1 <= mutant.line <= place.end_line + 1 for place in places)


def test_a_changed_token_is_told_beside_it_and_once() -> None:
    illegal = single = 0
    for name in ("iiwa_table", "ur5e_whiteboard"):
        text = catalogue.scene_path(name).read_text("utf-8")
        meant = graph(text)
        for mutant in mutants(text, range(SEEDS)):
            problems = read_documents(
                [Document("scene.ttl", mutant.text), *SHEETS], libraries.load_vocabulary()
            ).problems
            said = graph(mutant.text)
            if said is None:
                assert any(is_near(mutant, problem) for problem in problems), mutant
                illegal += 1
                single += len(problems) == 1
            elif meant is not None and set(said) == set(meant):
                assert problems == (), mutant
    assert illegal > SEEDS / 2
    assert single >= 0.9 * illegal
