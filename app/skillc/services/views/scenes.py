"""Lists, searches, queries, compares and draws a scene, or the world in a store."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import NamedTuple

import pyoxigraph as ox

from skillc.errors import ServiceError
from skillc.services.library.files import find_scene
from skillc.services.library.skill_descriptions import describe_skills, with_library_prefix
from skillc.services.reporting.reporter import Reporter
from skillc.services.scene.rule_reasons import RuleReason, RuleReasons
from skillc.services.scene.stores import load_world
from skillc.services.tasks.assignments import assign_goal
from skillc.services.views import scene_picture
from skillc.services.views.open_scenes import OpenScene
from skillc_compiler.emit.picture import svg
from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_model.skills import SkillLibrary
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.execution.worker_process import Died, Raised, Returned, WorkerProcess
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import load_sheets, sheet_documents
from skillc_runtime.scene.query import QueryAnswer, QueryError, run_query
from skillc_runtime.store.triples import all_triples
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.state.elements import Element, elements_of, search_elements
from skillc_runtime.world.state.names import NoSuchName, resolve_individual
from skillc_runtime.world.state.world_state import WorldState

QUERY_LIMIT_S = 60.0
"""How long the answer to a query may take."""


@dataclass(frozen=True, slots=True)
class IndividualFacts:
    """All facts about an individual: stated ones, derived classes, incoming and derived relations.

    `leading` has (subject, relation), `follows` (relation, object). `rules` says why stated ones hold that the scene
    does not state, but rules of ontologies derive.
    """

    element: Element
    classes: tuple[str, ...]
    leading: tuple[tuple[str, str], ...]
    follows: tuple[tuple[str, str], ...]
    rules: tuple[RuleReason, ...] = ()


class FactText(NamedTuple):
    """A fact in short names."""

    subject: str
    predicate: str
    value: str


class SceneDiff(NamedTuple):
    """The facts that only the first scene has, and those that only the second has; sorted."""

    removed: list[FactText]
    added: list[FactText]


def find_individuals(scene: OpenScene, words: str | None) -> tuple[Element, ...]:
    """Return the stated facts about all individuals, or about those whose names, labels, classes or texts match."""
    if words is None:
        return elements_of(scene.state, scene.individuals)
    wanted = words.casefold().split()
    labelled = {iri for iri, label in scene.labels.items() if all(word in label.casefold() for word in wanted)}
    found = ({each.iri for each in search_elements(scene.state, words)} | labelled) & scene.individuals
    if not found:
        raise ServiceError(f"no individual matches `{words}` by name, label, class or text")
    return elements_of(scene.state, found)


def describe_individuals(scene: OpenScene, names: Sequence[str]) -> list[IndividualFacts]:
    """Return all facts about individuals. ServiceError for an unknown name."""
    try:
        chosen = [resolve_individual(name, scene.state) for name in names]
    except NoSuchName as error:
        raise ServiceError(str(error)) from error
    reasons = RuleReasons(scene.document, scene.vocabulary, scene.ontologies)
    return [_describe(each, reasons) for each in elements_of(scene.state, chosen)]


def query_scene(scene: OpenScene, sparql: str) -> QueryAnswer:
    """Answer a query over the scene and the shipped ontology, in a process that can be killed.

    ServiceError if it is not valid SPARQL, cannot be answered, or takes longer than QUERY_LIMIT_S.
    """
    worker = WorkerProcess(partial(_run_query, scene))
    try:
        worker.ask(sparql)
        result = worker.wait(QUERY_LIMIT_S)
    finally:
        worker.kill()
    match result:
        case Returned(QueryAnswer() as answer):
            return answer
        case Returned(why) | Raised(why) | Died(why):
            raise ServiceError(str(why))
        case None:
            raise ServiceError(f"the query was ended after {QUERY_LIMIT_S:g} s; ask for less")


def _run_query(scene: OpenScene, sparql: str) -> QueryAnswer | str:
    """Return the answer to a query, or why there is none."""
    try:
        return query_document(scene.document, sparql, scene.library, scene.state)
    except QueryError as error:
        return str(error)


def compare_scenes(scene: OpenScene, other: Path, reporter: Reporter) -> SceneDiff:
    """Return the facts that the other scene removes and adds."""
    state = load_world(find_scene(other), scene.vocabulary, reporter)
    ours, theirs = frozenset(all_triples(scene.state)), frozenset(all_triples(state))
    return SceneDiff(_texts(ours - theirs, scene.state.vocabulary), _texts(theirs - ours, state.vocabulary))


def query_document(document: Document, sparql: str, library: SkillLibrary, state: WorldState) -> QueryAnswer:
    """Answer a query over the document of a world, the shipped ontology and the skills of a library.

    QueryError if that is not possible.
    """
    vocabulary = with_library_prefix(state.vocabulary, library)
    skills = describe_skills(library, state, sparql)
    return run_query([document, *sheet_documents()], sparql, vocabulary, skills)


def list_facts(scene: OpenScene) -> list[FactText]:
    """Return the facts that the shipped ontology does not state, in short names, sorted."""
    shipped = frozenset(all_triples(load_sheets(scene.state.vocabulary)))
    return _texts((fact for fact in all_triples(scene.state) if fact not in shipped), scene.state.vocabulary)


def describe_obstacle(scene: OpenScene, condition: str) -> str | None:
    """Return why a condition does not hold, None if it does. DiagnosticsError if the text has errors."""
    objective = assign_goal(condition, scene.library, scene.state).objective
    assert isinstance(objective, AchieveGoal), "a goal"
    if evaluate(objective.goal, scene.state, {}):
        return None
    return explain(objective.goal, scene.state, {}, scene.state.vocabulary)


def picture_scene(scene: OpenScene) -> PictureBox:
    """Return the picture of a scene."""
    title = scene.path.name if scene.path else scene.document.path
    return scene_picture.draw_boxes(scene.state, scene.individuals, scene.labels, title)


def draw_scene(scene: OpenScene, file: Path) -> None:
    """Draw the scene as an SVG file. ServiceError if it cannot be written."""
    box = picture_scene(scene)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(svg.draw_document(box), encoding="utf-8")
    except OSError as error:
        raise ServiceError(f"cannot write {file}: {error.strerror}") from error


def _describe(element: Element, reasons: RuleReasons) -> IndividualFacts:
    state, one, written = element.state, element.iri, set(element.relations)
    types = state.types(one)
    implied = ((relation, other) for relation in state.facts for other in state.objects(one, relation))
    leading = ((other, relation) for relation, links in state.asserted.items() for other in links.backward.get(one))
    return IndividualFacts(
        element,
        tuple(sorted(state.axioms.superclasses(types) - types)),
        tuple(sorted(leading)),
        tuple(sorted(pair for pair in implied if pair not in written)),
        reasons.describe(one),
    )


def _texts(facts: Iterable[ox.Triple], vocabulary: Vocabulary) -> list[FactText]:
    short = vocabulary.short
    return sorted(
        FactText(
            _text(fact.subject, vocabulary),
            "a" if fact.predicate.value == RDF_TYPE else short(fact.predicate.value),
            _text(fact.object, vocabulary),
        )
        for fact in facts
    )


def _text(node: object, vocabulary: Vocabulary) -> str:
    match node:
        case ox.NamedNode(value=iri):
            return vocabulary.short(iri)
        case ox.Literal(value=text, datatype=datatype):
            return json.dumps(text, ensure_ascii=False) if datatype.value.endswith("#string") else text
        case _:
            return str(node)
