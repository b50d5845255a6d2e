"""Relations that nobody states: they follow from other facts by a computation, such as a thing being inside another."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

from skillc_compiler.library.vocabulary import RelationTerm, local_name
from skillc_runtime.world.foreign import Unknown, called, resolve

if TYPE_CHECKING:
    from skillc_runtime.world.state import WorldState


class Reasoner(Protocol):
    """Tells whether a relation holds; vocabularies name its class, which is made without arguments."""

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Say what keeps the relation from holding, with the numbers; None when it holds.

        It is asked about individuals of the relation's domain and range only. Unknown says that too little is known,
        and then the relation does not hold; what else it raises fails the condition.
        """
        ...


class Computed:
    """A relation with the reasoner that tells whether it holds."""

    def __init__(self, term: RelationTerm, target: str) -> None:
        self._term, self._target, self._name = term, target, local_name(term.iri)

    def holds(self, state: WorldState, subject: str, object_: str) -> bool:
        """Whether the relation holds; EvaluationError when the reasoner is missing or fails."""
        return self.obstacle(state, subject, object_) is None

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Say what keeps the relation from holding, None when it holds; EvaluationError as for `holds`."""
        for each in self._term.signatures:
            if state.is_a(subject, each.domain) and state.is_a(object_, each.range):
                return called(self._asked, self._name, state, subject, object_)
        short = state.vocabulary.short
        taken = " or ".join(f"({short(each.domain)}, {short(each.range)})" for each in self._term.signatures)
        return f"{short(self._term.iri)} takes {taken}"

    def objects(self, state: WorldState, subject: str) -> frozenset[str]:
        """Return all that the subject has the relation to, by asking about each."""
        ranges = {each.range for each in self._term.signatures if state.is_a(subject, each.domain)}
        found = frozenset[str]().union(*map(state.instances, ranges))
        return frozenset(each for each in found if self.holds(state, subject, each))

    def subjects(self, state: WorldState, object_: str) -> frozenset[str]:
        """Return all that have the relation to the object, by asking about each."""
        domains = {each.domain for each in self._term.signatures if state.is_a(object_, each.range)}
        found = frozenset[str]().union(*map(state.instances, domains))
        return frozenset(each for each in found if self.holds(state, each, object_))

    def pairs(self, state: WorldState) -> Iterator[tuple[str, str]]:
        """Yield every pair of which the relation holds."""
        subjects = frozenset[str]().union(*(state.instances(each.domain) for each in self._term.signatures))
        for subject in sorted(subjects):
            yield from ((subject, object_) for object_ in sorted(self.objects(state, subject)))

    def _asked(self, state: WorldState, subject: str, object_: str) -> str | None:
        try:
            return self._reasoner.obstacle(state, subject, object_)
        except Unknown as missing:
            return str(missing)

    @cached_property
    def _reasoner(self) -> Reasoner:
        reasoner: Reasoner = resolve(self._target)()
        return reasoner
