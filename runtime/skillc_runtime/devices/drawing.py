"""How a cell is drawn: a model of its bodies, and where everything is at one instant."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, Protocol, TypeAlias

import msgspec

from skillc_runtime.motion.pose import Array


class Posture(msgspec.Struct, frozen=True):
    """Where everything is at one instant: MuJoCo's qpos (nq,), mocap_pos (m, 3) and mocap_quat (m, 4)."""

    joints: Array
    base_positions: Array
    base_quaternions: Array


IndividualKind: TypeAlias = Literal["arm", "gripper", "base", "tool", "surface", "fixture", "body"]
"""What an individual is in a drawn cell; a robot is its `base`, and a `body` any other thing."""


class DrawnIndividual(msgspec.Struct, frozen=True):
    """An individual with its short name, and the name in the model of its first body; `movable` if it lies free."""

    label: str
    kind: IndividualKind
    body: str
    movable: bool = False


class Drawing(Protocol):
    """How a cell is drawn: a MuJoCo model, and postures of it."""

    @property
    def model(self) -> Any:
        """The `mujoco.MjModel` of the cell."""
        ...

    @property
    def prefixes(self) -> Mapping[str, str]:
        """The prefix of the names in the model of all parts of an arm or gripper, by IRI."""
        ...

    @property
    def surfaces(self) -> Mapping[str, str]:
        """The name in the model of the geom of each surface that is really there, by IRI."""
        ...

    @property
    def individuals(self) -> Mapping[str, DrawnIndividual]:
        """What has bodies in the model, by IRI."""
        ...

    def posture(self) -> Posture:
        """Return a copy of the present posture."""
        ...

    def describe_model(self) -> Any:
        """Return a new `mujoco.MjSpec` of the model, to be changed and compiled."""
        ...
