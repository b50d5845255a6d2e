"""From a plan for what may come to a policy: a branch for each outcome of each step that senses something.

Planners get each outcome of a skill as an action of its own, so their plan is one for the outcomes that suit it
(all-outcomes determinisation; Yoon, Fern, Givan 2007). For each other outcome on its way another plan is made, from the
world after it, and so on (as AO* expands a policy), until each branch reaches the goal. What comes of an outcome is
planned once for each world. A step of which an outcome leads nowhere is left out, and the plan is made anew.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import msgspec
from msgspec.structs import replace

from skillc_model.conditions import Condition
from skillc_model.skills import Outcome, SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import Branch, Excluded, GaveUp, Plan, PlanResult, Solved, Step
from skillc_runtime.planning.validation import (
    PlanError,
    apply_step,
    compute_work_s,
    find_possible_outcomes,
    validate,
)
from skillc_runtime.planning.world_changes import find_changed_facts
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

MOST_PLANS = 64
"""For so many outcomes a plan is made beforehand, whatever they are; if there are more, for those that are likely."""
RARE = 1.0 / 16.0
"""A branch that is less likely than this is planned when it comes, if there are too many."""
MOST_TRIES = 8
"""So many plans are made for one world, each without the steps of which an outcome leads nowhere."""

PlanFrom: TypeAlias = Callable[[WorldState, Sequence[Excluded], CancelToken], PlanResult]
"""Plans from a world, without some steps, for outcomes that suit the plan."""
_WorldKey: TypeAlias = frozenset[object]


class _TooMany(Exception):
    """There are more outcomes than are planned for."""


class _DeadEnd(Exception):
    """No policy is known; the message says why, as a clause."""


def make_policy(
    line: Solved,
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    plan: PlanFrom,
    without: Sequence[Excluded],
    cancel: CancelToken,
) -> PlanResult:
    """Return a policy that begins with a plan for what may come, validated; the plan itself if nothing is sensed in it.

    Where there are more than MOST_PLANS outcomes, or no time is left, those that are rare are planned when they come.
    The plan is a lower bound of what any policy takes.
    """
    if not any(step.outcome for step in line.plan.steps):
        return line
    memory: dict[tuple[_WorldKey, str], PlanResult] = {}
    try:
        try:
            whole = _Expansion(library, state, goal, plan, cancel.share(0.5), memory, 0.0)
            policy = whole.expand(state, 1.0, line.plan.steps, tuple(without), frozenset())
        except _TooMany:
            likely = _Expansion(library, state, goal, plan, cancel, memory, RARE)
            policy = likely.expand(state, 1.0, line.plan.steps, tuple(without), frozenset())
        validate(policy, library, state, goal)
    except (_DeadEnd, PlanError, EvaluationError) as reason:
        return GaveUp(f"none for all that may be sensed, as far as was searched: {reason}")
    return _rate(line, policy)


def _rate(line: Solved, policy: Plan) -> Solved:
    """Return a policy with what is known of it: none takes less than the plan for what suits it."""
    bound_s = line.bound_s
    if policy.duration_s <= bound_s and not any(policy.list_open()):
        return replace(line, plan=policy)
    return replace(line, plan=policy, optimal="best found", at_least_s=bound_s or None)


class _Expansion(msgspec.Struct):
    """Makes plans for outcomes; branches that are less likely than `least_likely` stay open.

    `made` are the policies for the worlds that have been met, `answers` what planners have found.
    """

    library: SkillLibrary
    start: WorldState
    goal: Condition
    plan: PlanFrom
    cancel: CancelToken
    answers: dict[tuple[_WorldKey, str], PlanResult]
    least_likely: float
    made: dict[_WorldKey, Plan] = {}

    def expand(
        self,
        state: WorldState,
        likely: float,
        steps: Sequence[Step] | None,
        without: tuple[Excluded, ...],
        above: frozenset[_WorldKey],
    ) -> Plan:
        """Return a policy from a world that is reached by so much, beginning with `steps` if they are known.

        `above` are the worlds from which it came here, to which no policy returns. _DeadEnd if none is known.
        """
        here = self._key(state)
        if here in above:
            raise _DeadEnd("it would come back to where it was")
        if here in self.made:
            return self.made[here]
        why = ""
        for _ in range(MOST_TRIES):
            try:
                line = steps if steps is not None else self._plan_line(here, state, without)
            except _DeadEnd as reason:
                raise _DeadEnd(why or str(reason)) from reason
            look, policy, dead_end = self._follow(state, likely, line, without, above | {here})
            if policy is not None:
                self.made[here] = policy
                return policy
            steps, without, why = None, (*without, look), dead_end
        raise _DeadEnd(why)

    def _follow(
        self,
        state: WorldState,
        likely: float,
        line: Sequence[Step],
        without: tuple[Excluded, ...],
        above: frozenset[_WorldKey],
    ) -> tuple[Step, Plan | None, str]:
        """Return the first step of a plan of which several outcomes may come, and the policy up to it and on from it.

        Without a policy, the text says which outcome leads nowhere. A plan without such a step is the policy.
        """
        world, done = state, list[Step]()
        for number, step in enumerate(line):
            possible = find_possible_outcomes(step, self.library, world) if step.outcome else ()
            if len(possible) > 1:
                look = step.with_outcome("")
                try:
                    branches = self._branch(step, possible, world, likely, line[number + 1 :], without, above)
                except _DeadEnd as reason:
                    return look, None, str(reason)
                work_s = compute_work_s(Plan((*done, look), 0.0), self.library, state)
                mean_s = sum(each.likely * each.plan.duration_s for each in branches if each.plan is not None)
                planned = sum(each.likely for each in branches if each.plan is not None)
                return look, Plan((*done, look), work_s + mean_s / (planned or 1.0), branches=branches), ""
            done.append(step)
            world = apply_step(step, self.library, world)
        return Step("", {}), Plan(tuple(done), compute_work_s(Plan(tuple(done), 0.0), self.library, state)), ""

    def _branch(
        self,
        step: Step,
        possible: Sequence[Outcome],
        world: WorldState,
        likely: float,
        rest: Sequence[Step],
        without: tuple[Excluded, ...],
        above: frozenset[_WorldKey],
    ) -> tuple[Branch, ...]:
        """Return how it goes on after each outcome; _DeadEnd if it does not after one."""
        total = sum(each.likely for each in possible)
        found = list[Branch]()
        for outcome in possible:
            share = outcome.likely / total if total else 1.0 / len(possible)
            known = rest if outcome.label == step.outcome else None
            after = apply_step(step.with_outcome(outcome.label), self.library, world)
            is_open = known is None and self._is_left_open(after, likely * share)
            try:
                plan = None if is_open else self.expand(after, likely * share, known, without, above)
            except _DeadEnd as reason:
                short = self.start.vocabulary.short
                named = ", ".join(short(each) for each in step.arguments.values())
                raise _DeadEnd(f"after {step.skill}({named}) -> {outcome.label}: {reason}") from reason
            found.append(Branch(outcome.label, share, plan))
        return tuple(found)

    def _is_left_open(self, state: WorldState, likely: float) -> bool:
        """Whether an outcome is planned when it comes: it is rare, or there is no time; _TooMany in the first run."""
        if self._key(state) in self.made:
            return False
        if self.least_likely == 0.0:
            if self.cancel.reason is not None or len(self.answers) >= MOST_PLANS:
                raise _TooMany
            return False
        return likely < self.least_likely or self.cancel.reason is not None

    def _plan_line(self, here: _WorldKey, state: WorldState, without: tuple[Excluded, ...]) -> tuple[Step, ...]:
        """Return the steps of a plan for what suits it; _DeadEnd if there is none."""
        key = here, repr(without)
        if key not in self.answers:
            self.answers[key] = self.plan(state, without, self.cancel)
        answer = self.answers[key]
        if not isinstance(answer, Solved):
            raise _DeadEnd("; ".join(answer.causes) or answer.why)
        return answer.plan.steps

    def _key(self, state: WorldState) -> _WorldKey:
        """Return what a world differs in from that at the start."""
        return frozenset(
            (each, state.value(each.subject, each.term) if each.object is None and each.subject and each.term else None)
            for each in find_changed_facts(self.start, state)
        )
