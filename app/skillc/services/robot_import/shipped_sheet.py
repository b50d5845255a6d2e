"""Reads the numbers of the data sheet of a shipped arm, which a new arm takes where its model states none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import pyoxigraph as ox

from skillc.errors import RequestError
from skillc.services.robot_import.mjcf_writer import ControlKind
from skillc.services.robot_import.sheet_writer import CLASSES
from skillc_dsl.spelling import did_you_mean
from skillc_ontology import catalogue
from skillc_runtime.world.state.terms import ARM_SHEET, SKILLC

_TYPE = ox.NamedNode("http://www.w3.org/1999/02/22-rdf-syntax-ns#type")
_SUBCLASS = ox.NamedNode("http://www.w3.org/2000/01/rdf-schema#subClassOf")


@dataclass(frozen=True, slots=True)
class ShippedSheet:
    """The values on the data sheet of a shipped arm, by the name of the property, and how it is controlled."""

    name: str
    values: Mapping[str, str]
    control: ControlKind


def read_shipped_sheet(name: str) -> ShippedSheet:
    """Return the data sheet of a shipped arm, such as `ur5e`. RequestError if there is no such arm."""
    folder = catalogue.ROOT / "robots"
    known = sorted(path.stem for path in folder.glob("*.xml"))
    if name not in known:
        raise RequestError(f"there is no robot `{name}`; {did_you_mean(name, known)}")
    graph = ox.Store()
    graph.load(path=str(folder / f"{name}.ttl"), format=ox.RdfFormat.TURTLE)
    (sheet,) = (quad.subject for quad in graph.quads_for_pattern(None, _TYPE, ox.NamedNode(ARM_SHEET)))
    values = {
        quad.predicate.value.removeprefix(SKILLC): quad.object.value
        for quad in graph.quads_for_pattern(sheet, None, None)
        if isinstance(quad.object, ox.Literal)
    }
    above = (quad.object for quad in graph.quads_for_pattern(None, _SUBCLASS, None))
    classes = {each.value.removeprefix(SKILLC) for each in above if isinstance(each, ox.NamedNode)}
    control = next(kind for kind, cls in CLASSES.items() if cls in classes)
    return ShippedSheet(name, values, control)
