"""All samples that are taken during a run for its report: of arms, hands and bases."""

from __future__ import annotations

from skillc_runtime.devices.backend import Backend
from skillc_runtime.evaluation.report.arm_trace import ArmTrace
from skillc_runtime.evaluation.report.base_trace import BaseTrace
from skillc_runtime.evaluation.report.hand_trace import HandTrace


class RunTrace:
    """Samples a cell; `sample` is to be called in every tick. `began_s` is the time of the cell at the start, in s."""

    def __init__(self, backend: Backend) -> None:
        self.began_s = backend.clock.now
        self.arms, self.hands, self.bases = ArmTrace(backend), HandTrace(backend), BaseTrace(backend)

    def sample(self) -> None:
        """Sample what is due."""
        self.arms.sample()
        self.hands.sample()
        self.bases.sample()
