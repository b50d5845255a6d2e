"""Scenes: their world is read, queried and edited, and tasks are planned and run in it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Unpack

from msgspec import structs

from skillc.api.boundary import NoticeList, api_call, refusing_values
from skillc.api.picture import Picture
from skillc.api.planning import Plan, PlanKeywords, make_plan
from skillc.api.table import QueryResult
from skillc.errors import RequestError
from skillc.services.reporting.files import writing_to
from skillc.services.scene.stores import StoreChoice
from skillc.services.tasks.assignments import assign_call, assign_goal
from skillc.services.tasks.loading import LoadedTask, with_always
from skillc.services.views import open_scenes, scenes
from skillc.services.views.scene_export import world_graph
from skillc.services.views.scenes import FactText
from skillc.values.arguments import AnyPath, optional_path, require_path, require_text
from skillc.values.keywords import read_keywords
from skillc.values.run_keywords import SceneRunKeywords, SceneStartKeywords
from skillc_compiler.emit.picture import mermaid, svg
from skillc_dsl.diagnostics import Diagnostic
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.types import THING
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.scene.load import load_sheets
from skillc_runtime.scene.saving import save_scene
from skillc_runtime.world.state.elements import Element, find_element, find_elements, search_elements
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.open_transaction import OpenTransaction
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

if TYPE_CHECKING:
    from rdflib import Graph

    from skillc.api.operation import Operation
    from skillc.api.run import Run


@dataclass(frozen=True, slots=True)
class Answer:
    """Whether a condition holds, as its truth value; `why` says why it does not, empty if it does."""

    holds: bool
    why: str = ""

    def __bool__(self) -> bool:
        return self.holds


class Scene:
    """A scene, or the world in a store, and its world model; notebooks show its picture.

    Names are IRIs or `prefix:name`. A store is closed by `close`, or at the end of a `with` statement.
    """

    def __init__(self, opened: open_scenes.OpenScene, stack: ExitStack, warnings: tuple[Diagnostic, ...]) -> None:
        self._opened, self._stack = opened, stack
        self._folders = catalogue.user_folders()
        self.warnings = warnings

    def __repr__(self) -> str:
        return f"Scene({self.name!r})"

    def __enter__(self) -> Scene:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close its store, if it has one."""
        self._stack.close()

    @property
    def name(self) -> str:
        """The name of its file, or its store."""
        return self._opened.path.name if self._opened.path else self._opened.document.path

    @property
    def world(self) -> WorldModel:
        """Its world model, for what this class has no method for."""
        return self._opened.world

    @property
    def state(self) -> WorldState:
        """The present version of its world, which never changes."""
        return self._opened.world.snapshot()

    @property
    def facts(self) -> list[FactText]:
        """The facts that the data sheets and vocabularies do not state, as subject, predicate and value, sorted."""
        with api_call(self._folders):
            return scenes.list_facts(self._opened.at_present())

    def __getitem__(self, name: str) -> Element:
        """Return the individual of that name. RequestError suggests existing ones."""
        with api_call():
            return find_element(self.state, require_text(name, "the name"))

    def find(
        self, cls: str = THING, related: Mapping[str, str] | None = None, having: Mapping[str, Value] | None = None
    ) -> tuple[Element, ...]:
        """Return the individuals of a class that have these relations to individuals, and these values of properties.

        RequestError for an unknown name.
        """
        with api_call():
            return find_elements(self.state, require_text(cls, "the class"), related, having)

    def search(self, words: str) -> tuple[Element, ...]:
        """Return the individuals whose names, classes and texts contain all the words."""
        with api_call():
            return search_elements(self.state, require_text(words, "the words"))

    def query(self, sparql: str) -> QueryResult:
        """Answer a SPARQL query; the prefixes of the vocabulary are declared.

        It sees the statements of the scene, the data sheets and the vocabulary, and the descriptions of the library's
        skills, without inference. SkillcError if it is not valid, or takes too long.
        """
        with api_call(self._folders):
            result = scenes.query_scene(self._opened.at_present(), require_text(sparql, "the query"))
        return QueryResult(result.columns, result.rows)

    def ask(self, condition: str) -> Answer:
        """Return whether a condition holds, and why not. DiagnosticsError if its text has errors."""
        with api_call(self._folders):
            why = scenes.describe_obstacle(self._opened.at_present(), require_text(condition, "the condition"))
        return Answer(why is None, why or "")

    @contextmanager
    def edit(self, who: str, why: str) -> Iterator[OpenTransaction]:
        """Collect writes in a `with` statement and make them together at its end; none if it raises.

        `who` and `why` are recorded with them. RequestError if an axiom is violated or a name is unknown.
        """
        origin = f"{require_text(who, '`who`')}: {require_text(why, '`why`')}"
        with api_call(self._folders), refusing_values(), self.world.transaction(origin) as transaction:
            yield transaction

    def undo(self) -> None:
        """Undo the last edit. RequestError if there is none."""
        with api_call(self._folders):
            self.world.undo()

    def graph(self) -> Graph:
        """Return its facts, without the data sheets and vocabularies, as an rdflib graph."""
        with api_call(self._folders):
            source = self._opened.document if self._opened.path else None
            return world_graph(self.state, self._opened.vocabulary, source)

    def save(self, path: AnyPath) -> Path:
        """Write the scene as Turtle, with its labels and templates, and return the path of the file.

        The file is written completely or not at all; SkillcError if that is not possible.
        """
        file = require_path(path, "the file")
        source = self._opened.document if self._opened.path else None
        with api_call(self._folders), writing_to(file.parent):
            save_scene(self.state, file, load_sheets(self._opened.vocabulary), source)
        return file

    def draw(self) -> Picture:
        """Return its picture: boxes show what holds what, their lines the other relations."""
        with api_call(self._folders):
            box = scenes.picture_scene(self._opened.at_present())
        return Picture(self.name, svg.draw_document(box), mermaid.draw(box))

    def plan(self, goal: str, **settings: Unpack[PlanKeywords]) -> Plan:
        """Plan for a goal in the world as it is now; parameters and errors as of `skillc.plan`."""
        with api_call(self._folders):
            return make_plan(self._load(require_text(goal, "the goal"), None), **settings)

    def start(self, goal: str | None = None, **settings: Unpack[SceneStartKeywords]) -> Operation:
        """Start a goal or a skill call in a copy of the world as it is now; parameters and errors as of `skillc.start`.

        The world of this scene stays as it is.
        """
        return self._start(goal, settings, SceneStartKeywords)

    def run(self, goal: str | None = None, **settings: Unpack[SceneRunKeywords]) -> Run:
        """Run a goal or a skill call in a copy of the world as it is now, and return how it ended; as `start`."""
        operation = self._start(goal, settings, SceneRunKeywords)
        return operation.wait()  # wait ends: with the run, which has a deadline, or by an interrupt

    def _start(self, goal: str | None, settings: Mapping[str, Any], known: type) -> Operation:
        from skillc.api.running import begin_loaded, make_options

        with api_call(self._folders):
            spec = structs.replace(read_keywords(RunSpec, settings, known), goal=goal)
            loaded = with_always(self._load(goal, spec.call), spec.always)
            operation = begin_loaded(loaded, make_options(spec))
        if spec.step:
            operation.wait_for_pause()
        return operation

    def _load(self, goal: str | None, call: str | None) -> LoadedTask:
        if (goal is None) == (call is None):
            raise RequestError("name either a goal or a skill call")
        state, library = self.state, self._opened.library
        assignment = (
            assign_call(require_text(call, "the skill call"), library, state)
            if goal is None
            else assign_goal(require_text(goal, "the goal"), library, state)
        )
        return LoadedTask(library, assignment, WorldModel(state))

    def _repr_svg_(self) -> str:
        return self.draw().svg


def open_scene(scene: AnyPath | None = None, *, library: AnyPath | None = None, store: str | None = None) -> Scene:
    """Open a scene file, a shipped scene by its name, or the world in a store, which is filled with the scene.

    Without a scene it is that of the project here. Its terms are those of `library`, else of the library beside it,
    else of the shipped library. DiagnosticsError if it has errors, RequestError if there is none.
    """
    notes, stack = NoticeList(), ExitStack()
    with api_call(), stack:
        where = optional_path(scene, "the scene")
        named = optional_path(library, "the library")
        opened = stack.enter_context(open_scenes.open_scene(where, named, StoreChoice(store), False, notes))
        return Scene(opened, stack.pop_all(), tuple(notes.warnings))
