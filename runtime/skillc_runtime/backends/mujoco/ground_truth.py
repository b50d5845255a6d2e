"""What really happens in a simulated cell."""

from __future__ import annotations

from collections.abc import Mapping

from skillc_runtime.backends.mujoco.observer import ToolObserver
from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.motion.pose import Pose


class SimulatedTruth:
    """Implements `GroundTruth` from what observers saw of tools and where surfaces were put."""

    def __init__(self, observers: Mapping[str, ToolObserver], surfaces: Mapping[str, Pose]) -> None:
        self._observers, self._surfaces = observers, surfaces

    def recording(self, tool: str) -> Recording:
        """Return what was recorded of a tool while it was held; KeyError where the cell has no such tool."""
        return self._observers[tool].recorder.recording()

    def peak_force_n(self, tool: str) -> float:
        """Return the greatest force on a tool while it was held; KeyError where the cell has no such tool."""
        return self._observers[tool].peak_force.newton

    def surface_pose(self, surface: str) -> Pose:
        """Return where a surface really is, in the world; KeyError where the cell has no such surface."""
        return self._surfaces[surface]
