"""Binds the parameters of actions to individuals between which relations hold that no step changes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from itertools import chain
from typing import TypeAlias

import msgspec

from skillc_model.pddl.domain import Action, PlanningDomain, RelationMeaning
from skillc_model.pddl.formulas import Atom, Formula, conjuncts
from skillc_runtime.world.state.world_state import WorldState

MAX_STEPS = 3_000
"""The most helpful steps that are listed; where there are more, individuals are chosen by how near they are instead."""

Values: TypeAlias = dict[str, str]

_Link: TypeAlias = tuple[str, str, str]
"""A stored relation that no step changes, and between what a condition says that it holds: parameters or constants."""


class TooManySteps(Exception):
    """There are too many helpful steps to list them."""


class TypedIndividuals(msgspec.Struct, frozen=True):
    """The individuals of a problem by type, and the function that returns the type of one."""

    domain: PlanningDomain
    by_type: Mapping[str, Sequence[str]]
    type_of: Callable[[str], str]

    def of_type(self, type_: str) -> Set[str]:
        """Return all individuals of a type; TooManySteps if each of them would be a step."""
        fitting = [iris for each, iris in self.by_type.items() if self.domain.is_a(each, type_)]
        if sum(map(len, fitting)) > MAX_STEPS:
            raise TooManySteps
        return frozenset(chain.from_iterable(fitting))

    def fits(self, individual: str, type_: str) -> bool:
        """Whether an individual is of a type."""
        return self.domain.is_a(self.type_of(individual), type_)


class StaticBindings:
    """Bindings of the parameters of actions, whose `conditions` are given by name."""

    def __init__(
        self,
        domain: PlanningDomain,
        state: WorldState,
        individuals: TypedIndividuals,
        conditions: Mapping[str, Formula],
    ) -> None:
        self._domain, self._state, self._individuals = domain, state, individuals
        self._fits = individuals.fits
        self._constants = {each.name: domain.names[each.name] for each in domain.constants}
        self._links = {name: tuple(self._list_links(each)) for name, each in conditions.items()}

    def extend(self, action: Action, start: Values) -> Iterator[Values]:
        """Yield the bindings of an action's parameters that extend `start`, restricted by static relations."""
        left = {each.name: each.type for each in action.parameters if each.name not in start}
        links = self._links[action.name]
        if all(self._may_hold(link, start) for link in links):
            yield from self._bind_next(left, links, start)

    def _bind_next(self, open_: Mapping[str, str], links: Sequence[_Link], values: Values) -> Iterator[Values]:
        """Yield bindings that extend `values`, with which no link is broken; `open_` are the types of parameters."""
        if not open_:
            yield values
            return
        found = {name: self._partners(name, links, values) for name in open_}
        name = min(open_, key=lambda each: MAX_STEPS if (known := found[each]) is None else len(known))
        type_, partners = open_[name], found[name]
        rest = {each: of for each, of in open_.items() if each != name}
        concerned = [link for link in links if name in link[1:]]
        for individual in self._individuals.of_type(type_) if partners is None else partners:
            if self._fits(individual, type_):
                bound = {**values, name: individual}
                if all(self._may_hold(link, bound) for link in concerned):
                    yield from self._bind_next(rest, links, bound)

    def _list_links(self, condition: Formula) -> Iterator[_Link]:
        """Yield the atoms of a condition that are about stored relations which no step changes."""
        for atom in conjuncts(condition):
            if not isinstance(atom, Atom):
                continue
            predicate = self._domain.predicate[atom.predicate]
            if predicate.changes or not isinstance(predicate.meaning, RelationMeaning):
                continue
            relation = predicate.meaning.relation
            if not self._state.vocabulary.is_computed(relation):
                yield relation, atom.terms[0], atom.terms[1]

    def _partners(self, name: str, links: Iterable[_Link], values: Values) -> Set[str] | None:
        """Return the fewest individuals that a static relation leaves for a parameter; None if none restricts it."""
        best: Set[str] | None = None
        for relation, subject, object_ in links:
            if (subject == name) == (object_ == name):
                continue
            other = object_ if subject == name else subject
            individual = values.get(other, self._constants.get(other))
            if individual is None:
                continue
            known = (
                self._state.subjects(relation, individual)
                if subject == name
                else self._state.objects(individual, relation)
            )
            if best is None or len(known) < len(best):
                best = known
        return best

    def _may_hold(self, link: _Link, values: Values) -> bool:
        relation, subject, object_ = link
        one, other = (values.get(each, self._constants.get(each)) for each in (subject, object_))
        return one is None or other is None or self._state.holds(one, relation, other)
