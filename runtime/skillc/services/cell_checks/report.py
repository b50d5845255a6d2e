"""Says what is wrong in a cell: as diagnostics at its statements, or as the reason why a task does not start."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TypeAlias

import msgspec

from skillc.services.cell_checks.checks import check_cell
from skillc.services.scene_diagnostics import with_shown_path
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_model.conditions import Exists, Forall, Individual
from skillc_model.traversal import walk
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.scene.load import Scene
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.world_state import WorldState

Places: TypeAlias = dict[tuple[str, str], Statement]
"""The first statement of each subject and predicate."""


def cell_diagnostics(scene: Scene, path: str, used: frozenset[str]) -> Iterator[Diagnostic]:
    """Yield what is wrong in the cell of a scene file at `path`; `used` are the individuals that tasks name."""
    places = _places(scene.said, path)
    for violation in graded(check_cell(scene.state), used):
        if (violation.individual, RDF_TYPE) in places:
            yield _diagnostic(violation, places)


def graded(found: Iterable[SceneViolation], used: frozenset[str]) -> Iterator[SceneViolation]:
    """Yield violations as they concern tasks that use some individuals: those of other individuals are warnings."""
    for each in found:
        concerns = not used.isdisjoint((each.individual, *each.others))
        yield each if concerns else replace(each, severity="warning")


def used_individuals(item: msgspec.Struct, state: WorldState) -> frozenset[str]:
    """Return the individuals that a goal or a body names, and those of the classes over which it quantifies."""
    found = set[str]()
    for each in walk(item):
        match each:
            case Individual(iri):
                found.add(iri)
            case Exists(cls=cls) | Forall(cls=cls):
                found |= state.instances(cls)
            case _:
                pass
    return frozenset(found)


def _places(said: Iterable[Statement], path: str) -> Places:
    places: Places = {}
    for each in said:
        if each.lines.path == path:
            places.setdefault((iri_of(each.subject), each.predicate), each)
    return places


def _diagnostic(violation: SceneViolation, places: Places) -> Diagnostic:
    typed = places[violation.individual, RDF_TYPE]
    statement = places.get((violation.individual, violation.predicate or RDF_TYPE), typed)
    span = typed.subject_place if statement is typed else statement.object_place
    others = [place.subject_place for each in violation.others if (place := places.get((each, RDF_TYPE)))]
    labels = tuple(Label(with_shown_path(place), "this one") for place in others)
    return Diagnostic(
        violation.name, with_shown_path(span), violation.message, violation.help, violation.severity, labels
    )
