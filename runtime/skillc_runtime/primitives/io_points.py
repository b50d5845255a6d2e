"""Sets outputs of a controller, and waits for its inputs."""

from __future__ import annotations

from skillc_runtime.devices.cell import Cell
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import LEVEL

NEAR = 0.01
"""An output has a level if what the controller reports differs by at most this: it is converted to a few bits."""

OUTPUT_S = 1.0
"""How long an output may take until the controller reports its level, in s."""


class SetOutput(Primitive):
    """Sets an output to a level, waits until the controller reports that, and writes it. Its stop leaves the output."""

    moves = NOTHING
    stays_put = True

    def __init__(self, cell: Cell, *, output: str, level: float) -> None:
        super().__init__(cell)
        self._point, self._output, self._level, self._began = cell.io_point(output), output, level, 0.0

    def start(self) -> None:
        """Set it; SkillFailure if it cannot have this level."""
        self._began = self.cell.now
        try:
            self._point.set(self._level)
        except ValueError as error:
            raise SkillFailure(str(error)) from error

    def tick(self) -> Status:
        """Return SUCCESS when the controller reports the level."""
        found = self._point.level
        if abs(found - self._level) <= NEAR:
            self.cell.world.commit([SetProperty(self._output, LEVEL, self._level)], "SetOutput", "reported")
            return Status.SUCCESS
        if self.cell.now - self._began > OUTPUT_S:
            raise SkillFailure(
                "{output} was set to {wanted}; its controller reports {found}",
                output=_label(self.cell, self._output),
                wanted=LabelledQuantity(self._level),
                found=LabelledQuantity(found),
            )
        return Status.RUNNING


class AwaitInput(Primitive):
    """Waits up to `patience` s until an input is at `least` and at `most` what is wanted; writes its level."""

    moves = NOTHING
    stays_put = True

    def __init__(
        self, cell: Cell, *, point: str, least: float | None = None, most: float | None = None, patience: float
    ) -> None:
        super().__init__(cell)
        self._point, self._input, self._patience, self._began = cell.io_point(point), point, patience, 0.0
        self._least, self._most = least, most

    def start(self) -> None:
        """Start waiting."""
        self._began = self.cell.now

    def tick(self) -> Status:
        """Return SUCCESS when the input has such a level."""
        found = self._point.level
        if (self._least is None or found >= self._least) and (self._most is None or found <= self._most):
            self.cell.world.commit([SetProperty(self._input, LEVEL, found)], "AwaitInput", "reported")
            return Status.SUCCESS
        if self.cell.now - self._began > self._patience:
            raise SkillFailure(
                "{point} is at {found}, not {wanted}, after {patience}",
                point=_label(self.cell, self._input),
                found=LabelledQuantity(found),
                wanted=self._wanted,
                patience=LabelledQuantity(self._patience, "s"),
            )
        return Status.RUNNING

    @property
    def _wanted(self) -> str:
        words = (("at least", self._least), ("at most", self._most))
        return " and ".join(f"{word} {level:g}" for word, level in words if level is not None)


def _label(cell: Cell, individual: str) -> LabelledIri:
    return label(individual, cell.world.snapshot().vocabulary)
