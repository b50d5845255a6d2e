"""Relations that are computed from other facts instead of stated, such as one object being inside another."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from functools import cached_property
from typing import Protocol, TypeVar

from skillc_rdf.vocabulary.types import RelationTerm, Vocabulary, local_name
from skillc_runtime.world.state.python_calls import InsufficientFacts, call_python, load_python

State = TypeVar("State", contravariant=True)


class ClassIndex(Protocol):
    """The classes of individuals in a version of the world."""

    @property
    def vocabulary(self) -> Vocabulary:
        """The terms of the world."""
        ...

    def is_a(self, individual: str, cls: str) -> bool:
        """Whether the individual is of the class or of a subclass."""
        ...

    def instances(self, cls: str) -> frozenset[str]:
        """Return all individuals of a class and its subclasses."""
        ...


class Reasoner(Protocol[State]):
    """Decides whether a relation holds in a `State`, a version of the world.

    Vocabularies name the class, which is instantiated without arguments.
    """

    def obstacle(self, state: State, subject: str, object_: str) -> str | None:
        """Return why the relation does not hold, with the numbers; None when it holds.

        It is called with individuals of the relation's domain and range only. InsufficientFacts means that too little
        is known, and the relation does not hold; any other exception fails the condition.
        """
        ...


class ComputedRelation(ABC):
    """A relation that follows from facts."""

    def __init__(self, term: RelationTerm) -> None:
        self._term = term

    def holds(self, state: ClassIndex, subject: str, object_: str) -> bool:
        """Whether the relation holds; EvaluationError when the reasoner is missing or fails."""
        return self.obstacle(state, subject, object_) is None

    def obstacle(self, state: ClassIndex, subject: str, object_: str) -> str | None:
        """Return why the relation does not hold; None when it holds. EvaluationError as for `holds`."""
        if self.takes(state, subject, object_):
            return self._ask(state, subject, object_)
        short = state.vocabulary.short
        taken = " or ".join(f"({short(each.domain)}, {short(each.range)})" for each in self._term.signatures)
        return f"{short(self._term.iri)} takes {taken}"

    def takes(self, state: ClassIndex, subject: str, object_: str) -> bool:
        """Whether the two are of the relation's domain and range."""
        return any(
            state.is_a(subject, each.domain) and state.is_a(object_, each.range) for each in self._term.signatures
        )

    def objects(self, state: ClassIndex, subject: str) -> frozenset[str]:
        """Return all individuals that the subject has the relation to; asks the reasoner about each candidate."""
        ranges = {each.range for each in self._term.signatures if state.is_a(subject, each.domain)}
        found = frozenset[str]().union(*map(state.instances, ranges))
        return frozenset(each for each in found if self.holds(state, subject, each))

    def subjects(self, state: ClassIndex, object_: str) -> frozenset[str]:
        """Return all individuals that have the relation to the object; asks the reasoner about each candidate."""
        domains = {each.domain for each in self._term.signatures if state.is_a(object_, each.range)}
        found = frozenset[str]().union(*map(state.instances, domains))
        return frozenset(each for each in found if self.holds(state, each, object_))

    def pairs(self, state: ClassIndex) -> Iterator[tuple[str, str]]:
        """Yield every pair for which the relation holds."""
        subjects = frozenset[str]().union(*(state.instances(each.domain) for each in self._term.signatures))
        for subject in sorted(subjects):
            yield from ((subject, object_) for object_ in sorted(self.objects(state, subject)))

    @abstractmethod
    def _ask(self, state: ClassIndex, subject: str, object_: str) -> str | None:
        """Return as `obstacle` for individuals of the domain and range."""


class ReasonedRelation(ComputedRelation):
    """A relation with the reasoner that decides whether it holds."""

    def __init__(self, term: RelationTerm, target: str) -> None:
        super().__init__(term)
        self._target, self._name = target, local_name(term.iri)

    def _ask(self, state: ClassIndex, subject: str, object_: str) -> str | None:
        return call_python(self._reason, self._name, state, subject, object_)

    def _reason(self, state: ClassIndex, subject: str, object_: str) -> str | None:
        try:
            return self._reasoner.obstacle(state, subject, object_)
        except InsufficientFacts as missing:
            return str(missing)

    @cached_property
    def _reasoner(self) -> Reasoner[ClassIndex]:
        reasoner: Reasoner[ClassIndex] = load_python(self._target)()
        return reasoner
