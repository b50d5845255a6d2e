"""Turns a planning problem into activities: each ground action is one that may be done some number of times."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import assert_never

import msgspec

from skillc_model.pddl.formulas import (
    TRUE,
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Universal,
)
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.cp_sat.task import (
    Activity,
    AllOf,
    AnyOf,
    Need,
    ScheduleTask,
    list_conjuncts,
    list_literals,
)
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.plan_text import read_step
from skillc_runtime.planning.schedule import Schedule, TimedStep
from skillc_runtime.planning.search.ground_actions import GroundAction
from skillc_runtime.planning.search.grounding import Grounding


def find_groups(
    facts: Mapping[Atom, int], activities: Sequence[Activity], true: Sequence[int]
) -> tuple[tuple[int, ...], ...]:
    """Return disjoint groups of the numbers of facts that differ in one term only.

    One of a group holds at first, and each activity that changes the group ends one that it needs and begins one: so
    exactly one holds at any time (an invariant as of Helmert, "Concise finite-domain representations", 2009).
    """
    touching: dict[int, set[int]] = defaultdict(set)
    for number, activity in enumerate(activities):
        for literal in activity.effects:
            touching[abs(literal)].add(number)
    taken: set[int] = set()
    found = []
    for group in _list_candidates(facts):
        changing = set().union(*(touching[each] for each in group))
        if (
            len(group) > 1
            and taken.isdisjoint(group)
            and len(group.intersection(true)) == 1
            and all(_exchanges(activities[each], group) for each in changing)
        ):
            taken |= group
            found.append(tuple(sorted(group)))
    return tuple(found)


def _list_candidates(facts: Mapping[Atom, int]) -> list[set[int]]:
    """Return the sets of facts that differ in one term, the largest first."""
    candidates: dict[tuple[object, ...], set[int]] = defaultdict(set)
    for atom, number in facts.items():
        for place in range(len(atom.terms)):
            rest = atom.terms[:place] + atom.terms[place + 1 :]
            candidates[atom.predicate, place, *rest].add(number)
    return sorted(candidates.values(), key=lambda each: (-len(each), min(each)))


def _exchanges(activity: Activity, group: set[int]) -> bool:
    """Whether an activity begins exactly one fact of a group and ends exactly one, which it needs."""
    begun = [each for each in activity.effects if each in group]
    ended = [-each for each in activity.effects if -each in group]
    needed = [each for each in list_conjuncts(activity.need) if each in group]
    return len(begun) == 1 and ended == needed and len(ended) == 1


class NotSchedulable(ValueError):
    """A problem that the model cannot express; the message says what in it."""


class Activities(msgspec.Struct, frozen=True):
    """The activities of a problem, with the step that each is; `true` are the numbers of the facts that hold first."""

    activities: tuple[Activity, ...]
    steps: tuple[Step, ...]
    true: tuple[int, ...]
    goal: Need
    groups: tuple[tuple[int, ...], ...]
    scale: Fraction

    @property
    def at_most_once(self) -> bool:
        """Whether the least makespan is one of a schedule that does each activity at most once.

        So it is if no effect takes away what the goal or another activity needs: what is done again can be left out.
        What is needed must not hold at first, and be an effect of one activity only: another one that makes it again
        need not wait for those that need it, but does in the model.
        """
        needs = [frozenset(list_literals(each.need)) for each in self.activities]
        users = Counter(literal for need in needs for literal in need)
        users.update(frozenset(list_literals(self.goal)))
        makers = Counter(effect for each in self.activities for effect in each.effects)
        makers.update(self.true)
        return all(
            users[-effect] == (-effect in need) and (makers[effect] == 1 or not users[effect])
            for activity, need in zip(self.activities, needs, strict=True)
            for effect in activity.effects
        )

    def task(self, first: Schedule | None, repeats: int, seconds: float, workers: int) -> ScheduleTask:
        """Return the task in which each activity may be done `repeats` times, or as often as in `first`."""
        starts = self._find_starts(first)
        often = Counter(number for number, _ in starts)
        activities = tuple(
            msgspec.structs.replace(each, copies=max(repeats, often[number]))
            for number, each in enumerate(self.activities)
        )
        ends = (start + self.activities[number].units for number, start in starts)
        total = sum(each.units * each.copies for each in activities)
        horizon = max(ends, default=total)
        return ScheduleTask(activities, self.true, self.goal, self.groups, horizon, starts, False, seconds, workers)

    def _find_starts(self, schedule: Schedule | None) -> tuple[tuple[int, int], ...]:
        """Return a schedule as activities with starts; nothing if the problem does not have one of its steps."""
        if schedule is None:
            return ()
        numbers = {
            (key_of(step), each.units): number
            for number, (step, each) in enumerate(zip(self.steps, self.activities, strict=True))
        }
        found = [
            (
                numbers.get((key_of(each.step), int(Fraction(each.duration_s) * self.scale + Fraction(1, 10**6)))),
                each.start_s,
            )
            for each in schedule.steps
        ]
        starts = [(number, round(start_s * float(self.scale))) for number, start_s in found if number is not None]
        return tuple(starts) if len(starts) == len(found) else ()

    def schedule(self, starts: Iterable[tuple[int, int]]) -> Schedule:
        """Return the schedule of activities with starts, without those that it does not need."""
        kept = self._leave_out_useless(
            sorted(starts, key=lambda each: (each[1], each[1] + self.activities[each[0]].units))
        )
        scale = float(self.scale)
        return Schedule(
            tuple(
                TimedStep(self.steps[number], start / scale, self.activities[number].units / scale)
                for number, start in kept
            )
        )

    def _leave_out_useless(self, starts: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
        """Return the activities without those, the last first, without which the others still reach the goal."""
        kept = list(starts)
        for each in starts[::-1]:
            rest = [other for other in kept if other is not each]
            if self._reach_goal(number for number, _ in rest):
                kept = rest
        return kept

    def _reach_goal(self, numbers: Iterable[int]) -> bool:
        true = set(self.true)
        for number in numbers:
            activity = self.activities[number]
            if not _holds(activity.need, true):
                return False
            true -= {-each for each in activity.effects if each < 0}
            true |= {each for each in activity.effects if each > 0}
        return _holds(self.goal, true)


def key_of(step: Step) -> tuple[str, ...]:
    """Return a step as words."""
    return (step.skill, *(word for pair in sorted(step.arguments.items()) for word in pair))


def _holds(need: Need, true: set[int]) -> bool:
    match need:
        case int():
            return (abs(need) in true) == (need > 0)
        case AllOf(parts):
            return all(_holds(part, true) for part in parts)
        case AnyOf(parts):
            return any(_holds(part, true) for part in parts)
        case _:
            assert_never(need)


def list_activities(problem: Problem, cancel: CancelToken) -> Activities:
    """Return the activities of a problem; NotSchedulable if there are none, Cancelled if `cancel` ends the search."""
    grounding = Grounding(problem, cancel)
    actions = grounding.actions
    grounding.explore()
    facts = {atom: number for number, atom in enumerate(sorted(grounding.reachable, key=repr), 1)}
    devices = {each.name: number for number, each in enumerate(problem.objects)}
    found = tuple(_make_activity(each, problem, facts, devices) for each in actions)
    steps = tuple(read_step(problem, each.words) for each in actions)
    assert all(step is not None for step in steps), "only the goal action is no step"
    true = tuple(sorted(facts[each] for each in grounding.init))
    goal, groups = _need(grounding.goal(), facts), find_groups(facts, found, true)
    return Activities(found, tuple(filter(None, steps)), true, goal, groups, problem.domain.scale)


def _make_activity(
    ground: GroundAction, problem: Problem, facts: Mapping[Atom, int], devices: Mapping[str, int]
) -> Activity:
    action = problem.domain.action[ground.words[0]]
    values = dict(zip((each.name for each in action.parameters), ground.words[1:], strict=True))
    added = {facts[each.atom] for each in ground.effects if each.positive and each.atom in facts}
    effects = set(added)
    for each in ground.effects:
        if each.condition != TRUE and (each.positive or each.condition != each.atom):
            raise NotSchedulable(f"what {action.skill} changes depends on the state in which it ends")
        if not each.positive and each.atom in facts and facts[each.atom] not in added:
            effects.add(-facts[each.atom])
    used = sorted({devices[values.get(each, each)] for each in action.uses})
    return Activity(ground.units, _need(ground.precondition, facts), tuple(sorted(effects)), tuple(used))


def _need(formula: Formula, facts: Mapping[Atom, int]) -> Need:
    """Return a ground formula over the numbers of facts; an atom that has none is never true."""
    match formula:
        case Atom():
            return facts[formula] if formula in facts else AnyOf(())
        case Negation(body):
            assert isinstance(body, Atom), f"{formula} is not reduced"
            return -facts[body] if body in facts else AllOf(())
        case Conjunction(parts):
            return AllOf(tuple(_need(part, facts) for part in parts))
        case Disjunction(parts):
            return AnyOf(tuple(_need(part, facts) for part in parts))
        case Equal() | Existential() | Universal():
            raise AssertionError(f"{formula} is not ground")
        case _:
            assert_never(formula)
