"""Lists, searches, queries, compares and draws a scene, or the world in a store."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

import pyoxigraph as ox

from skillc.errors import DiagnosticsError, RequestError, ServiceError
from skillc.services.library.bodiless import is_bodiless
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import LibraryFiles, find_library, find_scene
from skillc.services.library.skill_descriptions import describe_skills, with_library_prefix
from skillc.services.project.loading import find_project
from skillc.services.project.project import find_root
from skillc.services.reporting.reporter import Reporter
from skillc.services.scene.diagnostics import read_scene_text, with_shown_paths
from skillc.services.scene.rule_reasons import RuleReason, RuleReasons
from skillc.services.scene.stores import StoreChoice, load_world, open_world
from skillc.services.tasks.assignments import assign_goal
from skillc.services.tasks.listing import default_library
from skillc.services.tasks.named_scenes import default_scene
from skillc.services.views import scene_picture
from skillc_compiler.emit.picture import svg
from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_dsl.source import Source
from skillc_model.declared import act_as_declared
from skillc_model.skills import SkillLibrary
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.execution.worker_process import Died, Raised, Returned, WorkerProcess
from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.scene.load import load_sheets, read_with_sheets, sheet_documents
from skillc_runtime.scene.query import QueryAnswer, QueryError, run_query
from skillc_runtime.scene.statements import read_contents
from skillc_runtime.store.triples import all_triples
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.state.elements import Element, elements_of, search_elements
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.names import NoSuchName, resolve_individual
from skillc_runtime.world.state.world_state import WorldState

QUERY_LIMIT_S = 60.0
"""How long the answer to a query may take."""


@dataclass(frozen=True, slots=True)
class OpenScene:
    """A scene's document, its world, the labels of individuals, and the individuals that are listed by default.

    `path` is None if the world comes from a store; `library` is that whose terms it uses, beside shipped ones those of
    `ontologies`. `world` can be written to; `state` is its version when it was opened.
    """

    path: Path | None
    library: SkillLibrary
    world: WorldModel
    document: Document
    state: WorldState
    labels: dict[str, str]
    individuals: frozenset[str]
    ontologies: tuple[Source, ...] = ()

    @property
    def vocabulary(self) -> Vocabulary:
        """The vocabulary of the library."""
        return self.library.vocabulary

    def at_present(self) -> OpenScene:
        """Return it with the present version of its world."""
        state = self.world.snapshot()
        if state is self.state:
            return self
        own = (self.individuals | (state.individuals - self.state.individuals)) & state.individuals
        return replace(self, state=state, document=describe_state(self.document.path, state), individuals=own)


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


@contextmanager
def open_scene(
    scene: Path | None, library: Path | None, store: StoreChoice, everything: bool, reporter: Reporter
) -> Iterator[OpenScene]:
    """Open a scene file, a shipped scene or the world in a store; errors as `open_world`.

    The terms are those of `library`, else of the library in the scene's folder, else of the shipped library. With
    `everything`, the individuals of the shipped data sheets are listed too.
    """
    path = find_scene(scene) if scene is not None else None if store.place else _scene_here()
    compiled, files = _compile_library(library, path)
    with open_world(store, path, compiled.vocabulary, reporter) as world:
        state = world.snapshot()
        document = Document.read(path) if path and not store.place else describe_state(store.name, state)
        own = read_contents([document]).subjects & state.individuals
        labels = {**read_contents(sheet_documents()).labels, **read_contents([document]).labels}
        meant = state.individuals if everything else own
        yield OpenScene(path, compiled, world, document, state, labels, meant, files.vocabularies)


def read_to_mend(scene: Path, library: Path | None, reporter: Reporter) -> tuple[Path, WorldState]:
    """Return the path of a scene file and its world, as far as it is understood if the scene has errors.

    Its warnings are reported, its errors are not: an edit may mend them. Other errors as `open_scene`.
    """
    path = find_scene(scene)
    vocabulary = _compile_library(library, path)[0].vocabulary
    try:
        return path, load_world(path, vocabulary, reporter)
    except DiagnosticsError:
        try:
            return path, read_with_sheets(Document.read(path), vocabulary).state
        except SceneError as error:
            raise DiagnosticsError(with_shown_paths(error.problems), read_scene_text(path)) from error


def _compile_library(library: Path | None, scene: Path | None) -> tuple[SkillLibrary, LibraryFiles]:
    """Compile a library, else that in the folder of a scene, else the shipped one; return it and its files.

    Where no task has bodies, skills act as declared, and scenes need not state what bodies need.
    """
    named = library or _library_beside(scene)
    files = find_library(named) if named else default_library()
    compiled = compile_valid(files)
    bodiless = is_bodiless((each.backend for each in compiled.tasks.values()), files.is_symbolic)
    return (act_as_declared(compiled) if bodiless else compiled), files


def view_world(name: str, library: SkillLibrary, state: WorldState) -> OpenScene:
    """Return a version of a world as an open scene of a name."""
    document = describe_state(name, state)
    own = read_contents([document]).subjects & state.individuals
    return OpenScene(None, library, WorldModel(state), document, state, read_contents(sheet_documents()).labels, own)


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


def _scene_here() -> Path:
    """Return the default scene of the project here; RequestError if there is none."""
    project = find_project(Path())
    scene = default_scene(project) if project else None
    if scene is None:
        raise RequestError("name a SCENE, or the world in a store with --store")
    return scene


def _library_beside(scene: Path | None) -> Path | None:
    """Return the folder of a scene if it is a library or in a project, else None."""
    if scene is None:
        return None
    return scene.parent if any(scene.parent.glob("*.skill")) or find_root(scene.parent) else None


def describe_state(place: str, state: WorldState) -> Document:
    """Return a document of the facts of a world that the shipped ontology does not state."""
    shipped = frozenset(all_triples(load_sheets(state.vocabulary)))
    return Document(place, "".join(sorted(f"{fact} .\n" for fact in all_triples(state) if fact not in shipped)))


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
