"""Opens scenes, and worlds in stores, with the library whose terms they use."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from skillc.errors import DiagnosticsError, RequestError
from skillc.services.library.bodiless import is_bodiless
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import LibraryFiles, find_library, find_scene
from skillc.services.project.loading import find_project
from skillc.services.project.project import find_root
from skillc.services.reporting.reporter import Reporter
from skillc.services.scene.diagnostics import read_scene_text, with_shown_paths
from skillc.services.scene.stores import StoreChoice, load_world, open_world
from skillc.services.tasks.listing import default_library
from skillc.services.tasks.named_scenes import default_scene
from skillc_dsl.source import Source
from skillc_model.declared import act_as_declared
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.scene.load import load_sheets, read_with_sheets, sheet_documents
from skillc_runtime.scene.statements import read_contents
from skillc_runtime.store.triples import all_triples
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState


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
