"""Scenes: shipped ones changed, others made of all that RDF has, and noise; both readers agree, nothing is lost."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from random import Random

import pyoxigraph as ox

from fuzz.kinds._turtle import generated, mutated
from skillc.services.library import libraries
from skillc_ontology import catalogue
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.checks.identity import PROPERTY, SOURCE, TARGETS
from skillc_runtime.scene.documents import BASE, Document, SceneError, parse
from skillc_runtime.scene.load import LoadedScene, load_documents, load_in_bulk, read_documents
from skillc_runtime.scene.saving import SaveError, format_scene
from skillc_runtime.scene.statements import SUBCLASS, iri_of, is_annotation, is_term_kind
from skillc_runtime.store.literals import read_literal
from skillc_runtime.world.state.values import has_value
from skillc_runtime.world.state.world_state import WorldState
from world.sameness import everything

SHEETS = tuple(Document(name, text) for name, text in catalogue.vocabulary_files())
NAMED_INDIVIDUAL = "http://www.w3.org/2002/07/owl#NamedIndividual"


def run_case(random: Random, folder: Path) -> None:
    """Read a scene in both ways, save it and read it again."""
    text = _text(random)
    (folder / "scene.ttl").write_text(text, encoding="utf-8", errors="surrogatepass", newline="")
    document, vocabulary = Document("scene.ttl", text), _vocabulary()
    careful, quick = read_documents([document, *SHEETS], vocabulary), load_in_bulk([document, *SHEETS], vocabulary)
    _check_problems(careful, text)
    assert quick is None or not careful.problems, f"the quick reader passes over: {careful.problems}"
    assert quick is None or everything(quick) == everything(careful.state), "the readers disagree"
    _check_statements(careful, document, vocabulary)
    if careful.ok:
        _check_saving(careful.state, document, vocabulary)


def _text(random: Random) -> str:
    shipped = random.choice(_scenes())
    match random.randrange(10):
        case 0:
            return generated(random, 1)
        case 1 | 2 | 3:
            return generated(random, random.randrange(1, 30))
        case 4:
            return mutated(random, generated(random, random.randrange(1, 20)))
        case 5:
            return shipped + generated(random, random.randrange(1, 6))
        case _:
            return mutated(random, shipped)


@cache
def _vocabulary() -> Vocabulary:
    return libraries.load_vocabulary()


@cache
def _scenes() -> tuple[str, ...]:
    return tuple(catalogue.scene_path(name).read_text("utf-8") for name in catalogue.scene_names())


@cache
def _shipped() -> WorldState:
    return load_documents(SHEETS, _vocabulary())


def _check_problems(scene: LoadedScene, text: str) -> None:
    """Every problem has a name, words, and a place in a file."""
    last = text.count("\n") + 2
    for each in scene.problems:
        assert each.name and each.message and each.message.strip() == each.message, each
        assert each.span.path != "scene.ttl" or 1 <= each.span.line <= each.span.end_line <= last, each
        assert each.span.column >= 1 and each.span.end_column >= 1, each


def _check_statements(scene: LoadedScene, document: Document, vocabulary: Vocabulary) -> None:
    """Where nothing is said to be wrong, RDF libraries read the same, and all of it is known to the world."""
    parsed = parse(document, vocabulary.prefixes)
    if parsed.problems:
        return
    found = {str(quad) for quad in ox.parse(document.text, format=ox.RdfFormat.TURTLE, base_iri=BASE) if _ground(quad)}
    ours = (ox.Quad(s.subject, ox.NamedNode(s.predicate), s.object) for s in parsed.statements)  # type: ignore[arg-type]
    assert found == {str(quad) for quad in ours if _ground(quad)}, "not what pyoxigraph reads"
    if scene.problems:
        return
    for each in parsed.statements:
        if isinstance(each.subject, ox.NamedNode) and not isinstance(each.object, ox.BlankNode):
            aliases = vocabulary.aliases
            predicate = aliases.get(each.predicate, each.predicate)
            object_ = aliases.get(iri_of(each.object), iri_of(each.object))
            known = _is_known(scene.state, each.subject.value, predicate, object_, each.object)
            assert known, f"left out in silence: {each.subject} {predicate} {each.object}"


def _ground(quad: ox.Quad) -> bool:
    return not isinstance(quad.subject, ox.BlankNode) and not isinstance(quad.object, ox.BlankNode)


def _is_known(state: WorldState, subject: str, predicate: str, object_: str, node: object) -> bool:
    if predicate == RDF_TYPE:
        return state.is_a(subject, object_) or is_term_kind(object_) or object_ == NAMED_INDIVIDUAL
    if predicate == SUBCLASS:
        return state.vocabulary.is_a(subject, object_)
    if predicate in state.vocabulary.relations:
        return state.holds(subject, predicate, object_)
    if predicate in state.vocabulary.properties:
        term = state.vocabulary.properties[predicate]
        return isinstance(node, ox.Literal) and has_value(state.value(subject, predicate), read_literal(node, term))
    said_of_no_world = predicate.rpartition("#")[2] in ("differentFrom", "sameAs", "hasTemplate")
    denied = predicate in (SOURCE, PROPERTY, *TARGETS)  # a denial that holds; others are told
    return is_annotation(predicate) or said_of_no_world or denied or predicate in _annotations(state)


def _annotations(state: WorldState) -> frozenset[str]:
    """Return the predicate that `generated` declares to be an annotation."""
    return frozenset({"http://example.org/lab#note"})


def _without_prefixes(state: WorldState) -> dict[str, object]:
    """Return all that a world says; of the prefixes only those that are used are saved."""
    return everything(state) | {"vocabulary": state.vocabulary.classes}


def _check_saving(state: WorldState, document: Document, vocabulary: Vocabulary) -> None:
    try:
        text = format_scene(state, _shipped(), document)
    except SaveError:
        return
    try:
        again = load_documents([Document("saved.ttl", text), *SHEETS], vocabulary)
    except SceneError as error:
        raise AssertionError(f"what was saved cannot be read: {error}\n{text}") from error
    assert _without_prefixes(again) == _without_prefixes(state), "what was saved is another world"
    if "_:" not in text:
        assert format_scene(again, _shipped(), Document("saved.ttl", text)) == text, "saved again it is another text"
