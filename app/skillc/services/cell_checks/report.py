"""Reports what is wrong in a cell at the statements of its scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec
from msgspec.structs import replace

from skillc.services.cell_checks.verdicts import judge_cell
from skillc.services.scene.diagnostics import with_shown_path
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span
from skillc_model.conditions import Condition, Exists, Forall, Individual
from skillc_model.traversal import walk
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.scene.load import LoadedScene
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.eval.obstacles import RelationObstacle
from skillc_runtime.world.state.world_state import WorldState


class ScenePlaces(msgspec.Struct, frozen=True):
    """Where a scene file states something: the first statement of each subject and predicate."""

    statements: dict[tuple[str, str], Statement]

    @staticmethod
    def of(said: Iterable[Statement], path: str) -> ScenePlaces:
        """Return those of the statements in the file at `path`."""
        found: dict[tuple[str, str], Statement] = {}
        for each in said:
            if each.lines.path == path:
                found.setdefault((iri_of(each.subject), each.predicate), each)
        return ScenePlaces(found)

    def name_of(self, individual: str) -> Span | None:
        """Return where the class of an individual is stated, None if not in this file."""
        typed = self.statements.get((individual, RDF_TYPE))
        return None if typed is None else with_shown_path(typed.subject_place)

    def find(self, violation: SceneViolation) -> Span | None:
        """Return where the wrong fact is stated, else where the class of the individual is."""
        statement = self.statements.get((violation.individual, violation.predicate or ""))
        return self.name_of(violation.individual) if statement is None else with_shown_path(statement.object_place)


WHOLE_CELL = ("impossible-body", "starts-inside")
"""The problems because of which no task can be simulated in the cell, whatever it uses."""


class CellProblem(msgspec.Struct, frozen=True):
    """Something that is wrong in a cell, and how it is reported."""

    violation: SceneViolation
    diagnostic: Diagnostic

    def explains(self, obstacle: RelationObstacle) -> bool:
        """Whether it is why a computed relation does not hold."""
        return (self.violation.prevents, self.violation.individual) == (obstacle.relation, obstacle.object)


def cell_diagnostics(
    scene: LoadedScene, path: str, used: frozenset[str], goals: Sequence[Condition] = ()
) -> Iterator[Diagnostic]:
    """Yield the diagnostics of what is wrong in the cell of a scene file at `path`.

    `used` are the individuals that tasks name, `goals` those of the tasks.
    """
    for each in locate(grade(judge_cell(scene, goals), used), ScenePlaces.of(scene.said, path)):
        yield each.diagnostic


def grade(found: Iterable[SceneViolation], used: frozenset[str]) -> Iterator[SceneViolation]:
    """Yield violations as they concern tasks that use some individuals: those of other individuals are warnings."""
    for each in found:
        concerns = each.name in WHOLE_CELL or not used.isdisjoint((each.individual, *each.others))
        yield each if concerns else replace(each, severity="warning")


def locate(found: Iterable[SceneViolation], places: ScenePlaces) -> Iterator[CellProblem]:
    """Yield the violations of individuals in a scene file with their diagnostics, which have labels at the others."""
    for each in found:
        span = places.find(each)
        if span is not None:
            names = filter(None, map(places.name_of, each.others))
            labels = tuple(Label(name, "this one") for name in names)
            yield CellProblem(each, Diagnostic(each.name, span, each.message, each.help, each.severity, labels))


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
