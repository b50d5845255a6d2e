"""Loads a scene: reads the individuals of Turtle files, checks them, and builds the first version of a world."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import msgspec
from msgspec.structs import replace

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.garbage import gc_disabled
from skillc_dsl.source import Span
from skillc_ontology.catalogue import sheet_files
from skillc_rdf.turtle.statements import Parsed, Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.aside import ASIDE, find_unfit, report_aside, report_unfit, set_aside
from skillc_runtime.scene.checks.classes import check_class_parents, have_valid_parents, individuals_of_unknown_classes
from skillc_runtime.scene.checks.identity import IdentityChecker
from skillc_runtime.scene.checks.ineffective import check_ineffective, check_language_tags, check_missing_classes
from skillc_runtime.scene.checks.terms import check_spelling
from skillc_runtime.scene.checks.unread import check_unread
from skillc_runtime.scene.classification import classify, may_classify, place_derived
from skillc_runtime.scene.documents import Document, SceneError, parse, unreadable_problem, with_canonical_terms
from skillc_runtime.scene.interpretation import interpret_table
from skillc_runtime.scene.memory import PLACED_BYTES, TooLittleMemory, check_available
from skillc_runtime.scene.mistakes import LocatedFacts
from skillc_runtime.scene.ontology_individuals import described_elsewhere, enumerated, without_elsewhere
from skillc_runtime.scene.statements import (
    SUBCLASS,
    iri_of,
    select_facts,
    with_classes,
    with_own_classes,
    with_prefixes,
)
from skillc_runtime.scene.table import StatementTable, read_table
from skillc_runtime.scene.violation_reports import (
    check_individuals,
    check_placement,
    report_axiom_violations,
    report_scene_violations,
)
from skillc_runtime.world.state.bulk import build_world_state
from skillc_runtime.world.state.consistency.hidden_truth import NOTHING_HIDDEN, hide
from skillc_runtime.world.state.consistency.representatives import satisfies_axioms
from skillc_runtime.world.state.difference import changes_between
from skillc_runtime.world.state.world_state import WorldState


class LoadedScene(msgspec.Struct, frozen=True):
    """The world of Turtle files, all problems, and the statements about individuals.

    `doubtful` are individuals about which not all statements could be read; `unfit` are statements which are no facts,
    because they contradict terms that no skill reads.
    """

    state: WorldState
    problems: tuple[Diagnostic, ...]
    said: tuple[Statement, ...]
    doubtful: frozenset[str]
    unfit: tuple[Statement, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether there is no error among the problems."""
        return not any(problem.severity == "error" for problem in self.problems)


def load_scene(
    path: Path, vocabulary: Vocabulary, warn: Callable[[Sequence[Diagnostic]], None] = lambda problems: None
) -> WorldState:
    """Return the world of a scene file and the packaged data sheets; SceneError with all errors.

    The files are read in bulk, and again with source positions only if something is or may be wrong. Warnings are
    passed to `warn`.
    """
    own = Document.read(path)
    try:
        state = load_in_bulk([own, *sheet_documents()], vocabulary)
    except TooLittleMemory as error:
        raise SceneError([unreadable_problem(own.path, str(error))]) from error
    if state is not None:
        return state
    scene = read_with_sheets(own, vocabulary)
    state = _valid_state(scene)
    if scene.problems:
        warn(scene.problems)
    return state


def load_in_bulk(documents: Sequence[Document], vocabulary: Vocabulary, scenes: int = 1) -> WorldState | None:
    """Return the world of Turtle documents, the first `scenes` of them scenes; None if something is or may be wrong.

    TooLittleMemory when there is not enough memory.
    """
    if any(each.truth is not None for each in documents):
        return None
    with gc_disabled():
        try:
            table = read_table([*documents, *enumerated(vocabulary)], vocabulary, scenes)
        except (SyntaxError, UnicodeEncodeError):
            return None
        if table.is_unusual or _may_classify(table, vocabulary):
            return None
        prefixes = {**table.prefixes, **vocabulary.prefixes}
        extended = with_classes(vocabulary, table.named[RDF_TYPE], table.named[SUBCLASS])
        extended = msgspec.structs.replace(extended, prefixes=prefixes)
        if not have_valid_parents(extended.classes.keys() - vocabulary.classes.keys(), extended):
            return None
        meaning = interpret_table(table, extended)
        if meaning.mistakes:
            return None
        state = build_world_state(extended, meaning.facts)
        wrong = not satisfies_axioms(state) or any(True for _ in (*check_individuals(state), *check_placement(state)))
        return None if wrong else state


