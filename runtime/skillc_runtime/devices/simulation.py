"""The interface of a simulated cell for reports, trials and films: what skills and real cells do not offer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias

from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.disturbances import Disturber
from skillc_runtime.devices.live import LiveSignals
from skillc_runtime.motion.pose import Array

if TYPE_CHECKING:
    from skillc_runtime.devices.ground_truth import GroundTruth


@dataclass(frozen=True, slots=True)
class Posture:
    """Where everything is at one instant: MuJoCo's qpos (nq,), mocap_pos (m, 3) and mocap_quat (m, 4)."""

    joints: Array
    base_positions: Array
    base_quaternions: Array


IndividualKind: TypeAlias = Literal["arm", "gripper", "base", "tool", "surface", "fixture", "body"]
"""What an individual is in a simulation; a robot is its `base`, and a `body` any other thing."""


@dataclass(frozen=True, slots=True)
class DrawnIndividual:
    """An individual with its short name, and the name in the model of its first body; `movable` if it lies free."""

    label: str
    kind: IndividualKind
    body: str
    movable: bool = False


class Drawing(Protocol):
    """How a simulated cell is drawn: a MuJoCo model, and postures of it."""

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


class Simulation(Backend, Protocol):
    """A backend that knows the true state of its cell, and how it looks."""

    def save(self) -> bytes:
        """Return the true state of the cell, from which it can be built again with everything at rest."""
        ...

    @property
    def ground_truth(self) -> GroundTruth:
        """The true state of the cell."""
        ...

    @property
    def has_physics(self) -> bool:
        """Whether it computes contact and weight, so that what idealised devices read of them counts as verified."""
        ...

    @property
    def things_lie_still(self) -> bool:
        """Whether nothing that no hand holds falls, rolls, tips or slides."""
        ...

    def find_false_claims(self) -> tuple[str, ...]:
        """Return what the world model claims of what is where, and who holds what, that is not so; a sentence each."""
        ...

    @property
    def disturber(self) -> Disturber:
        """Lets things happen to the cell that no skill does."""
        ...

    @property
    def drawing(self) -> Drawing:
        """How the cell is drawn."""
        ...

    @property
    def live(self) -> LiveSignals:
        """What changes in each control period."""
        ...
