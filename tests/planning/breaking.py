"""Cells that have a plan, with exactly one fact taken out without which there is none; and what is said about them."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from dataclasses import dataclass

from skillc_compiler.goals.parsing import parse_goal
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.planning.plan import Unsolvable
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.changes import ClearProperty, RemoveRelation
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Broken:
    """What was taken out of a world, and the first of the reasons why there is no plan."""

    names: tuple[str, ...]
    term: str
    state: WorldState
    says: str

    @property
    def is_named(self) -> bool:
        """Whether an individual of the fact is named."""
        return any(re.search(rf"{re.escape(local_name(each))}\b", self.says) for each in self.names)

    @property
    def claims(self) -> tuple[str, ...]:
        """The relations that are said not to hold."""
        return tuple(re.findall(r"`([^`]*)`, which does not hold", self.says))

    def is_claimed_wrongly(self, library: SkillLibrary) -> bool:
        """Whether something that is said not to hold does hold."""
        individuals = {each: tuple(self.state.types(each)) for each in self.state.individuals}
        parsed = (parse_goal(each, library.vocabulary, individuals).value for each in self.claims)
        return any(each is not None and evaluate(each, self.state, {}) for each in parsed)


def break_one(library: SkillLibrary, state: WorldState, goal: Condition, seed: int, most: int) -> Iterator[Broken]:
    """Yield worlds without a plan: each fact is taken out alone, in random order, until there are `most`."""
    changes = list(_takings(state))
    random.Random(seed).shuffle(changes)
    found = 0
    for change in changes:
        spoilt = state.with_changes([change])
        answer = solve(library, spoilt, goal, (AStar(),))
        if isinstance(answer, Unsolvable):
            found += 1
            yield _describe(change, spoilt, (answer.causes or (answer.why,))[0])
        if found == most:
            return


def _describe(change: RemoveRelation | ClearProperty, state: WorldState, says: str) -> Broken:
    if isinstance(change, ClearProperty):
        return Broken((change.individual,), change.property, state, says)
    return Broken((change.subject, change.object), change.relation, state, says)


def _takings(state: WorldState) -> Iterator[RemoveRelation | ClearProperty]:
    for relation, links in sorted(state.asserted.items()):
        for subject in sorted(state.individuals):
            yield from (RemoveRelation(subject, relation, each) for each in sorted(links.forward.get(subject)))
    for property_ in sorted(state.vocabulary.properties):
        if state.vocabulary.properties[property_].computed_by is None:
            owners = (each for each in sorted(state.individuals) if state.value(each, property_) is not None)
            yield from (ClearProperty(each, property_) for each in owners)
