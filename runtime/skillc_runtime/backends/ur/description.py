"""An arm of Universal Robots as its control process gets it, pickled."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.backends.control_process.link import RobotLink
from skillc_runtime.backends.ur.facts import UrFacts
from skillc_runtime.backends.ur.library import load_library


@dataclass(frozen=True, slots=True)
class UrDescription:
    """One arm, implementing `LinkDescription`."""

    facts: UrFacts

    @property
    def name(self) -> str:
        """The arm and its address."""
        return self.facts.name

    def make_link(self) -> RobotLink:
        """Return a link that is not connected; BackendUnavailable without ur-rtde."""
        for module in ("rtde_control", "rtde_receive"):
            load_library(module)
        from skillc_runtime.backends.ur.link import UrLink

        return UrLink(self.facts)
