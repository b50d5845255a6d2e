"""The specification of a simulated scene, as typed values."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Final

import msgspec

from skillc_runtime.backends.simulation.cameras.camera import EXACT_INSPECTION, InspectionSpec
from skillc_runtime.backends.simulation.cameras.camera_spec import CameraSpec
from skillc_runtime.backends.simulation.cameras.image_camera_spec import ImageCameraSpec
from skillc_runtime.backends.simulation.displacement import DisplacementRange
from skillc_runtime.backends.simulation.fixture_spec import FixtureSpec
from skillc_runtime.backends.simulation.people import PersonSpec
from skillc_runtime.devices.arm import Mode
from skillc_runtime.devices.reality import IDEAL_REALITY, Reality
from skillc_runtime.motion.dirt_map import DirtMap
from skillc_runtime.motion.layout import Layout
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import RigidBody
from skillc_runtime.world.space.surfaces import LEAST_FORCE_N
from skillc_runtime.world.state.data_sheet import DataSheet

NOISE_DEVIATIONS: Final = 3.0
"""Standard deviations of noise that count as its greatest error."""


class GripperSpec(msgspec.Struct, frozen=True):
    """A gripper: its model, greatest opening m, force N and finger speed m/s.

    Its sensor measures the opening each `sensing_period_s`, with a constant error up to `opening_bias_m` either way and
    noise with the standard deviation `opening_noise_m`.
    """

    individual: str
    model: Path
    max_opening_m: float
    max_force_n: float
    finger_speed_m_s: float
    opening_bias_m: float = 0.0
    opening_noise_m: float = 0.0
    sensing_period_s: float = 0.0

    @property
    def first_opening_m(self) -> float:
        """The distance of the fingers in m at the start."""
        return self.max_opening_m / 2

    @property
    def opening_error_m(self) -> float:
        """The greatest error of the measured opening in m."""
        return self.opening_bias_m + NOISE_DEVIATIONS * self.opening_noise_m


class ArmSpec(msgspec.Struct, frozen=True):
    """An arm: its base in the world, what it takes, home posture (nv,) rad, its compliant controller, and its sheet.

    Each joint may start `posture_range_rad` off home. Standard deviations of what is measured: joint speed rad/s, force
    N and torque N m at the wrist. reality: how far it is from what it should be.
    """

    individual: str
    robot: str | None
    base: Pose
    model: Path
    modes: tuple[Mode, ...]
    home: Array
    force_torque: bool
    controller: str
    gripper: GripperSpec | None
    sheet: DataSheet
    posture_range_rad: float = 0.0
    joint_speed_noise: float = 0.0
    force_noise_n: float = 0.0
    torque_noise_n_m: float = 0.0
    reality: Reality = IDEAL_REALITY

    @property
    def has_servos(self) -> bool:
        """Whether the arm has its own servos, which take positions or speeds."""
        return "torque" not in self.modes


class BaseSpec(msgspec.Struct, frozen=True):
    """A mobile base: pose in the world, size (3,) m, speed m/s, acceleration m/s^2, turn rate rad/s, rad/s^2."""

    individual: str
    pose: Pose
    size: Array
    speed: float
    acceleration: float
    turn_speed: float
    turn_acceleration: float


class ToolSpec(msgspec.Struct, frozen=True):
    """A tool: the frame in the middle of its block in the world, size (3,) m of the block, mass kg, its sheet.

    Its working face may be stiffer or softer than its sheet says by the share `stiffness_range`; that of a rigid one
    does not yield.
    """

    individual: str
    model: Path
    pose: Pose
    size: Array
    mass_kg: float
    sheet: DataSheet
    stiffness_range: float = 0.0
    rigid: bool = False
    reality: Reality = IDEAL_REALITY


class SurfaceSpec(msgspec.Struct, frozen=True):
    """A surface at its assumed pose, and the ranges of true values: m along the normal, rad, friction.

    `layout` gives the area to work on; a tool works if it is pressed with at least `least_n` N. `dirt` is the map of
    where it is dirty; None where all of it is. Dirt falls to 1/e in each `removal_s` under a tool, and rubs with the
    share `dirt_friction` of the friction of the clean surface.
    """

    individual: str
    pose: Pose
    size: Array
    layout: Layout
    friction: tuple[float, float]
    offset_range_m: float
    tilt_range_rad: float
    least_n: float = LEAST_FORCE_N
    dirt: DirtMap | None = None
    removal_s: float = 0.0
    dirt_friction: float = 1.0


class SceneSpec(msgspec.Struct, frozen=True):
    """Everything that is built, each kind in order of IRI; `names` are the short names of all individuals.

    mounted: the mobile robots that carry fixed bodies, by IRI of the body.
    """

    names: dict[str, str]
    arms: tuple[ArmSpec, ...]
    bases: tuple[BaseSpec, ...]
    tools: tuple[ToolSpec, ...]
    surfaces: tuple[SurfaceSpec, ...]
    bodies: tuple[RigidBody, ...]
    mounted: Mapping[str, str]
    fixtures: tuple[FixtureSpec, ...] = ()
    people: tuple[PersonSpec, ...] = ()
    cameras: tuple[CameraSpec, ...] = ()
    inspection: InspectionSpec = EXACT_INSPECTION
    image_camera: ImageCameraSpec | None = None
    displaced: tuple[DisplacementRange, ...] = ()

    @property
    def movable(self) -> tuple[RigidBody, ...]:
        """The bodies that lie free."""
        return tuple(body for body in self.bodies if body.movable)

    @property
    def graspable(self) -> tuple[ToolSpec | RigidBody, ...]:
        """What a gripper can hold."""
        return (*self.tools, *self.movable)
