"""The geometry of a cell as values, for displays: bodies with joints and shapes, as MuJoCo has them, in SI units."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc.contract.sample import PoseNumbers

Vector: TypeAlias = tuple[float, float, float]
Shape: TypeAlias = Literal["plane", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh"]
IndividualKind: TypeAlias = Literal["arm", "gripper", "base", "tool", "surface", "fixture", "body"]
JointKind: TypeAlias = Literal["free", "ball", "slide", "hinge"]


class ModelGeom(msgspec.Struct, frozen=True):
    """A shape at a pose in its body; `colour` is red, green, blue and opacity from 0 to 1.

    `size`: half the extent of boxes and ellipsoids; radius and half the length along z, without the ends, of cylinders
    and capsules; radius of spheres. `mesh` is the number of a mesh.
    """

    shape: Shape
    size: Vector
    pose: PoseNumbers
    colour: tuple[float, float, float, float]
    mesh: int | None = None


class ModelJoint(msgspec.Struct, frozen=True):
    """A joint between a body and its parent: it turns about, or slides along, `axis` through `anchor` in the body.

    `rest` is its value, in rad or m, with which the body has its own pose in the parent.
    """

    name: str
    kind: JointKind
    axis: Vector
    anchor: Vector
    rest: float


class ModelBody(msgspec.Struct, frozen=True):
    """A body after its parent, whose number is -1 for the world, at a pose in the parent while its joints rest.

    `individual` is the IRI of what it is a part of; None for the floor.
    """

    name: str
    parent: int
    pose: PoseNumbers
    joints: tuple[ModelJoint, ...]
    geoms: tuple[ModelGeom, ...]
    individual: str | None


class ModelMesh(msgspec.Struct, frozen=True):
    """Points in m, three numbers each, and triangles, three numbers of points each."""

    points: tuple[float, ...]
    triangles: tuple[int, ...]


class ModelIndividual(msgspec.Struct, frozen=True):
    """An individual with its short name, whose own frame is at the pose `frame` in the body with a number.

    What is `movable` can be moved by a disturbance while nothing holds it.
    """

    label: str
    kind: IndividualKind
    body: int
    frame: PoseNumbers
    movable: bool = False


class ModelArm(msgspec.Struct, frozen=True):
    """An arm: samples have the frame of its individual as `base`, and the angles of `joints`, which are names."""

    joints: tuple[str, ...]


class CellModel(msgspec.Struct, frozen=True):
    """The geometry of a cell as it really is, empty if it cannot be drawn; individuals and arms are by IRI."""

    bodies: tuple[ModelBody, ...]
    meshes: tuple[ModelMesh, ...]
    individuals: dict[str, ModelIndividual]
    arms: dict[str, ModelArm]


class SurfaceCoverage(msgspec.Struct, frozen=True):
    """How long tools have really worked on each cell of a surface of `size` in m, about its middle.

    `dose` has a byte a cell, first along x, then along y: the time in units of `unit_s`, at most 255; empty for none.
    """

    size: tuple[float, float]
    columns: int
    rows: int
    unit_s: float
    dose: bytes


Poses: TypeAlias = dict[str, PoseNumbers]
Coverage: TypeAlias = dict[str, SurfaceCoverage]
