"""Watches, while the steps of a plan run, whether the rest of the plan still leads to the goal."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.plans.progress import Progress, invalidation_reason, measure_progress
from skillc_runtime.planning.plan import Step
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from skillc_runtime.world.state.changes import named_individuals
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent
from skillc_runtime.world.state.world_state import WorldState


class PlanMonitor:
    """Judges the steps that have not begun whenever the world has changed.

    A compound that runs may undo for a moment what they need. So they are judged in two worlds, each with the effects
    that the running steps will have: the world as it is, and the one in which these steps began, with all that has
    come from elsewhere since. The plan leads to the goal if it does so in one of them; while it does so only in the
    other world, it is judged again as soon as other steps run.
    """

    def __init__(
        self,
        steps: Sequence[Step],
        goal: Condition | None,
        library: SkillLibrary,
        world: WorldModel,
        outcome: Callable[[], NodeOutcome],
    ) -> None:
        """Listen to the world until `stop`; `outcome` returns that of the body of the plan as it is.

        Without a goal the steps only have to be possible: a policy goes on after them.
        """
        self._steps, self._goal, self._library, self._outcome = steps, goal, library, outcome
        self._world = world
        self._seen = self._before = world.snapshot()
        self._ended: frozenset[int] = frozenset()
        self._running: frozenset[int] = frozenset()
        self._pardoned: frozenset[int] | None = None
        self._ticking = False
        self.stop = world.subscribe(self._note_write)

    def follow(self, tick: Callable[[], Status]) -> Status:
        """Return what a function returns, in which it is the steps of the plan that write to the world."""
        self._ticking = True
        try:
            return tick()
        finally:
            self._ticking = False

    def find_invalidation(self) -> str | None:
        """Return why the plan no longer leads to the goal, None if it does, or if nothing has changed since it did."""
        state = self._world.snapshot()
        if state is self._seen and self._pardoned is None:
            return None
        progress = self._measure(state)
        if state is self._seen and self._pardoned == self._running:
            return None
        self._seen, self._pardoned = state, None
        left = _select(progress, "idle").values()
        reason = self._judge(_select(progress, "running").values(), left, state)
        if reason is None or self._before is state:
            return reason
        begun = (step for number, step in _select(progress, "running", "success").items() if number not in self._ended)
        reason = self._judge(begun, left, self._before)
        self._pardoned = self._running if reason is None else None
        return reason

    def _judge(self, begun: Iterable[Step], left: Iterable[Step], state: WorldState) -> str | None:
        return invalidation_reason(tuple(begun), tuple(left), self._goal, self._library, state)

    def _note_write(self, event: ChangeEvent) -> None:
        """Take note of a write to the world."""
        progress = self._measure(event.before)
        if self._is_own(event, _select(progress, "running").values()):
            return
        try:
            self._before = self._before.with_changes(event.changes)
        except (WorldError, KeyError):  # what has changed is only there because of what the steps have done
            self._before = event.after

    def _measure(self, state: WorldState) -> Progress:
        """Return the progress in `state`, in which the running steps began if none of them ran before."""
        progress = measure_progress(self._steps, self._outcome())
        running = _select(progress, "running")
        if self._running.isdisjoint(running):
            self._before, self._ended = state, frozenset(_select(progress, "success"))
        self._running = frozenset(running)
        return progress

    def _is_own(self, event: ChangeEvent, running: Iterable[Step]) -> bool:
        """Whether running steps have made a change, which they may undo, unlike what they sense of other things."""
        if not self._ticking or event.evidence is None:
            return False
        handled = {value for step in running for value in step.arguments.values()}
        return event.evidence == "assumed" or any(
            not handled.isdisjoint(named_individuals(change)) for change in event.changes
        )


def _select(progress: Progress, *statuses: str) -> dict[int, Step]:
    """Return the steps that have one of these statuses, by number."""
    return {number: step for number, (step, outcome) in enumerate(progress) if outcome.status in statuses}
