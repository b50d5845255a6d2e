"""Loads a scene: the individuals of Turtle files, checked against the vocabulary, as the first version of a world."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import msgspec

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.garbage import gc_disabled
from skillc_dsl.source import Span
from skillc_ontology.catalogue import sheet_files
from skillc_rdf.turtle.statements import Parsed, Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.checks.classes import are_placed, misplaced_classes, of_lost_classes
from skillc_runtime.scene.checks.identity import Claims
from skillc_runtime.scene.checks.ineffective import ineffective, language_tags, without_class
from skillc_runtime.scene.checks.terms import misspelt_terms, unnamed_things
from skillc_runtime.scene.documents import Document, SceneError, parse, unreadable_problem, with_own_terms
from skillc_runtime.scene.interpretation import interpret
from skillc_runtime.scene.memory import PLACED_BYTES, TooLittleMemory, check_available
from skillc_runtime.scene.mistakes import PlacedFacts
from skillc_runtime.scene.placing import of_places, of_things, place_axiom_violations, place_scene_violations
from skillc_runtime.scene.statements import SUBCLASS, facts, iri_of, with_classes, with_own_classes, with_prefixes
from skillc_runtime.scene.table import read_table
from skillc_runtime.world.state.bulk import state_of
from skillc_runtime.world.state.representatives import satisfies_axioms
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Scene:
    """What was understood of Turtle files, all that is wrong with them, and what they say of individuals.

    `doubtful` are individuals of which more may be said than was understood.
    """

    state: WorldState
    problems: tuple[Diagnostic, ...]
    said: tuple[Statement, ...]
    doubtful: frozenset[str]

    @property
    def ok(self) -> bool:
        """Whether there is no error among the problems."""
        return not any(problem.severity == "error" for problem in self.problems)


def load_scene(
    path: Path, vocabulary: Vocabulary, warn: Callable[[Sequence[Diagnostic]], None] = lambda problems: None
) -> WorldState:
    """Return the world of a scene file and of the packaged data sheets; SceneError with all that is wrong.

    It is read in bulk, and again with places only where something is, or may be, wrong. What is doubtful and no error
    goes to `warn`.
    """
    own = Document.read(path)
    try:
        state = load_in_bulk([own, *sheet_documents()], vocabulary)
    except TooLittleMemory as error:
        raise SceneError([unreadable_problem(own.path, str(error))]) from error
    if state is not None:
        return state
    scene = scene_in(own, vocabulary)
    state = _without_errors(scene)
    if scene.problems:
        warn(scene.problems)
    return state


def load_in_bulk(documents: Sequence[Document], vocabulary: Vocabulary) -> WorldState | None:
    """Return the world of Turtle documents, the first one a scene; None where something is, or may be, wrong.

    TooLittleMemory when the machine has not enough for them.
    """
    with gc_disabled():
        try:
            table = read_table(documents, vocabulary)
        except (SyntaxError, UnicodeEncodeError):
            return None
        if table.unusual:
            return None
        prefixes = {**table.prefixes, **vocabulary.prefixes}
        extended = with_classes(vocabulary, table.named[RDF_TYPE], table.named[SUBCLASS])
        extended = msgspec.structs.replace(extended, prefixes=prefixes)
        if not are_placed(extended.classes.keys() - vocabulary.classes.keys(), extended):
            return None
        meaning = interpret(table, extended)
        if meaning.mistakes:
            return None
        state = state_of(extended, meaning.facts)
        wrong = not satisfies_axioms(state) or any(True for _ in (*of_things(state), *of_places(state)))
        return None if wrong else state


def world_of(documents: Sequence[Document], vocabulary: Vocabulary) -> WorldState:
    """Return the world of Turtle documents; SceneError with all that is wrong."""
    return _without_errors(scene_of(documents, vocabulary))


def read_scene(path: Path, vocabulary: Vocabulary) -> Scene:
    """Read a scene file beside the packaged data sheets; SceneError when there is no text to read."""
    return scene_in(Document.read(path), vocabulary)


def load_sheets(vocabulary: Vocabulary) -> WorldState:
    """Return the world of the packaged data sheets alone, to which scenes add."""
    return world_of(sheet_documents(), vocabulary)


def sheet_documents() -> list[Document]:
    """Return the packaged vocabularies and data sheets, and the data sheets in folders of the user's."""
    return [Document(name, text) for name, text in sheet_files()]


