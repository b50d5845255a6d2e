"""All samples that are taken during a run for its report: of arms, hands and bases."""

from __future__ import annotations

from skillc_runtime.devices.simulation import Simulation
from skillc_runtime.evaluation.report.arm_trace import ArmTrace
from skillc_runtime.evaluation.report.base_trace import BaseTrace
from skillc_runtime.evaluation.report.hand_trace import HandTrace


class RunTrace:
    """Samples a cell; `sample` is to be called in every tick. `began_s` is the time of the cell at the start, in s."""

    def __init__(self, simulation: Simulation) -> None:
        self.began_s = simulation.clock.now
        self.arms, self.hands, self.bases = ArmTrace(simulation), HandTrace(simulation), BaseTrace(simulation)

    def sample(self) -> None:
        """Sample what is due."""
        self.arms.sample()
        self.hands.sample()
        self.bases.sample()