def _may_classify(table: StatementTable, vocabulary: Vocabulary) -> bool:
    """Whether the rules of ontologies may say more of what is in a table."""
    if not vocabulary.rules:
        return False
    subjects = {subject for rows in table.named.values() for subject, _ in rows}
    subjects |= {subject for rows in table.literal.values() for subject, _ in rows}
    types = {cls for _, cls in table.named[RDF_TYPE]}
    return may_classify(vocabulary, {*table.named, *table.literal}, types, subjects)


def load_documents(documents: Sequence[Document], vocabulary: Vocabulary) -> WorldState:
    """Return the world of Turtle documents; SceneError with all errors."""
    return _valid_state(read_documents(documents, vocabulary))


def read_scene(path: Path, vocabulary: Vocabulary) -> LoadedScene:
    """Read a scene file and the packaged data sheets; SceneError when the file cannot be read."""
    return read_with_sheets(Document.read(path), vocabulary)


def load_sheets(vocabulary: Vocabulary) -> WorldState:
    """Return the world of the packaged data sheets alone, to which scenes add; SceneError with all errors.

    As those of scenes, the files are read with source positions only if something is or may be wrong.
    """
    documents = sheet_documents()
    state = load_in_bulk(documents, vocabulary, scenes=0)
    return load_documents(documents, vocabulary) if state is None else state


def sheet_documents() -> list[Document]:
    """Return the packaged vocabularies and data sheets, and the data sheets in the user's folders."""
    return [Document.of(name, text) for name, text in sheet_files()]


def read_documents(documents: Iterable[Document], vocabulary: Vocabulary) -> LoadedScene:
    """Read Turtle documents, with all problems.

    Any numeric literal is a number. Prefixes and classes that a document declares are added to the vocabulary of the
    world; templates and annotations are ignored. What is true in them, but not known, is hidden in the world.
    """
    documents = tuple(documents)
    scene, truths = _read(documents, vocabulary), [each.truth for each in documents if each.truth is not None]
    if not truths:
        return scene
    whole = _read((*documents, *truths), vocabulary)
    hidden = (
        hide(changes_between(scene.state, whole.state), scene.state.vocabulary)
        if scene.ok and whole.ok
        else NOTHING_HIDDEN
    )
    problems = _sort_problems((*scene.problems, *whole.problems))
    return replace(scene, state=dataclasses.replace(scene.state, hidden=hidden), problems=problems)


