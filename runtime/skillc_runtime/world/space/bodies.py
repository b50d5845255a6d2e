"""The bodies of a world: what has a size and a pose exists, with a shape, a mass, a friction and a colour."""

from __future__ import annotations

from typing import Final, TypeAlias

import msgspec
from msgspec.structs import replace

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.drawers import Slide, read_slide
from skillc_runtime.world.space.frame_tree import Unplaced
from skillc_runtime.world.space.frames import pose, relative_pose, size
from skillc_runtime.world.space.shape.extents import FRAME_HEIGHT
from skillc_runtime.world.space.shape.mesh_file import read_mesh
from skillc_runtime.world.space.shape.shapes import (
    BIN_WALL_M,
    SHELF_BOARDS,
    SHELF_WALL_M,
    TABLE_WALL_M,
    Bin,
    Box,
    Capsule,
    Cylinder,
    Panel,
    Shape,
    ShapeError,
    Shelf,
    Sphere,
    Table,
    solids_of,
)
from skillc_runtime.world.space.shape.solids import Size, Solid, centre_of
from skillc_runtime.world.state.data_sheet import SheetError, number_of, text_of, triple_of
from skillc_runtime.world.state.terms import (
    AREA,
    ARM_DEVICE,
    BOARDS,
    CENTRE_OF_MASS,
    COLOUR,
    CONTAINER,
    DENSITY,
    END_EFFECTOR,
    FIXTURE,
    FRICTION,
    FURNITURE,
    HAS_OPENING,
    MANIPULATABLE,
    MESH,
    PERSON,
    ROBOT,
    SENSOR,
    SHAPE,
    SIZE,
    SURFACE,
    TOOL,
    TRANSFORMATION_POSE,
    WALL_THICKNESS,
    WEIGHT,
    WORKSPACE,
    WORKSTATION,
)
from skillc_runtime.world.state.world_state import WorldState

Colour: TypeAlias = tuple[float, float, float, float]

REGIONS: Final = (WORKSPACE, AREA, WORKSTATION, TRANSFORMATION_POSE)
"""Classes of what is a part of space, not a body."""

MODELLED: Final = (ROBOT, ARM_DEVICE, END_EFFECTOR, SENSOR, SURFACE, FIXTURE, TOOL, PERSON)
"""Classes of what a simulation models in another way: from data sheets, or as a surface."""

FRICTION_UNLESS_STATED = 0.6
"""Wood on wood."""

DENSITY_UNLESS_STATED = 1000.0
"""Water, kg/m^3."""

WOOD: Final[Colour] = (0.62, 0.52, 0.4, 1.0)
PLASTIC: Final[Colour] = (0.35, 0.5, 0.65, 1.0)
GOODS: Final[Colour] = (0.85, 0.55, 0.2, 1.0)


class RigidBody(msgspec.Struct, frozen=True, eq=False):
    """A thing that exists: its shape, the convex solids of it in its frame, mass in kg, centre of mass (3,) in m.

    pose: in the world, of the thing's frame, which for furniture lies in the middle of the top, for all others in the
    middle of the bounding box. friction: sliding, without unit. colour: red, green, blue and opacity, 0 to 1.
    movable: whether it lies free, as things to handle do; all others are fixed where they are, but for drawers, which
    have a `slide`.
    """

    individual: str
    pose: Pose
    shape: Shape
    solids: tuple[Solid, ...]
    mass_kg: float
    centre: Array
    friction: float
    colour: Colour
    movable: bool
    slide: Slide | None = None

    @property
    def size(self) -> Array:
        """The size (3,) in m of the bounding box."""
        return np.array(self.shape.size)


def read_bodies(state: WorldState) -> tuple[RigidBody, ...]:
    """Return all bodies in order of IRI; errors as of `read_body`."""
    sized = sorted({each for name in SIZE if (values := state.stored.get(name)) for each, _ in values.items()})
    return tuple(body for each in sized if (body := read_body(state, each)) is not None)


def read_body(state: WorldState, individual: str) -> RigidBody | None:
    """Return the body of a thing; None if it has none: no size, no known pose, a part of space, or a model of its own.

    MissingFact if a part of its size is missing, FrameError if its pose is contradictory, SheetError if its shape is
    impossible.
    """
    if not has_body(state, individual):
        return None
    shape = read_shape(state, individual)
    try:
        place = pose(state, individual)
    except Unplaced:
        return None
    solids = _in_own_frame(state, individual, shape)
    return RigidBody(
        individual=individual,
        pose=place,
        shape=shape,
        solids=solids,
        mass_kg=_mass_kg(state, individual, solids),
        centre=_centre(state, individual, solids),
        friction=number_of(state, individual, FRICTION, default=FRICTION_UNLESS_STATED),
        colour=_colour(state, individual),
        movable=state.is_a(individual, MANIPULATABLE),
        slide=read_slide(state, individual),
    )


