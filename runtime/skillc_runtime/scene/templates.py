"""Reads templates of a scene: statements about a `skiros:Template` are facts about its instances."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from skillc_rdf.turtle.statements import Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.aside import set_aside
from skillc_runtime.scene.documents import Document, SceneError, parse, with_canonical_terms
from skillc_runtime.scene.load import sheet_documents
from skillc_runtime.scene.mistakes import LocatedFacts
from skillc_runtime.scene.statements import (
    NAMED_INDIVIDUAL,
    iri_of,
    is_remark,
    select_facts,
    with_own_classes,
    with_prefixes,
)
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.templates import Templates
from skillc_runtime.world.state.terms import HAS_TEMPLATE, TEMPLATE


def load_templates(path: Path, vocabulary: Vocabulary) -> Templates:
    """Return the templates of a scene file, which may refer to the packaged data sheets; SceneError for mistakes."""
    return read_templates([Document.read(path), *sheet_documents()], vocabulary)


def read_templates(documents: Iterable[Document], vocabulary: Vocabulary) -> Templates:
    """Return the templates of Turtle documents; SceneError with the problems of templates and documents."""
    parsed = [parse(document, vocabulary.namespaces) for document in documents]
    said = [with_canonical_terms(each, vocabulary.aliases) for document in parsed for each in document.statements]
    vocabulary = with_own_classes(with_prefixes(vocabulary, parsed), said)
    templates = {
        iri_of(each.subject) for each in said if each.predicate == RDF_TYPE and iri_of(each.object) == TEMPLATE
    }
    located = LocatedFacts(
        [*select_facts(set_aside(said, vocabulary).understood, vocabulary), *_patterns(said, templates)], vocabulary
    )
    patterns: dict[str, list[Change]] = {each: [] for each in sorted(templates)}
    for change, statement in located.changes():
        patterns.get(iri_of(statement.subject), []).append(change)
    problems = [problem for document in parsed for problem in document.problems] + list(located.problems(()))
    if problems:
        raise SceneError(problems)
    return Templates(vocabulary, {each: tuple(changes) for each, changes in patterns.items()})


def _patterns(said: Iterable[Statement], templates: set[str]) -> Iterator[Statement]:
    """Yield the statements about templates that are facts about their instances."""
    ignored = {TEMPLATE, NAMED_INDIVIDUAL}
    for each in said:
        is_pattern = iri_of(each.subject) in templates and iri_of(each.object) not in ignored
        if is_pattern and each.predicate != HAS_TEMPLATE and not is_remark(each.predicate):
            yield each