def _read(documents: Sequence[Document], vocabulary: Vocabulary) -> LoadedScene:
    """Read what is known in Turtle documents, with all problems."""
    from skillc_runtime.scene.conversion import name_subjects

    parsed = [parse(document, vocabulary.namespaces) for document in (*documents, *enumerated(vocabulary))]
    parsed += described_elsewhere(parsed, vocabulary)
    said = [with_canonical_terms(each, vocabulary.aliases) for document in parsed for each in document.statements]
    here = parsed[0].statements[0].lines.path if parsed and parsed[0].statements else ""
    classified = classify(said, vocabulary, here)
    said += [each for document in classified.documents for each in document.statements]
    vocabulary = with_prefixes(vocabulary, parsed)
    known = vocabulary.classes.keys()
    vocabulary = with_own_classes(vocabulary, said)
    found = set_aside(said, vocabulary)
    said = list(found.understood)
    written = [each for each in said if each.lines.path == here]
    syntax = [problem for document in parsed for problem in document.problems]
    own = frozenset(vocabulary.classes.keys() - known)
    terms = [
        *classified.problems,
        *check_spelling(said, vocabulary),
        *report_aside(found.aside, vocabulary),
        *check_class_parents(said, own, vocabulary),
    ]
    lost = individuals_of_unknown_classes(said, own, vocabulary)
    clear = tuple(each for each in select_facts(said, vocabulary) if iri_of(each.subject) not in lost)
    declared = vocabulary.relations.keys() | vocabulary.properties.keys()
    partly = frozenset(iri_of(each.subject) for _, each in found.aside if each.predicate in declared)
    doubtful = _doubtful_individuals(parsed) | lost
    scene = _build_scene(clear, vocabulary, [*syntax, *terms], doubtful, partly)
    if unfit := find_unfit(clear, scene.problems, vocabulary):
        contradicting = {id(each.statement) for each in unfit}
        clear = tuple(each for each in clear if id(each) not in contradicting)
        written = [each for each in written if id(each) not in contradicting]
        terms += report_unfit(unfit, vocabulary)
        scene = _build_scene(clear, vocabulary, [*syntax, *terms], doubtful, partly)
        scene = replace(scene, unfit=tuple(each.statement for each in unfit))
    scene = _with_scene_warnings(scene, written, own)
    problems = place_derived(without_elsewhere(name_subjects(scene.problems, said, vocabulary.short)), here)
    return replace(scene, problems=_sort_problems(problems))


def read_with_sheets(own: Document, vocabulary: Vocabulary) -> LoadedScene:
    """Read a scene and the packaged data sheets; SceneError when there is not enough memory."""
    try:
        check_available(PLACED_BYTES * len(own.text))
    except TooLittleMemory as error:
        reason = f"it may contain errors, but there is too little memory to check it: {error}"
        raise SceneError([unreadable_problem(own.path, reason)]) from error
    scene = read_documents([own, *sheet_documents()], vocabulary)
    if any(each.lines.path == own.path for each in scene.said) or any(each.name != ASIDE for each in scene.problems):
        return scene
    place = Span(own.path, 1, 1, 1, 1)
    cure = "name a thing: `:x a CLASS .`"
    if any(each.span.path == own.path for each in scene.problems):
        nothing = Diagnostic("empty-scene", place, "nothing in this scene is understood", cure, "warning")
    else:
        nothing = Diagnostic("empty-scene", place, "there is nothing in this scene", cure)
    return replace(scene, problems=(*scene.problems, nothing))


def _build_scene(
    said: tuple[Statement, ...],
    vocabulary: Vocabulary,
    problems: list[Diagnostic],
    doubtful: frozenset[str],
    partly: frozenset[str],
) -> LoadedScene:
    located = LocatedFacts(said, vocabulary)
    written = located.changes()
    state = WorldState.empty(vocabulary).with_changes(change for change, _ in written)
    wrong = [*problems, *located.problems(doubtful), *report_axiom_violations(state, written)]
    wrong += report_scene_violations(state, said, wrong, doubtful, partly)
    return LoadedScene(state, _sort_problems(wrong), said, doubtful)


def _with_scene_warnings(scene: LoadedScene, written: Sequence[Statement], own: frozenset[str]) -> LoadedScene:
    """Return the scene with the problems of statements that are not facts: identity, missing classes, no effect."""
    vocabulary = scene.state.vocabulary
    identity = IdentityChecker(written, scene.state)
    found = [*identity.check(), *check_missing_classes(written, vocabulary), *check_language_tags(written, vocabulary)]
    found += check_unread(written, vocabulary)
    found += check_ineffective(written, select_facts(written, vocabulary), vocabulary, own, identity.used)
    return replace(scene, problems=_sort_problems([*scene.problems, *found]))


def _sort_problems(problems: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(sorted(dict.fromkeys(problems), key=lambda each: (each.span, each.name, each.message)))


def _valid_state(scene: LoadedScene) -> WorldState:
    if not scene.ok:
        raise SceneError(scene.problems)
    return scene.state


def _doubtful_individuals(parsed: Sequence[Parsed]) -> frozenset[str]:
    return frozenset[str]().union(*(document.doubtful for document in parsed))
