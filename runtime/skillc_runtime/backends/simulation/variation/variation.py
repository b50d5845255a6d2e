"""The differences between a simulated run and the world model, drawn from ranges in the facts and a seed."""

from __future__ import annotations

from collections.abc import Mapping
from math import hypot

import msgspec
import numpy as np
from msgspec.structs import replace

from skillc_runtime.backends.simulation.arms.start_postures import draw_start
from skillc_runtime.backends.simulation.displacement import Displacement, draw_displacement
from skillc_runtime.backends.simulation.people import PersonVariation, draw_person
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec, SurfaceSpec, ToolSpec
from skillc_runtime.backends.simulation.signed import format_signed, format_tilt
from skillc_runtime.backends.simulation.variation.fixture_variation import FixtureVariation, draw_fixture, exact_fixture
from skillc_runtime.devices.reality import ARM_KINDS, TOOL_KINDS, Sizes, describe_sizes, draw_sizes
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Array, Pose, exp

OBSTACLE_M = (0.03, 0.03, 0.012)
"""Size of an obstacle that the world model does not have, such as a magnet on a surface."""

LEAST_MASS_SHARE = 0.5
"""The share of its weight that a tool keeps at least, however wrong this is: contacts of what hardly has a mass are
those of no real tool."""

OBSTACLE_SHARE = 0.5
"""An obstacle lies within this share of the surface, around its centre."""


class Obstacle(msgspec.Struct, frozen=True):
    """A box on a surface: its position (2,) in m along the surface's x and y, and its size (3,) in m."""

    place: tuple[float, float]
    size: tuple[float, float, float] = OBSTACLE_M


class SurfaceVariation(msgspec.Struct, frozen=True):
    """One surface: the offset in m along its assumed normal, the tilt in rad about its assumed x and y, its friction.

    present: false if it is absent; obstacle: a box on it that the world model does not have.
    """

    surface: str
    offset_m: float
    tilt_rad: tuple[float, float]
    friction: float
    present: bool = True
    obstacle: Obstacle | None = None

    def true_pose(self, believed: Pose) -> Pose:
        """Return the true pose of the surface, in the frame of the assumed one."""
        tilt = exp(np.array([*self.tilt_rad, 0.0]))
        return believed @ Pose(np.array([0.0, 0.0, self.offset_m]), tilt)

    @property
    def description(self) -> str:
        """The differences as text."""
        x, y = np.degrees(self.tilt_rad)
        offset = f"{format_signed(self.offset_m * 1e3, 1)} mm along its normal"
        return f"{offset}{format_tilt(x, y)}, friction {self.friction:.2f}"


class Variation(msgspec.Struct, frozen=True):
    """All differences of one simulated run.

    start_rad: offsets of the joints of an arm from home at the start; pad_share: relative difference of the stiffness
    of a tool's working face from its sheet; imperfections: those of arms and tools; all by IRI. Fixtures and people are
    in the order of the scene.
    """

    seed: int
    surfaces: tuple[SurfaceVariation, ...]
    start_rad: Mapping[str, tuple[float, ...]]
    pad_share: Mapping[str, float]
    fixtures: tuple[FixtureVariation, ...] = ()
    people: tuple[PersonVariation, ...] = ()
    displacements: tuple[Displacement, ...] = ()
    imperfections: Mapping[str, Sizes] = msgspec.field(default_factory=dict)

    def true_pose(self, thing: str, believed: Pose) -> Pose:
        """Return where a thing really is at the start, in the world."""
        found = (each for each in self.displacements if each.individual == thing)
        return next((each.true_pose(believed) for each in found), believed)

    def of(self, surface: str) -> SurfaceVariation:
        """Return the difference of one surface; KeyError when it has none."""
        for one in self.surfaces:
            if one.surface == surface:
                return one
        raise KeyError(surface)

    def start(self, arm: ArmSpec) -> Array:
        """Return the start posture (nv,) in rad of an arm."""
        return np.asarray(arm.home + self.start_rad[arm.individual], dtype=np.float64)

    def pad_stiffness(self, tool: ToolSpec) -> float:
        """Return the true stiffness of the working face of a tool in N/m."""
        (factor,) = self.sizes(tool).get("padStiffnessFactor", (1.0,))
        return tool.sheet.number("padStiffness") * (1.0 + self.pad_share[tool.individual]) * factor

    def mass(self, tool: ToolSpec) -> float:
        """Return the true mass of a tool in kg, at least half of what it is believed to be."""
        (error,) = self.sizes(tool).get("massError", (0.0,))
        return max(tool.mass_kg + error, LEAST_MASS_SHARE * tool.mass_kg)

    def sizes(self, device: ArmSpec | ToolSpec) -> Sizes:
        """Return the imperfections of a device."""
        return self.imperfections.get(device.individual, {})

    def describe(self, names: Mapping[str, str]) -> str:
        """Return the differences as text; `names` are the short names of individuals."""
        surfaces = (f"{names[each.surface]} {each.description}" for each in self.surfaces)
        fixtures = (f"{names[each.fixture]} {each.description}" for each in self.fixtures)
        people = (f"{names[each.person]} {each.description}" for each in self.people)
        things = (f"{names[each.individual]} {each.description}" for each in self.displacements)
        devices = (f"{names[each]} {describe_sizes(sizes)}" for each, sizes in self.imperfections.items() if sizes)
        return "; ".join((*surfaces, *fixtures, *people, *things, *devices))


