"""Finds candidates for a variable in the indexes of the relations that conditions ask of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeGuard

import msgspec

from skillc_model.conditions import Anything, Condition, Holds, Individual, Term, Variable
from skillc_runtime.world.eval.bindings import Bindings, iri_of
from skillc_runtime.world.state.world_state import WorldState


class Link(msgspec.Struct, frozen=True):
    """A relation between a searched variable and another term; `forward` if the other term is the subject."""

    relation: str
    other: Variable | Individual
    forward: bool

    def candidates(self, state: WorldState, bindings: Bindings) -> frozenset[str] | None:
        """Return the individuals for which the relation holds; None if the other term has no value yet."""
        other = iri_of(self.other, bindings)
        if other is None:
            return None
        return state.objects(other, self.relation) if self.forward else state.subjects(self.relation, other)


def find_links(parts: Iterable[Condition], variable: str) -> Iterator[Link]:
    """Yield the links of a variable in the parts of a conjunction."""
    for part in parts:
        if isinstance(part, Holds):
            if _is(part.subject, variable) and _is_other(part.object, variable):
                yield Link(part.relation, part.object, forward=False)
            if _is(part.object, variable) and _is_other(part.subject, variable):
                yield Link(part.relation, part.subject, forward=True)


def _is(term: Term, variable: str) -> bool:
    return isinstance(term, Variable) and term.name == variable


def _is_other(term: Term, variable: str) -> TypeGuard[Variable | Individual]:
    return not isinstance(term, Anything) and not _is(term, variable)
