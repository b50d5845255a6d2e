"""What a camera would see of the surfaces: how much of them is wiped, in truth."""

from __future__ import annotations

from collections.abc import Mapping

from skillc_runtime.backends.mujoco.coverage import CoverageMap


class SimulatedCamera:
    """Implements `Camera` from the coverage of each surface by IRI, which the running cell keeps up to date."""

    def __init__(self, coverage: Mapping[str, CoverageMap]) -> None:
        self._coverage = coverage

    def inspect(self, surface: str) -> float:
        """Return the share of the surface that is wiped; KeyError for a surface that is not there."""
        return self._coverage[surface].wiped_share

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Return the share that was under a pressed tool for so long; KeyError for a surface that is not there."""
        return self._coverage[surface].rubbed_share(seconds)
