"""Loads a scene: the individuals of Turtle files, checked against the vocabulary, as the first version of a world."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import pyoxigraph as ox

from skillc_compiler.library.vocabulary import Vocabulary
from skillc_compiler.turtle.problems import Place, Problem
from skillc_compiler.turtle.statements import Node, Parsed, Statement
from skillc_compiler.turtle.terms import RDF, RDF_TYPE
from skillc_ontology.catalogue import sheet_files
from skillc_runtime.scene.breaches import breaches
from skillc_runtime.scene.checks.classes import misplaced_classes, of_lost_classes
from skillc_runtime.scene.checks.identity import Claims
from skillc_runtime.scene.checks.ineffective import ineffective, language_tags, without_class
from skillc_runtime.scene.documents import Document, SceneError, parse, resolved, unreadable
from skillc_runtime.scene.flaws import flaws
from skillc_runtime.scene.memory import CAREFULLY, NoRoom, make_sure
from skillc_runtime.scene.quick import quick_world
from skillc_runtime.scene.reading import Reader
from skillc_runtime.scene.standard_terms import is_misspelt, standard_terms
from skillc_runtime.scene.statements import facts, iri_of, with_own_classes, with_own_prefixes
from skillc_runtime.scene.suggestions import suggest
from skillc_runtime.world.state.world_state import WorldState

FIRST = f"{RDF}first"


@dataclass(frozen=True, slots=True)
class Scene:
    """What was understood of Turtle files, all that is wrong with them, and what they say of individuals.

    `doubtful` are individuals of which more may be said than was understood.
    """

    state: WorldState
    problems: tuple[Problem, ...]
    said: tuple[Statement, ...]
    doubtful: frozenset[str]

    @property
    def ok(self) -> bool:
        """Whether there is no error among the problems."""
        return not any(problem.severity == "error" for problem in self.problems)


def load_scene(
    path: Path, vocabulary: Vocabulary, warn: Callable[[Sequence[Problem]], None] = lambda problems: None
) -> WorldState:
    """Return the world of a scene file and of the packaged data sheets; SceneError with all that is wrong.

    What is doubtful and no error goes to `warn`.
    """
    own = Document.read(path)
    quick = _quickly(own, [own, *sheets()], vocabulary)
    if quick is not None:
        return quick
    scene = scene_in(own, vocabulary)
    state = _sound(scene)
    if scene.problems:
        warn(scene.problems)
    return state


def world_of(documents: Sequence[Document], vocabulary: Vocabulary) -> WorldState:
    """Return the world of Turtle documents; SceneError with all that is wrong."""
    return _sound(scene_of(documents, vocabulary))


def read_scene(path: Path, vocabulary: Vocabulary) -> Scene:
    """Read a scene file beside the packaged data sheets; SceneError when there is no text to read."""
    return scene_in(Document.read(path), vocabulary)


def load_sheets(vocabulary: Vocabulary) -> WorldState:
    """Return the world of the packaged data sheets alone, to which scenes add."""
    return world_of(sheets(), vocabulary)


def sheets() -> list[Document]:
    """Return the packaged vocabularies and data sheets, and the data sheets in folders of the user's."""
    return [Document(name, text) for name, text in sheet_files()]


def scene_of(documents: Iterable[Document], vocabulary: Vocabulary) -> Scene:
    """Read Turtle documents.

    Any numeric literal is a number. Prefixes and classes that a document declares join the vocabulary of the world;
    templates and annotations are passed over.
    """
    parsed = [parse(document, vocabulary.namespaces) for document in documents]
    said = [resolved(each, vocabulary.aliases) for document in parsed for each in document.statements]
    written = said[: len(parsed[0].statements)] if parsed else []
    vocabulary = with_own_prefixes(vocabulary, parsed)
    known = vocabulary.classes.keys()
    vocabulary = with_own_classes(vocabulary, said)
    syntax = [problem for document in parsed for problem in document.problems]
    own = frozenset(vocabulary.classes.keys() - known)
    terms = [*_misused(said, vocabulary), *_unnamed(said, vocabulary), *misplaced_classes(said, own, vocabulary)]
    lost = of_lost_classes(said, own, vocabulary)
    clear = tuple(each for each in facts(said, vocabulary) if iri_of(each.subject) not in lost)
    scene = _understood(clear, vocabulary, [*syntax, *terms], _doubtful(parsed) | lost)
    return _with_rest(scene, written, own)


def _quickly(own: Document, documents: Sequence[Document], vocabulary: Vocabulary) -> WorldState | None:
    try:
        return quick_world(documents, vocabulary)
    except NoRoom as error:
        raise SceneError([unreadable(own.path, str(error))]) from error