def scene_of(documents: Iterable[Document], vocabulary: Vocabulary) -> Scene:
    """Read Turtle documents.

    Any numeric literal is a number. Prefixes and classes that a document declares join the vocabulary of the world;
    templates and annotations are passed over.
    """
    parsed = [parse(document, vocabulary.namespaces) for document in documents]
    said = [with_own_terms(each, vocabulary.aliases) for document in parsed for each in document.statements]
    written = said[: len(parsed[0].statements)] if parsed else []
    vocabulary = with_prefixes(vocabulary, parsed)
    known = vocabulary.classes.keys()
    vocabulary = with_own_classes(vocabulary, said)
    syntax = [problem for document in parsed for problem in document.problems]
    own = frozenset(vocabulary.classes.keys() - known)
    terms = [
        *misspelt_terms(said, vocabulary),
        *unnamed_things(said, vocabulary),
        *misplaced_classes(said, own, vocabulary),
    ]
    lost = of_lost_classes(said, own, vocabulary)
    clear = tuple(each for each in facts(said, vocabulary) if iri_of(each.subject) not in lost)
    scene = _understood(clear, vocabulary, [*syntax, *terms], _doubtful(parsed) | lost)
    return _with_rest(scene, written, own)


def scene_in(own: Document, vocabulary: Vocabulary) -> Scene:
    """Read a scene's text beside the packaged data sheets; SceneError when there is no room for it."""
    try:
        check_available(PLACED_BYTES * len(own.text))
    except TooLittleMemory as error:
        reason = f"something may be wrong with it, and to find what takes a smaller file: {error}"
        raise SceneError([unreadable_problem(own.path, reason)]) from error
    scene = scene_of([own, *sheet_documents()], vocabulary)
    if scene.problems or any(each.lines.path == own.path for each in scene.said):
        return scene
    place = Span(own.path, 1, 1, 1, 1)
    nothing = Diagnostic("empty-scene", place, "there is nothing in this scene", "name a thing: `:x a CLASS .`")
    return Scene(scene.state, (nothing,), scene.said, scene.doubtful)


def _understood(
    said: tuple[Statement, ...], vocabulary: Vocabulary, problems: list[Diagnostic], doubtful: frozenset[str]
) -> Scene:
    placed = PlacedFacts(said, vocabulary)
    written = placed.changes()
    state = WorldState.empty(vocabulary).changed(change for change, _ in written)
    wrong = [*problems, *placed.problems(doubtful), *place_axiom_violations(state, written)]
    wrong += place_scene_violations(state, said, wrong, doubtful)
    return Scene(state, _ordered(wrong), said, doubtful)


def _with_rest(scene: Scene, written: Sequence[Statement], own: frozenset[str]) -> Scene:
    """Return the scene with what is wrong with those of its statements that are no facts, and which have no effect."""
    vocabulary = scene.state.vocabulary
    claims = Claims(written, scene.state)
    found = [*claims.problems(), *without_class(written, vocabulary), *language_tags(written, vocabulary)]
    found += ineffective(written, facts(written, vocabulary), vocabulary, own, claims.used)
    return replace(scene, problems=_ordered([*scene.problems, *found]))


def _ordered(problems: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(sorted(dict.fromkeys(problems), key=lambda each: (each.span, each.name, each.message)))


def _without_errors(scene: Scene) -> WorldState:
    if not scene.ok:
        raise SceneError(scene.problems)
    return scene.state


def _doubtful(parsed: Sequence[Parsed]) -> frozenset[str]:
    return frozenset[str]().union(*(document.doubtful for document in parsed))
