"""Exports a scene, or the world in a store, in RDF formats and as an rdflib graph."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from skillc.errors import ServiceError
from skillc.services.reporting.files import write_file
from skillc_rdf.formats.write import UnwritableError, format_as, make_graph
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import load_sheets
from skillc_runtime.scene.saving import SaveError, format_scene
from skillc_runtime.world.state.world_state import WorldState

if TYPE_CHECKING:
    from rdflib import Graph

    from skillc.services.views.open_scenes import OpenScene


def export_scene(scene: OpenScene, form: str, everything: bool = False) -> str:
    """Return a scene in a format of `format_as`, so that loading it gives the same facts.

    It has no facts of the data sheets, which are part of every world, unless `everything` is wanted. ServiceError if
    the format cannot state a fact.
    """
    source = scene.document if scene.path else None
    try:
        return format_as(form, _format_world(scene.state, scene.vocabulary, source, everything))
    except (SaveError, UnwritableError) as error:
        raise ServiceError(str(error)) from error


def world_graph(
    state: WorldState, vocabulary: Vocabulary, source: Document | None = None, everything: bool = False
) -> Graph:
    """Return a world as an rdflib graph: the facts that a scene states, or `everything`, data sheets included.

    `vocabulary` is that of the library; annotations are those of `source`, the scene that was loaded. ServiceError if
    RDF cannot state a fact.
    """
    try:
        return make_graph(_format_world(state, vocabulary, source, everything))
    except SaveError as error:
        raise ServiceError(str(error)) from error


def write_export(scene: OpenScene, form: str, file: Path, everything: bool = False) -> None:
    """Write a scene in a format of `format_as`, completely or not at all. ServiceError if it cannot be written."""
    text = export_scene(scene, form, everything)
    write_file(file, text)


def _format_world(state: WorldState, vocabulary: Vocabulary, source: Document | None, everything: bool) -> str:
    sheets = WorldState.empty(vocabulary) if everything else load_sheets(vocabulary)
    return format_scene(state, sheets, source)
