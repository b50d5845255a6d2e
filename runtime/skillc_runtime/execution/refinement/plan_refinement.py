"""Looks at the steps of a plan in space, one after another: whether the arms can carry them out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.refinement.failure import SpaceFailure
from skillc_runtime.execution.refinement.meetings import Moving, find_steps_apart
from skillc_runtime.execution.refinement.scope import call_of
from skillc_runtime.execution.refinement.siblings import find_hand
from skillc_runtime.execution.refinement.situation import (
    BaseDrive,
    ChosenPlace,
    ChosenStand,
    ChosenWay,
    RefinedMotion,
    Situation,
    begin_at_home,
)
from skillc_runtime.execution.refinement.walk import Scope, Walk
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.validation import apply_effects
from skillc_runtime.recording.space_claim import StepsApart
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.terms import MOBILE_ROBOT
from skillc_runtime.world.state.world_state import WorldState

RETRIES, WITH_BASES = 4, 40
"""How often a step may fail before no other ways to do the steps before it are tried; where bases drive, more often."""


@dataclass(frozen=True, slots=True, eq=False)
class RefinedStep:
    """A step that goes in the situation `before`, with the motions of the arms in it, and where things are let stand.

    `stands` are those beside where places want bases, `ways` those that are not straight. `implementation` is that with
    which later steps go, if they do not go with one before it; else None. `unseen` are calls in it that nobody could
    look at.
    """

    step: Step
    before: Situation
    motions: tuple[RefinedMotion, ...]
    unseen: tuple[str, ...]
    stands: tuple[ChosenStand, ...] = ()
    places: tuple[ChosenPlace, ...] = ()
    implementation: str | None = None
    ways: tuple[ChosenWay, ...] = ()
    drives: tuple[BaseDrive, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class PlanRefinement:
    """The steps that go in space, in order, and why the next one, which begins in a situation, does not.

    None if all go, or nothing says why. `unseen` are calls in the next one that nobody could look at, `apart` the steps
    that may not run at the same time, if all go.
    """

    steps: tuple[RefinedStep, ...]
    failed: Step | None = None
    failure: SpaceFailure | None = None
    before: Situation | None = None
    unseen: tuple[str, ...] = ()
    apart: tuple[StepsApart, ...] = ()


def refine_plan(
    library: SkillLibrary, state: WorldState, steps: Sequence[Step], begin: Situation | None = None
) -> PlanRefinement:
    """Return how the arms carry out steps in order, from a situation on: by default at home in a version of the world.

    Cancelled if the work around it ends.
    """
    return _Refiner(library).refine(tuple(steps), begin_at_home(state) if begin is None else begin)


class _Refiner:
    def __init__(self, library: SkillLibrary) -> None:
        self._library = library
        self._furthest = PlanRefinement(())
        self._left = RETRIES
        self._lacks_place: Step | None = None
        self._lacks_way = False

    def refine(self, steps: tuple[Step, ...], here: Situation) -> PlanRefinement:
        self._left = WITH_BASES if here.state.instances(MOBILE_ROBOT) else RETRIES
        found = next(self._go(steps, here, ()), None)
        if found is None:
            return self._furthest
        moving = [Moving(each.motions, each.drives) for each in found]
        apart = find_steps_apart(self._library, here.state, steps, moving)
        return PlanRefinement(found, apart=apart)

    def _go(
        self, left: tuple[Step, ...], here: Situation, done: tuple[RefinedStep, ...]
    ) -> Iterator[tuple[RefinedStep, ...]]:
        """Yield the refined steps; of the ways to do a step the next one is tried if a later step does not go."""
        if not left:
            yield done
            return
        step, walk, went = left[0], Walk(self._library), 0
        for name in self._library.skills[step.skill].implementations:
            before = went
            for after in walk.go(call_of(step, self._library, name), here, Scope({})):
                went += 1
                refined = _refine_step(step, here, after, tuple(walk.unseen), name if before else None)
                self._lacks_place, self._lacks_way = None, False
                yield from self._go(left[1:], self._with_effects(step, after), (*done, refined))
                if self._left <= 0 or (self._lacks_way and _leaves_as_it_was(here, after)):
                    return
                if self._lacks_place is not None and _takes_any(here.state, after.state, self._lacks_place):
                    break  # in another posture the hand holds it in the same way
        self._left -= 1
        why = None if went else walk.furthest
        self._lacks_place = step if _lacks_place(why, here) else None
        self._lacks_way = why is not None and why.cause == "no-way"
        if len(done) > len(self._furthest.steps) or self._furthest.failed is None:
            self._furthest = PlanRefinement(done, step, walk.furthest, here, tuple(walk.unseen))

    def _with_effects(self, step: Step, after: Situation) -> Situation:
        """Return the situation after a step with all that its skill promises."""
        try:
            state = apply_effects(step, self._library, after.state)
        except (EvaluationError, WorldError):
            return after
        return replace(after, state=state, forces={}, spreads={})


def _refine_step(
    step: Step, before: Situation, after: Situation, unseen: tuple[str, ...], implementation: str | None
) -> RefinedStep:
    """Return a step with what has come in it between two situations."""
    return RefinedStep(
        step,
        before,
        after.motions[len(before.motions) :],
        unseen,
        after.stands[len(before.stands) :],
        after.places[len(before.places) :],
        implementation,
        after.ways[len(before.ways) :],
        after.drives[len(before.drives) :],
    )


def _lacks_place(why: SpaceFailure | None, here: Situation) -> bool:
    """Whether nothing has moved in a step because there is no place for what it puts down, or no grasp."""
    return why is not None and why.cause == "no-grasp-or-place" and why.depth == len(here.motions)


def _leaves_as_it_was(before: Situation, after: Situation) -> bool:
    """Whether no base has been driven, and nothing put down: then another way to do it makes no way for a base."""
    return len(after.drives) == len(before.drives) and len(after.places) == len(before.places)


def _takes_any(before: WorldState, after: WorldState, step: Step) -> bool:
    """Whether a hand has taken, from one version of the world to another, a thing that a step names."""
    named = step.arguments.values()
    return any(find_hand(after, each) is not None and find_hand(before, each) is None for each in named)
