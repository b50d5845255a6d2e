"""The greatest force that a tool felt: of all its contacts together, as a vector."""

from __future__ import annotations

from math import sqrt
from typing import Any

from skillc_runtime.simulation.names import contact_sensor


class PeakForce:
    """The greatest length so far of the sum of contact forces on one tool that is held, N.

    The fingers that hold it are not among them: a weld keeps it, and their contacts do not count meanwhile.
    """

    def __init__(self, tool: str, model: Any, data: Any) -> None:
        """Look at a tool of that name in the model."""
        first = int(model.sensor(contact_sensor(tool)).adr[0])
        self._force = data.sensordata[first : first + 3]
        self._square = 0.0

    @property
    def newton(self) -> float:
        """The greatest force so far in N."""
        return sqrt(self._square)

    def sample(self) -> None:
        """Take in one step."""
        self._square = max(self._square, float(self._force.dot(self._force)))