def draw_variation(scene: SceneSpec, seed: int) -> Variation:
    """Draw the differences uniformly within the ranges of the facts, independently for each individual."""
    unsure_m = max(map(_unsure_m, scene.surfaces), default=0.0)
    return Variation(
        seed,
        tuple(_draw(surface, seed) for surface in scene.surfaces),
        {arm.individual: draw_start(arm, seed, unsure_m) for arm in scene.arms},
        {tool.individual: _pad(tool, seed) for tool in scene.tools},
        tuple(draw_fixture(fixture, seed) for fixture in scene.fixtures),
        tuple(draw_person(person, seed) for person in scene.people),
        tuple(draw_displacement(each, seed) for each in scene.displaced),
        _draw_imperfections(scene, seed),
    )


def _draw_imperfections(scene: SceneSpec, seed: int) -> dict[str, Sizes]:
    arms = {
        each.individual: draw_sizes(
            each.individual,
            each.sheet,
            each.reality,
            [kind for kind in ARM_KINDS if each.force_torque or not kind.at_wrist],
            each.home.size,
            seed,
        )
        for each in scene.arms
    }
    tools = {
        each.individual: draw_sizes(each.individual, each.sheet, each.reality, TOOL_KINDS, 0, seed)
        for each in scene.tools
    }
    return {individual: sizes for individual, sizes in (arms | tools).items() if sizes}


def exact_variation(scene: SceneSpec) -> Variation:
    """Return no differences: everything is as the facts say, with mean friction."""
    return Variation(
        0,
        tuple(SurfaceVariation(s.individual, 0.0, (0.0, 0.0), sum(s.friction) / 2) for s in scene.surfaces),
        {arm.individual: (0.0,) * arm.home.size for arm in scene.arms},
        {tool.individual: 0.0 for tool in scene.tools},
        tuple(exact_fixture(fixture) for fixture in scene.fixtures),
        tuple(PersonVariation(each.individual, (0.0, 0.0, 0.0), each.strength_n) for each in scene.people),
    )


def make_all_absent(variation: Variation) -> Variation:
    """Return the same variation without surfaces, fixtures and people."""
    return replace(
        variation,
        surfaces=tuple(replace(each, present=False) for each in variation.surfaces),
        fixtures=tuple(replace(each, present=False) for each in variation.fixtures),
        people=tuple(replace(each, present=False) for each in variation.people),
    )


def add_obstacles(variation: Variation, scene: SceneSpec) -> Variation:
    """Return the same variation with an obstacle on each surface and in each fixture."""
    littered = (replace(variation.of(s.individual), obstacle=_obstacle(s, variation.seed)) for s in scene.surfaces)
    blocked = (replace(each, blocked=True) for each in variation.fixtures)
    return replace(variation, surfaces=tuple(littered), fixtures=tuple(blocked))


def _unsure_m(surface: SurfaceSpec) -> float:
    """Return how far in m a point of a surface may be from where it is believed to be."""
    return surface.offset_range_m + surface.tilt_range_rad * hypot(*surface.size[:2]) / 2


def _draw(surface: SurfaceSpec, seed: int) -> SurfaceVariation:
    rng = rng_for(surface.individual, seed)
    offset, tilt_x, tilt_y = rng.uniform(-1.0, 1.0, 3)
    return SurfaceVariation(
        surface=surface.individual,
        offset_m=float(offset) * surface.offset_range_m,
        tilt_rad=(float(tilt_x) * surface.tilt_range_rad, float(tilt_y) * surface.tilt_range_rad),
        friction=float(rng.uniform(*surface.friction)),
    )


def _pad(tool: ToolSpec, seed: int) -> float:
    return float(rng_for(tool.individual, seed).uniform(-1.0, 1.0)) * tool.stiffness_range


def _obstacle(surface: SurfaceSpec, seed: int) -> Obstacle:
    share = rng_for(surface.individual, seed, 1).uniform(-OBSTACLE_SHARE / 2, OBSTACLE_SHARE / 2, 2)
    x, y = (share * surface.size[:2]).tolist()
    return Obstacle((x, y))
