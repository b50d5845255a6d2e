"""Writes the world of a cell as RDF, or draws it."""

from __future__ import annotations

from typing import assert_never

from skillc.cells.snapshot import CellSnapshot
from skillc.contract.jobs import WriteWorld
from skillc.contract.world import WorldText
from skillc.services.views.scene_export import export_scene
from skillc.services.views.scene_show import draw_from_above
from skillc.services.views.scenes import picture_scene, view_world
from skillc_compiler.emit.picture.svg import draw_document


def write_world(job: WriteWorld, known: CellSnapshot) -> WorldText:
    """Return the world in the format of a job; ServiceError if that cannot state a fact."""
    scene = view_world(job.cell, known.library, known.state)
    match job.format:
        case "turtle" | "rdfxml" | "jsonld" | "ntriples" | "trig":
            text = export_scene(scene, job.format, job.everything)
        case "graph":
            text = draw_document(picture_scene(scene))
        case "top-view":
            text = draw_from_above(scene)
        case _:
            assert_never(job.format)
    return WorldText(known.sequence, text)
