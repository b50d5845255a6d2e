"""Where facts come from: the data sheets of devices, the scene file, what happened since, or what follows by axioms."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.world.state.axiom_violations import IriTriple
from skillc_runtime.world.state.values import Value, has_value
from skillc_runtime.world.state.world_state import WorldState


class FactSource(Enum):
    """Who says that a fact is true."""

    ROBOT = "robot"
    SCENE = "scene"
    RUN = "run"
    INFERRED = "inferred"


@dataclass(frozen=True, slots=True, eq=False)
class Provenance:
    """The two versions that a world began with: that of the data sheets alone, and that of the scene beside them."""

    sheets: WorldState
    scene: WorldState

    def of_relation(self, state: WorldState, subject: str, relation: str, object_: str) -> FactSource | None:
        """Return where a relation between two individuals comes from, all by IRI; None when it does not hold."""
        if not state.holds(subject, relation, object_):
            return None
        if object_ not in state.asserted[relation].forward.get(subject):
            return FactSource.INFERRED
        for version, context in self._versions():
            if object_ in version.asserted[relation].forward.get(subject):
                return context
        return FactSource.RUN

    def of_class(self, state: WorldState, individual: str, cls: str) -> FactSource | None:
        """Return where it comes from that an individual is of a class; None when it is not."""
        if not state.is_a(individual, cls):
            return None
        if cls not in state.types(individual):
            return FactSource.INFERRED
        found = (context for version, context in self._versions() if cls in version.types(individual))
        return next(found, FactSource.RUN)

    def of_value(self, state: WorldState, individual: str, property_: str, value: Value) -> FactSource | None:
        """Return where the value of a property comes from, one of several if it has several; None when it is not."""
        if not has_value(state.value(individual, property_), value):
            return None
        found = (
            context for version, context in self._versions() if has_value(version.value(individual, property_), value)
        )
        return next(found, FactSource.RUN)

    def relations(self, state: WorldState, wanted: FactSource) -> Iterator[IriTriple]:
        """Yield the relations and classes that come from there, sorted: subject, predicate and object."""
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
