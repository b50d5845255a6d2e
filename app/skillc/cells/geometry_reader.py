"""Reads the geometry of a cell from the MuJoCo model with which it is drawn, and what its tools have worked on."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, assert_never

import msgspec
import mujoco
import numpy as np

from skillc.contract.geometry import (
    CellModel,
    JointKind,
    ModelArm,
    ModelBody,
    ModelGeom,
    ModelIndividual,
    ModelJoint,
    ModelMesh,
    Shape,
    SurfaceCoverage,
    Vector,
)
from skillc.contract.sample import PoseNumbers
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.drawing import Drawing, DrawnIndividual, IndividualKind
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.devices.live import LiveSignals
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.pose import Array, Pose

SHOWN_GROUPS = 3
"""MuJoCo shows the first groups of geoms; those of others are for collisions only."""

UNIT_S = 0.02
"""The unit of the dose of a cell of a surface."""

UNSTATED = np.array([0.5, 0.5, 0.5, 1.0], dtype=np.float32)
"""The colour with which MuJoCo marks geoms that state none."""

_Geom, _Joint = mujoco.mjtGeom, mujoco.mjtJoint
_SHAPES: Mapping[int, Shape] = {
    int(_Geom.mjGEOM_PLANE): "plane",
    int(_Geom.mjGEOM_SPHERE): "sphere",
    int(_Geom.mjGEOM_CAPSULE): "capsule",
    int(_Geom.mjGEOM_ELLIPSOID): "ellipsoid",
    int(_Geom.mjGEOM_CYLINDER): "cylinder",
    int(_Geom.mjGEOM_BOX): "box",
    int(_Geom.mjGEOM_MESH): "mesh",
}
_KINDS: Mapping[int, JointKind] = {
    int(_Joint.mjJNT_FREE): "free",
    int(_Joint.mjJNT_BALL): "ball",
    int(_Joint.mjJNT_SLIDE): "slide",
    int(_Joint.mjJNT_HINGE): "hinge",
}


class GeometryReader:
    """Reads the geometry of a cell between its ticks, as MessagePack."""

    def __init__(self, backend: Backend) -> None:
        self._backend = backend
        self._model = b""

    def take_model(self) -> bytes:
        """Return the encoded geometry, which stays the same."""
        self._model = self._model or msgspec.msgpack.encode(read_geometry(self._backend))
        return self._model

    def take_coverage(self) -> bytes:
        """Return where tools have really worked until now, encoded, by IRI of the surface."""
        return msgspec.msgpack.encode(read_coverage(self._backend))


def read_geometry(backend: Backend) -> CellModel:
    """Return the geometry of a cell, empty if it cannot be drawn; its bodies keep their numbers of the model."""
    drawing, live = backend.capabilities.drawing, backend.capabilities.live
    if drawing is None or live is None:
        return CellModel(bodies=(), meshes=(), individuals={}, arms={})
    model, drawn, truth = drawing.model, drawing.individuals, backend.capabilities.truth
    owners = _find_owners(model, drawn)
    meshes = sorted({int(model.geom_dataid[each]) for each in range(model.ngeom) if _shape(model, each) == "mesh"})
    numbers = {mesh: number for number, mesh in enumerate(meshes)}
    return CellModel(
        bodies=tuple(_read_body(model, body, owners[body], numbers) for body in range(model.nbody)),
        meshes=tuple(_read_mesh(model, each) for each in meshes),
        individuals={iri: _read_individual(drawing, live, truth, iri) for iri in drawn},
        arms={iri: _read_arm(drawing, iri) for iri, each in drawn.items() if each.kind == "arm"},
    )


def read_coverage(backend: Backend) -> dict[str, SurfaceCoverage]:
    """Return how long tools have really worked on each surface of a cell, by IRI; none if that is not known."""
    drawing, truth = backend.capabilities.drawing, backend.capabilities.truth
    if drawing is None or truth is None:
        return {}
    return {each: _read_dose(truth.coverage(each)) for each in drawing.surfaces}


def _read_dose(coverage: CoverageMap) -> SurfaceCoverage:
    rows, columns = coverage.dose.shape
    width, height = map(float, coverage.size)
    units = np.ceil(np.minimum(coverage.dose / UNIT_S, 255)).astype(np.uint8)
    return SurfaceCoverage((width, height), columns, rows, UNIT_S, units.tobytes() if units.any() else b"")


def _find_owners(model: Any, drawn: Mapping[str, DrawnIndividual]) -> list[str | None]:
    """Return the individual that each body is a part of: its own, or else that of its parent or by its name."""
    own = {int(model.body(each.body).id): iri for iri, each in drawn.items()}
    labels = {each.label: iri for iri, each in drawn.items()}
    owners: list[str | None] = [None]
    for body in range(1, model.nbody):
        named = labels.get(model.body(body).name.partition("/")[0])
        owners.append(own.get(body) or owners[model.body_parentid[body]] or named)
    return owners


def _read_body(model: Any, body: int, owner: str | None, meshes: Mapping[int, int]) -> ModelBody:
    joints, geoms = int(model.body_jntadr[body]), int(model.body_geomadr[body])
    shown = (each for each in range(geoms, geoms + model.body_geomnum[body]) if _is_shown(model, each))
    return ModelBody(
        name=model.body(body).name,
        parent=int(model.body_parentid[body]) if body else -1,
        pose=_pose(model.body_pos[body], model.body_quat[body]),
        joints=tuple(_read_joint(model, each) for each in range(joints, joints + model.body_jntnum[body])),
        geoms=tuple(_read_geom(model, each, meshes) for each in shown),
        individual=owner,
    )


def _read_joint(model: Any, joint: int) -> ModelJoint:
    return ModelJoint(
        name=model.joint(joint).name,
        kind=_KINDS[int(model.jnt_type[joint])],
        axis=_vector(model.jnt_axis[joint]),
        anchor=_vector(model.jnt_pos[joint]),
        rest=float(model.qpos0[model.jnt_qposadr[joint]]),
    )


def _shape(model: Any, geom: int) -> Shape | None:
    return _SHAPES.get(int(model.geom_type[geom]))


def _is_shown(model: Any, geom: int) -> bool:
    is_visible = model.geom_group[geom] < SHOWN_GROUPS and model.geom_rgba[geom, 3] > 0
    return bool(is_visible) and _shape(model, geom) is not None


def _read_geom(model: Any, geom: int, meshes: Mapping[int, int]) -> ModelGeom:
    red, green, blue, opacity = _find_colour(model, geom).tolist()
    return ModelGeom(
        shape=_SHAPES[int(model.geom_type[geom])],
        size=_vector(model.geom_size[geom]),
        pose=_pose(model.geom_pos[geom], model.geom_quat[geom]),
        colour=(red, green, blue, opacity),
        mesh=meshes.get(int(model.geom_dataid[geom])),
    )


def _find_colour(model: Any, geom: int) -> Array:
    """Return the colour (4,) of a geom; one that states none has that of its material."""
    own, material = model.geom_rgba[geom], int(model.geom_matid[geom])
    colour: Array = model.mat_rgba[material] if material >= 0 and np.all(own == UNSTATED) else own
    return colour


def _read_mesh(model: Any, mesh: int) -> ModelMesh:
    points, faces = int(model.mesh_vertadr[mesh]), int(model.mesh_faceadr[mesh])
    return ModelMesh(
        points=tuple(model.mesh_vert[points : points + model.mesh_vertnum[mesh]].ravel().tolist()),
        triangles=tuple(model.mesh_face[faces : faces + model.mesh_facenum[mesh]].ravel().tolist()),
    )


def _read_individual(drawing: Drawing, live: LiveSignals, truth: GroundTruth | None, iri: str) -> ModelIndividual:
    drawn = drawing.individuals[iri]
    body = int(drawing.model.body(drawn.body).id)
    positions, quaternions = (np.frombuffer(read()) for read in (live.bodies.positions, live.bodies.quaternions))
    there = Pose.of(positions[3 * body : 3 * body + 3], quaternions[4 * body : 4 * body + 4])
    frame = there.inverse() @ _find_pose(live, truth, iri, drawn.kind, there)
    return ModelIndividual(drawn.label, drawn.kind, body, frame.numbers, drawn.movable)


def _find_pose(live: LiveSignals, truth: GroundTruth | None, iri: str, kind: IndividualKind, body: Pose) -> Pose:
    """Return the pose of an individual's own frame; that of its body if nothing else is known of it."""
    match kind:
        case "arm":
            return next(each.base() for each in live.arms if each.individual == iri)
        case "surface":
            return body if truth is None else truth.surface_pose(iri)
        case "fixture":
            return body if truth is None else truth.fixture_pose(iri)
        case "gripper" | "base" | "tool" | "body":
            return body
        case _:
            assert_never(kind)


def _read_arm(drawing: Drawing, iri: str) -> ModelArm:
    model, prefix = drawing.model, drawing.prefixes[iri]
    names = (model.joint(each).name for each in range(model.njnt))
    return ModelArm(tuple(each for each in names if each.startswith(prefix)))


def _pose(position: Array, quaternion: Array) -> PoseNumbers:
    (x, y, z), (w, a, b, c) = position.tolist(), quaternion.tolist()
    return (x, y, z, w, a, b, c)


def _vector(values: Array) -> Vector:
    x, y, z = values.tolist()
    return (x, y, z)
