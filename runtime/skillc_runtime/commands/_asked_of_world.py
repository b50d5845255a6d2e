"""What `skillc world` can be asked, each question a function of the opened world."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from skillc_compiler.emit.picture import svg
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.commands import _files, _library, _listing, _mission, _world_diff, _world_edit, _world_graph
from skillc_runtime.commands import _world_show as _show
from skillc_runtime.commands._keeping import NOT_KEPT, Keeping
from skillc_runtime.scene.contents import read_contents
from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.scene.query import QueryError
from skillc_runtime.world.state.names import NoSuchName, individual_of
from skillc_runtime.world.state.world_state import WorldState


class NoAnswer(Exception):
    """A question that has no answer; the message says why."""


@dataclass(frozen=True, slots=True)
class World:
    """A scene as it was written, its world, and the individuals that are meant if none is named."""

    path: Path | None
    library: SkillLibrary
    document: Document
    state: WorldState
    meant: frozenset[str]


def open_world(scene: Path | None, library: Path | None, keeping: Keeping, everything: bool) -> World:
    """Load a scene, or what a store keeps; exit with what is wrong with it."""
    path = None if scene is None else _files.scene_path(scene)
    compiled = _mission.compiled(_library.find(library or _beside(path) or _library.SHIPPED / "wiping"))
    state = _mission.world_for(keeping, path, compiled).snapshot()
    document = Document.read(path) if path and not keeping.place else _listing.kept(keeping.name, state)
    own = read_contents([document]).subjects & state.individuals
    return World(path, compiled, document, state, state.individuals if everything else own)


def _beside(scene: Path | None) -> Path | None:
    """Return the folder of a scene where it is a library too."""
    return scene.parent if scene is not None and any(scene.parent.glob("*.skill")) else None


def listed(world: World, words: str | None, as_json: bool) -> str:
    """List the individuals, or those in which words occur."""
    labels = _listing.labels_of(world.document)
    chosen = world.meant if words is None else _show.found(world.state, labels, words, world.meant)
    if not chosen and words is not None:
        raise NoAnswer(f"nothing in the scene is called, or of a class called, or says `{words}`")
    return _listing.listed(world.state, labels, chosen, as_json)


def show(world: World, names: Sequence[str], as_json: bool) -> str:
    """Show all there is to know of individuals."""
    try:
        chosen = [individual_of(name, world.state) for name in names]
    except NoSuchName as error:
        raise NoAnswer(str(error)) from error
    return _show.shown(world.state, _listing.labels_of(world.document), chosen, as_json)


def answer(world: World, sparql: str, as_json: bool) -> str:
    """Answer a query."""
    try:
        return _listing.answer(world.document, sparql, world.state, as_json)
    except QueryError as error:
        raise NoAnswer(str(error)) from error


def compare(world: World, other: Path, as_json: bool) -> str:
    """Return what the other scene takes away and adds."""
    state = _mission.world_for(NOT_KEPT, _files.scene_path(other), world.library).snapshot()
    return _world_diff.differences(world.state, state, as_json)


def draw(world: World, file: Path) -> Path:
    """Draw the scene into a file."""
    title = world.path.name if world.path else world.document.path
    box = _world_graph.picture(world.state, world.meant, _listing.labels_of(world.document), title)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(svg.document(box), encoding="utf-8")
    except OSError as error:
        raise NoAnswer(f"cannot write {file}: {error.strerror}") from error
    return file


def edit(world: World, edits: Sequence[str]) -> str:
    """Edit the scene's file and say so; exit with what would be wrong with it."""
    assert world.path is not None
    try:
        return _world_edit.edit(world.path, world.state, edits)
    except _world_edit.EditError as error:
        raise NoAnswer(str(error)) from error
    except SceneError as error:
        _world_edit.tell(error, world.path)
        sys.exit(1)
