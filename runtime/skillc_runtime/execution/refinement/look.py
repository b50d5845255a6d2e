"""Plans again without the steps that do not go in space, until all steps of a plan go or there is no other plan.

Nothing slow is imported here: whoever remembers what was found needs no simulator.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias, TypeVar

import msgspec
from msgspec.structs import replace

from skillc_runtime.execution.refinement.failure import Cause
from skillc_runtime.planning.plan import Excluded, GaveUp, LeftOut, Step, StepWhile, Unsolvable
from skillc_runtime.planning.schedule import PlanAnswer
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.world_state import WorldState

ROUNDS = 30
"""How often is planned at most."""

AnswerT = TypeVar("AnswerT", bound=PlanAnswer)
PlanWithout: TypeAlias = Callable[[Sequence[Excluded]], AnswerT]
"""Plans without some steps."""


class PlanLook(msgspec.Struct, frozen=True, kw_only=True):
    """What a look at a plan in space has found: the step that does not go, if one does not, and the cause.

    `found` are the steps that do not go, and while what holds: that one, and others like it. Without a cause nothing
    says why.
    """

    claim: SpaceClaim
    failed: Step | None = None
    cause: Cause | None = None
    found: tuple[StepWhile, ...] = ()

    @property
    def excluded(self) -> tuple[Excluded, ...]:
        """What other plans may not contain; nothing if all steps go, or a value has to be measured first."""
        return () if self.cause == "no-value" else tuple(each.step if each.always else each for each in self.found)

    def explain(self, state: WorldState, needed: tuple[LeftOut, ...] = (), ended: str | None = None) -> GaveUp:
        """Return the answer that no plan is known all of whose steps go in space, after this look at the last one.

        `needed` is as of `GaveUp`; `ended` says why no other plan was looked for, None if there is none.
        """
        assert self.failed is not None, "all steps go"
        named = ", ".join(state.vocabulary.short(each) for each in self.failed.arguments.values())
        tried = "the arms can carry out none, for the grasps, postures and places that were tried"
        tried = tried if ended is None else f"{ended} before one was found that the arms can carry out; of the last one"
        why = self.found[0].why if self.found else self.claim.failure
        return GaveUp(f"{tried}: {self.failed.skill}({named}) does not go: {why}", needed=needed)


def look_at_plans(
    plan: PlanWithout[AnswerT], look: Callable[[Sequence[Step]], PlanLook]
) -> Iterator[tuple[AnswerT, PlanLook | None]]:
    """Yield plans, each without the steps of those before it that do not go in space, and the look at each.

    The last is one that goes, the answer that there is no other, without a look, or one after which nothing more is
    tried.
    """
    without: list[Excluded] = []
    for _ in range(ROUNDS):
        answer = plan(without)
        if isinstance(answer, Unsolvable | GaveUp):
            yield answer, None
            return
        seen = look(answer.plan.steps)
        yield answer, seen
        new = [each for each in seen.excluded if each not in without]
        new = new or [each for each in map(_widen, seen.excluded) if each not in without]
        if not new:
            return
        without += new


def _widen(excluded: Excluded) -> Excluded:
    """Return what is excluded whatever has been moved: things were taken up, and put back to where they were."""
    return replace(excluded, unmoved=(), moved=()) if isinstance(excluded, StepWhile) else excluded
