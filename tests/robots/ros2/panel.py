"""What a test asks a simulated robot from outside: what is true there, and to put a wall before the tool."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from robots.truth import serve_truth
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.motion.pose import Array

if TYPE_CHECKING:
    from robots.ros2.peer import Peer


class Panel:
    """The methods of `GroundTruth` of the cell, and those of `backends.remote.Surroundings`."""

    def __init__(self, peer: Peer, file: Path) -> None:
        """Answer at a socket `file`."""
        self._peer, self._truth = peer, peer.cell.capabilities.truth
        serve_truth(file, self, lambda: peer.cell.now)

    def __getattr__(self, name: str) -> Any:
        found = getattr(self._truth, name)

        def ask(*arguments: object) -> Any:
            with self._peer.lock:
                return found(*arguments)

        return ask

    def home(self) -> Array:
        """Return the home (nv,) of the first arm in rad."""
        return self._peer.cell.scene.arms[0].home

    def put_wall(self, gap_m: float) -> Array:
        """Put a soft wall before the tool of the first arm."""
        from backends.backend import Wall

        cell, facts = self._peer.cell, self._peer.cell.scene.arms[0]
        assert facts.gripper is not None
        palm = part_name(cell.scene.names[facts.gripper.individual], "palm")
        with self._peer.lock:
            wall = Wall(cell, cell.arms[facts.individual], palm, gap_m)
            cell.people = (wall,)  # type: ignore[assignment]
        return wall.normal

    def remove_wall(self) -> None:
        """Take it away."""
        with self._peer.lock:
            self._peer.cell.people = ()
            self._peer.cell.data.xfrc_applied[:] = 0.0

    def wall_force_n(self) -> float:
        """Return with how much the tool presses on it."""
        people: Any = self._peer.cell.people
        return float(people[0].force_n) if people else 0.0

    def violations(self) -> Sequence[str]:
        """Return which commands were beyond limits."""
        return self._peer.report.examples
