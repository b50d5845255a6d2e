"""Finds the parts of a goal that can each be reached and never hold together, and what keeps them apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import msgspec
from msgspec import structs

from skillc_model.pddl.domain import Action
from skillc_model.pddl.formulas import Atom, Change, Equal, Formula, Negation, conjunction, disjunction
from skillc_model.pddl.problem import Problem
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.change_text import ChangeText
from skillc_runtime.planning.nearest_changes import NearestChanges
from skillc_runtime.planning.plan import Plan, PlanResult, Solved, Step, Unsolvable
from skillc_runtime.planning.problem.initial_state import InitialState
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.search.grounding import Grounding
from skillc_runtime.planning.validation import PlanError, apply_step
from skillc_runtime.world.state.world_state import WorldState

SEARCH_S = 0.5
SHARE = 0.5
"""The time limit for each search for a plan, and the share of the time that is left that all of them may take."""


class GoalConflict(msgspec.Struct, frozen=True):
    """Parts of a goal, the fewest that were found, that never hold together; `why` is empty if it is not known."""

    parts: tuple[Formula, ...]
    why: str = ""


class GoalConflicts:
    """Finds conflicts in a problem without a plan, each part of whose goal can be reached, deletions ignored."""

    def __init__(self, problem: Problem, library: SkillLibrary, state: WorldState, limit: CancelToken) -> None:
        self._problem, self._library, self._state, self._limit = problem, library, state, limit
        self._searching = limit.share(SHARE)

    def find(self, parts: Sequence[Formula]) -> GoalConflict:
        """Return a conflict among parts of a goal, if possible one that can be explained."""
        one = self._find(parts)
        other = one if one.why else self._find(parts[::-1])
        return other if other.why else one

    def _find(self, parts: Sequence[Formula]) -> GoalConflict:
        """Return a conflict of which nothing can be left out, as far as searching shows, from the first part on."""
        kept = list(parts)
        for each in parts:
            fewer = [other for other in kept if other is not each]
            if fewer and isinstance(self._plan(self._problem, fewer), Unsolvable):
                kept = fewer
        return GoalConflict(tuple(kept), self._explain(kept[:-1], kept[-1]))

    def _plan(self, problem: Problem, goal: Sequence[Formula]) -> PlanResult:
        return AStar().plan(structs.replace(problem, goal=conjunction(goal)), self._searching.limited(SEARCH_S))

    def _explain(self, first: Sequence[Formula], last: Formula) -> str:
        """Return why a part cannot be reached once the others hold; empty if that is not known."""
        solved = self._plan(self._problem, first)
        worlds = self._follow(solved.plan, self._state) if isinstance(solved, Solved) and first else ()
        if not worlds:
            return ""
        after = worlds[-1][1]
        there = structs.replace(self._problem, init=self._list_atoms(after), goal=last)
        kept = _keep(there, first)
        grounding = Grounding(kept, self._limit)
        grounding.explore()
        if grounding.is_possible(grounding.goal()):
            return self._explain_undoing(there, first, after)
        found = NearestChanges(kept, after, grounding, self._limit).find()
        return "; ".join(ChangeText(kept, self._library, after).describe(found))

    def _explain_undoing(self, there: Problem, first: Sequence[Formula], after: WorldState) -> str:
        """Return which step of a plan for the last part undoes the others."""
        solved = self._plan(there, [there.goal])
        unmoved = replace(there.domain, actions=())
        for step, world in self._follow(solved.plan, after) if isinstance(solved, Solved) else ():
            grounding = Grounding(structs.replace(there, init=self._list_atoms(world), domain=unmoved))
            if not all(grounding.is_possible(grounding.reduce(each, {})) for each in first):
                return f"{step.skill} undoes that on the way to the other"
        return ""

    def _follow(self, plan: Plan, state: WorldState) -> tuple[tuple[Step, WorldState], ...]:
        """Return the steps of a plan with the world after each; nothing if the plan does not work."""
        found = []
        try:
            for step in plan.steps:
                state = apply_step(step, self._library, state)
                found.append((step, state))
        except PlanError:
            return ()
        return tuple(found)

    def _list_atoms(self, state: WorldState) -> tuple[Atom, ...]:
        return tuple(InitialState(self._problem.domain, state, self._problem.objects, self._problem.names).atoms())


def _keep(problem: Problem, parts: Sequence[Formula]) -> Problem:
    """Return a problem whose actions undo none of these literals."""
    atoms = [(each, True) for each in parts if isinstance(each, Atom)]
    atoms += [(each.body, False) for each in parts if isinstance(each, Negation) and isinstance(each.body, Atom)]

    def spare(change: Change) -> Change:
        conditions = [change.condition]
        for atom, holds in atoms:
            if change.positive != holds and change.atom.predicate == atom.predicate:
                pairs = zip(change.atom.terms, atom.terms, strict=True)
                conditions.append(disjunction(Negation(Equal(*pair)) for pair in pairs))
        return structs.replace(change, condition=conjunction(conditions))

    def restrict(action: Action) -> Action:
        return structs.replace(action, effects=tuple(map(spare, action.effects)))

    return structs.replace(
        problem, domain=replace(problem.domain, actions=tuple(map(restrict, problem.domain.actions)))
    )
