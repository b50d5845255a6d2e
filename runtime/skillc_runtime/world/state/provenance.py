"""Where facts come from: data sheets of devices, the scene file, the run, or axioms."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.world.state.facts import IriTriple
from skillc_runtime.world.state.world_state import WorldState


class FactSource(Enum):
    """Where a fact comes from."""

    ROBOT = "robot"
    SCENE = "scene"
    RUN = "run"
    INFERRED = "inferred"


@dataclass(frozen=True, slots=True, eq=False)
class Provenance:
    """Finds the source of facts, from the world of the data sheets alone and the world of scene and data sheets."""

    sheets: WorldState
    scene: WorldState

    def of_relation(self, state: WorldState, subject: str, relation: str, object_: str) -> FactSource | None:
        """Return the source of a relation between two individuals, by IRI; None when it does not hold."""
        if not state.holds(subject, relation, object_):
            return None
        if object_ not in state.asserted[relation].forward.get(subject):
            return FactSource.INFERRED
        for version, source in self._versions():
            if object_ in version.asserted[relation].forward.get(subject):
                return source
        return FactSource.RUN

    def of_class(self, state: WorldState, individual: str, cls: str) -> FactSource | None:
        """Return the source of an individual's class; None when it is not of the class."""
        if not state.is_a(individual, cls):
            return None
        if cls not in state.types(individual):
            return FactSource.INFERRED
        found = (source for version, source in self._versions() if cls in version.types(individual))
        return next(found, FactSource.RUN)

    def relations(self, state: WorldState, wanted: FactSource) -> Iterator[IriTriple]:
        """Yield the relations and classes that come from a source, sorted: subject, predicate and object."""
        links = (
            (subject, relation, object_)
            for relation in sorted(state.facts)
            for subject, object_ in sorted(state.pairs(relation))
        )
        yield from (fact for fact in links if self.of_relation(state, *fact) is wanted)
        classes = ((one, cls) for one, found in sorted(state.classes.items()) for cls in sorted(found))
        yield from ((one, RDF_TYPE, cls) for one, cls in classes if self.of_class(state, one, cls) is wanted)

    def _versions(self) -> tuple[tuple[WorldState, FactSource], ...]:
        return ((self.sheets, FactSource.ROBOT), (self.scene, FactSource.SCENE))
