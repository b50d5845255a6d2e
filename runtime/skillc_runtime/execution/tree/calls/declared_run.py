"""The run of what has no body: it takes its duration, and then what it declares is so."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar

from skillc_model.pddl.costs import ASSUMED_SECONDS, exact_seconds
from skillc_model.skills import Implementation, Skill
from skillc_runtime.execution.tree.stand_ins import choose_outcome, find_measured, find_outputs
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.eval.effects import changes_of
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value

if TYPE_CHECKING:
    from skillc_runtime.execution.tree.context import TreeContext


class DeclaredRun(Primitive):
    """Succeeds after the duration of its implementation; without one at once, and never if the skill is endless.

    A duration that has no value takes as long as planners assume. The sensed postconditions, and what comes of the
    skill in truth or by chance, are then written as sensed, which the cell weighs; whoever runs it writes the others.
    Outputs are stand-ins.
    """

    moves: ClassVar[Mapping[str, str | None] | None] = NOTHING
    stays_put: ClassVar[bool] = True

    def __init__(
        self, context: TreeContext, skill: Skill, implementation: Implementation, values: Mapping[str, Value]
    ) -> None:
        super().__init__(context.run_cell)
        self._context, self._skill, self._implementation, self._values = context, skill, implementation, values
        self._end_s = 0.0

    def start(self) -> None:
        """Find out when it ends."""
        self._end_s = self._context.now + self._duration_s
        if not self._skill.endless:
            self._context.expect(self._end_s)

    def tick(self) -> Status:
        """Return RUNNING until the duration is over; then write what counts as measured."""
        if self._skill.endless or not self._context.is_due(self._end_s):
            return Status.RUNNING
        state = self._context.state
        outputs = find_outputs(self._implementation, state, self._values)
        if lacking := [name for name, value in outputs.items() if value is None]:
            raise SkillFailure(f"the world has no individual that `{lacking[0]}` may be")
        values = {**self._values, **{name: value for name, value in outputs.items() if value is not None}}
        effects = tuple(each for post in self._implementation.post if post.sensed for each in post.effects)
        measured = (
            *changes_of(effects, state, values),
            *find_measured(self._implementation.post, state, values),
        )
        if measured:
            self.cell.world.commit(measured, self._skill.name, "sensed")
        self.outputs = dict(outputs)
        self.outcome = choose_outcome(self._skill.outcomes, self.outcomes, self._chance, self.true_outcome)
        return Status.SUCCESS

    @property
    def _chance(self) -> str:
        """What decides by chance what comes of it: what is sensed is so from the start, the rest each time anew."""
        about = [value for value in self._values.values() if isinstance(value, str)]
        times = 0 if self._skill.senses else self.cell.world.ledger.count
        return f"{self._context.spec.seed} {self._skill.name} {about} {times}"

    @property
    def _duration_s(self) -> float:
        if self._implementation.duration is None:
            return 0.0
        try:
            return float(exact_seconds(value_of(self._implementation.duration, self._context.state, self._values)))
        except (EvaluationError, ValueError):
            return float(ASSUMED_SECONDS)
