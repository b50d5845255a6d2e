"""Chooses the objects of a scene that a plan probably needs: those near what the goal speaks of.

Kept are the things that the goal names, all things of which there are few (robots, arms, grippers, tools), what stands
in a relation to these with few others (the place of a thing, the arm of a robot), step by step, and for each parameter
of a skill some things of its type. A plan for these is one for the scene unless a `forall` says something about what
was left out, which running it in the world model shows. That it is the cheapest is not known, and that there is none
proves nothing: see `bound`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from heapq import nsmallest

from skillc_model.pddl.domain import GuardFact, PlanningDomain, RelationFact
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

PARTNERS = 4
"""A thing is followed to its partners in a relation where it has no more than so many."""

RANKED = 500
"""Of so many things of a type the best are chosen, the first by IRI."""


@dataclass(frozen=True, slots=True)
class AbstractionSize:
    """How much is kept: every thing of a type that has up to `few`, and no more neighbours than makes `objects`.

    A scene of up to `whole` things is planned for as a whole where a part of it does not prove that its plan is the
    shortest.
    """

    objects: int
    few: int
    whole: int = 0

    def wider(self) -> AbstractionSize:
        """Return the breadth to try next."""
        return AbstractionSize(self.objects * 8, self.few * 8, self.whole)


NARROW = AbstractionSize(40, 8, 100)

AT_ONCE = AbstractionSize(100, 8)
"""For questions that are asked once and never of a wider part."""


def select_near(
    domain: PlanningDomain,
    state: WorldState,
    by_type: Mapping[str, Sequence[str]],
    named: Iterable[str],
    breadth: AbstractionSize,
) -> frozenset[str]:
    """Return the individuals to keep, out of those of a type; the individuals of `named` are among them."""
    return _Near(domain, state, by_type, breadth).found(named)


class _Near:
    def __init__(
        self, domain: PlanningDomain, state: WorldState, by_type: Mapping[str, Sequence[str]], breadth: AbstractionSize
    ) -> None:
        self._state, self._breadth = state, breadth
        self._relations = sorted(
            {each.meaning.relation for each in domain.predicates if isinstance(each.meaning, RelationFact)}
        )
        self._guards = [
            each.meaning
            for each in domain.predicates
            if isinstance(each.meaning, GuardFact) and len(each.meaning.variables) == 1
        ]
        wanted = sorted({each.type for action in domain.actions for each in action.parameters})
        self._members = [tuple(by_type[type_] for type_ in by_type if domain.is_a(type_, each)) for each in wanted]
        self._known = frozenset().union(*by_type.values())

    def found(self, named: Iterable[str]) -> frozenset[str]:
        few = self._breadth.few
        start = set(named).union(*(each for types in self._members if sum(map(len, types)) <= few for each in types))
        kept = self._grown(start, self._breadth.objects)
        spare: set[str] = set()
        for types in self._members:
            missing = few // 2 - sum(len(kept.intersection(each)) for each in types)
            missed = (iri for each in types for iri in each if iri not in kept)
            others = nsmallest(RANKED, missed) if missing > 0 else []
            spare.update(sorted(others, key=lambda iri: (-self._rank(iri), iri))[:missing])
        return frozenset(self._grown(kept | spare, self._breadth.objects + len(spare)))

    def _grown(self, start: set[str], limit: int) -> set[str]:
        """Return what is near the start, the nearest first, until there are so many."""
        kept, ring = set(start), sorted(start)
        while ring and len(kept) < limit:
            new = {partner for each in ring for partner in self._partners(each)} - kept
            ring = sorted(new)[: limit - len(kept)]
            kept.update(ring)
        return kept

    def _partners(self, individual: str) -> Iterator[str]:
        for relation in self._relations:
            for found in (self._state.objects(individual, relation), self._state.subjects(relation, individual)):
                if len(found) <= PARTNERS:
                    yield from (each for each in found if each in self._known)

    def _rank(self, individual: str) -> int:
        """Return of how many conditions the individual is likely to be accepted."""
        linked = sum(
            bool(self._state.objects(individual, each)) + bool(self._state.subjects(each, individual))
            for each in self._relations
        )
        return linked + sum(self._fulfils(guard, individual) for guard in self._guards)

    def _fulfils(self, guard: GuardFact, individual: str) -> bool:
        try:
            return evaluate(guard.condition, self._state, {guard.variables[0]: individual})
        except EvaluationError:
            return False
