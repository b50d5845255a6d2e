"""A simulated camera, which sees the true coverage of surfaces."""

from __future__ import annotations

from collections.abc import Mapping

from skillc_runtime.motion.coverage import CoverageMap


class SimulatedCamera:
    """Implements `Camera` with the coverage of each surface by IRI, which the cell updates."""

    def __init__(self, coverage: Mapping[str, CoverageMap]) -> None:
        self._coverage = coverage

    def inspect(self, surface: str) -> float:
        """Return the share of the surface that is wiped; KeyError if there is no such surface."""
        return self._coverage[surface].wiped_share

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Return the share under a pressed tool for at least `seconds`; KeyError if there is no such surface."""
        return self._coverage[surface].rubbed_share(seconds)