def scene_in(own: Document, vocabulary: Vocabulary) -> Scene:
    """Read a scene's text beside the packaged data sheets; SceneError when there is no room for it."""
    try:
        make_sure(CAREFULLY * len(own.text))
    except NoRoom as error:
        reason = f"something may be wrong with it, and to find what takes a smaller file: {error}"
        raise SceneError([unreadable(own.path, reason)]) from error
    scene = scene_of([own, *sheets()], vocabulary)
    if scene.problems or any(each.lines.path == own.path for each in scene.said):
        return scene
    place = Place(own.path, 1, 1, 1, 1)
    nothing = Problem(place, "empty-scene", "there is nothing in this scene", "name a thing: `:x a CLASS .`")
    return Scene(scene.state, (nothing,), scene.said, scene.doubtful)


def _understood(
    said: tuple[Statement, ...], vocabulary: Vocabulary, problems: list[Problem], doubtful: frozenset[str]
) -> Scene:
    reader = Reader(vocabulary, said, doubtful)
    written = list(reader.changes())
    state = WorldState.empty(vocabulary).changed(change for change, _ in written)
    wrong = [*problems, *reader.problems, *breaches(state, written)]
    wrong += flaws(state, said, wrong, doubtful)
    return Scene(state, _ordered(wrong), said, doubtful)


def _with_rest(scene: Scene, written: Sequence[Statement], own: frozenset[str]) -> Scene:
    """Return the scene with what is wrong with those of its statements that are no facts, and which have no effect."""
    vocabulary = scene.state.vocabulary
    claims = Claims(written, scene.state)
    found = [*claims.problems(), *without_class(written, vocabulary), *language_tags(written, vocabulary)]
    found += ineffective(written, facts(written, vocabulary), vocabulary, own, claims.used)
    return replace(scene, problems=_ordered([*scene.problems, *found]))


def _ordered(problems: Iterable[Problem]) -> tuple[Problem, ...]:
    return tuple(sorted(dict.fromkeys(problems), key=lambda each: (each.place, each.name, each.message)))


def _sound(scene: Scene) -> WorldState:
    if not scene.ok:
        raise SceneError(scene.problems)
    return scene.state


def _doubtful(parsed: Sequence[Parsed]) -> frozenset[str]:
    return frozenset[str]().union(*(document.doubtful for document in parsed))


def _misused(said: Iterable[Statement], vocabulary: Vocabulary) -> Iterator[Problem]:
    """Yield what is wrong with terms of OWL and RDFS, and with things that have no name."""
    for each in said:
        cls = iri_of(each.object) if each.predicate == RDF_TYPE else ""
        if is_misspelt(each.predicate):
            yield _misspelt("property", each.predicate, each.predicate_place, vocabulary)
        elif is_misspelt(cls):
            yield _misspelt("class", cls, each.object_place, vocabulary)
        elif isinstance(each.subject, ox.BlankNode) and cls in vocabulary.classes:
            message = f"this {vocabulary.short(cls)} has no name"
            yield Problem(each.subject_place, "unnamed-individual", message, f"write `:NAME a {vocabulary.short(cls)}`")


def _unnamed(said: Sequence[Statement], vocabulary: Vocabulary) -> Iterator[Problem]:
    """Yield a problem for each thing without a name, and of no class, that a relation or a property is said of."""
    typed = {each.subject for each in said if each.predicate == RDF_TYPE and iri_of(each.object) in vocabulary.classes}
    lists = {each.subject for each in said if each.predicate == FIRST}
    told = set[Node]()
    for each in said:
        relation = each.predicate in vocabulary.relations
        if relation and each.object in lists:
            message = f"{vocabulary.short(each.predicate)} leads to an individual, and this is a list"
            help_ = "name its members one after another, with a `,` between them"
            yield Problem(each.object_place, "relation-range", message, help_)
        for node, place in ((each.subject, each.subject_place), (each.object, each.object_place)):
            said_of = relation or (each.predicate in vocabulary.properties and node is each.subject)
            if said_of and isinstance(node, ox.BlankNode) and node not in typed | lists | told:
                told.add(node)
                yield Problem(
                    place, "unnamed-individual", "this has no name", "give it one, and a class: `:NAME a CLASS`"
                )


def _misspelt(kind: Literal["class", "property"], term: str, place: Place, vocabulary: Vocabulary) -> Problem:
    near = suggest(term, place, vocabulary, standard_terms(term))
    return Problem(place, f"unknown-{kind}", f"there is no {kind} {vocabulary.short(term)}", near.help, edit=near.edit)
