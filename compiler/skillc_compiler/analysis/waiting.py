"""Waiting for something that others than the body may bring about."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.forgetting import forgotten
from skillc_compiler.analysis.learning import learned
from skillc_compiler.analysis.sorts import Sorts, some
from skillc_compiler.analysis.state import State
from skillc_compiler.analysis.writes import Related, Valued, Write
from skillc_model.conditions import Condition, HasProperty, Holds, Individual, PropertyOf, Variable
from skillc_model.reading import walk
from skillc_rdf.vocabulary.types import THING


def awaited(sorts: Sorts, state: State, condition: Condition) -> State:
    """Return the state once the condition holds; what it depends on may have been changed from outside meanwhile."""
    known = learned(sorts, state, condition)
    if known is not None:
        return known
    changed = forgotten(sorts, state, _read(condition))
    return learned(sorts, changed, condition) or changed


def _read(condition: Condition) -> Iterator[Write]:
    anything = some(THING)
    for part in walk(condition):
        match part:
            case Holds(subject=subject, relation=relation, object=object_):
                yield Related(subject, relation, object_, None)
            case HasProperty(subject=of, property=iri):
                yield Valued(of, iri, None)
            case PropertyOf(of=of, property=iri):
                yield Valued(of if isinstance(of, Variable | Individual) else anything, iri, None)