def has_body(state: WorldState, individual: str) -> bool:
    """Whether a thing has a body as soon as its pose is known: it has a size, and is neither a region nor modelled."""
    sized = any(state.value(individual, name) is not None for name in SIZE)
    return sized and not any(state.is_a(individual, cls) for cls in (*REGIONS, *MODELLED))


def read_solids(state: WorldState, individual: str) -> tuple[Solid, ...]:
    """Return the solids of a thing in its own frame, wherever it is; MissingFact or SheetError if it has no shape."""
    return _in_own_frame(state, individual, read_shape(state, individual))


def read_shape(state: WorldState, individual: str) -> Shape:
    """Return the shape that a thing states, else that of its class; MissingFact or SheetError if it has no such."""
    x, y, z = size(state, individual).tolist()
    try:
        return _shape(state, individual, (x, y, z))
    except ShapeError as error:
        raise SheetError(f"{state.vocabulary.short(individual)} {error}") from error


def _shape(state: WorldState, individual: str, size: Size) -> Shape:
    match state.value(individual, SHAPE) or ("bin" if state.is_a(individual, CONTAINER) else "box"):
        case "box":
            return Box(size)
        case "cylinder":
            return Cylinder(size)
        case "sphere":
            return Sphere(size)
        case "capsule":
            return Capsule(size)
        case "bin":
            return Bin(size, number_of(state, individual, WALL_THICKNESS, default=BIN_WALL_M))
        case "shelf":
            boards = number_of(state, individual, BOARDS, default=SHELF_BOARDS)
            return Shelf(size, number_of(state, individual, WALL_THICKNESS, default=SHELF_WALL_M), int(boards))
        case "table":
            return Table(size, number_of(state, individual, WALL_THICKNESS, default=TABLE_WALL_M))
        case "panel":
            return Panel(size, tuple(_opening(state, individual, each) for each in _openings(state, individual)))
        case "mesh" | "hull" as kind:
            return read_mesh(text_of(state, individual, MESH), size, kind == "hull")
        case other:
            raise ShapeError(f"has the shape {other!r}, which does not exist")


def _openings(state: WorldState, panel: str) -> list[str]:
    return sorted(state.objects(panel, HAS_OPENING))


def _opening(state: WorldState, panel: str, opening: str) -> tuple[float, float, float, float]:
    """Return the smallest rectangle along the axes of a panel that contains an opening: middle and size in m."""
    place, extent = relative_pose(state, panel, opening), [number_of(state, opening, name) for name in SIZE[:2]]
    width, depth = (np.abs(place.rotation[:2, :2]) @ extent).tolist()
    return float(place.position[0]), float(place.position[1]), width, depth


def _in_own_frame(state: WorldState, individual: str, shape: Shape) -> tuple[Solid, ...]:
    try:
        solids = solids_of(shape)
    except ShapeError as error:
        raise SheetError(f"{state.vocabulary.short(individual)} {error}") from error
    share = next((share for cls, share in FRAME_HEIGHT.items() if state.is_a(individual, cls)), 0.0)
    middle = Pose.of((0.0, 0.0, -share * shape.size[2]))
    return tuple(replace(each, place=middle @ each.place) for each in solids)


def _mass_kg(state: WorldState, individual: str, solids: tuple[Solid, ...]) -> float:
    density = number_of(state, individual, DENSITY, default=DENSITY_UNLESS_STATED)
    return number_of(state, individual, WEIGHT, default=density * sum(each.volume for each in solids))


def _centre(state: WorldState, individual: str, solids: tuple[Solid, ...]) -> Array:
    stated = triple_of(state, individual, CENTRE_OF_MASS)
    return centre_of(solids) if stated is None else np.array(stated)


def _colour(state: WorldState, individual: str) -> Colour:
    stated = triple_of(state, individual, COLOUR)
    if stated is not None:
        return (*stated, 1.0)
    if state.is_a(individual, MANIPULATABLE):
        return GOODS
    return WOOD if state.is_a(individual, FURNITURE) else PLASTIC
