"""The parts of an arm, its hand and what that holds as convex solids: obstacles for other arms of the cell."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress

import mujoco
import numpy as np

from skillc_runtime.collision.arm_assembly import ArmAssembly, read_arm_assembly
from skillc_runtime.collision.collision_model import MOVES, CollisionModel, build_collision_model
from skillc_runtime.collision.scenery import FAR_M, PoseKey, Scenery, SolidObstacle, pose_key
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.shape.solids import Kind
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import HAS_GRIPPER
from skillc_runtime.world.state.world_state import WorldState

NOTHING = Scenery(PoseKey((0.0, 0.0, -10.0), (1.0, 0.0, 0.0, 0.0)), (), ())


class ArmParts:
    """Where the geoms of an arm, its hand and what that holds are, in the frame of its base, at any joints.

    halves (geoms, 3): m, half the size of each along its own axes. levers (nv,): m, as of the collision model.
    """

    def __init__(self, assembly: ArmAssembly) -> None:
        """ValueError as of `build_collision_model`."""
        self._body: CollisionModel = build_collision_model(assembly, NOTHING)
        model = self._body.compiled
        self._data = mujoco.MjData(model)
        self._data.qpos[self._body.joints :] = self._body.fingers
        mujoco.mj_kinematics(model, self._data)
        self._geoms = np.flatnonzero(model.geom_contype == MOVES)
        self._middles = model.geom_aabb[self._geoms, :3]
        self.halves: Array = model.geom_aabb[self._geoms, 3:]
        self.levers = self._body.levers

    @property
    def reach_m(self) -> float:
        """A distance in m from the base farther than which no part gets, whatever the joints: that of the first joint
        and the farthest that a part may be from it."""
        first = self._data.xpos[self._body.compiled.jnt_bodyid[0]]
        return float(self.levers.max() + np.linalg.norm(first))

    def place(self, q: Array) -> tuple[Array, Array]:
        """Return the middles (geoms, 3) in m and the rotations (geoms, 3, 3) of all geoms at joints q (nv,) in rad."""
        self._move(q)
        rotations = self._data.geom_xmat[self._geoms].reshape(-1, 3, 3)
        middles = self._data.geom_xpos[self._geoms] + np.einsum("gij,gj->gi", rotations, self._middles)
        return middles, rotations.copy()

    def list_obstacles(self, q: Array, base: Pose) -> Iterator[SolidObstacle]:
        """Yield the geoms at joints q (nv,) in rad as solids, with the base at a pose."""
        yield from self._list(q, base, self._geoms.tolist())

    def list_hand(self, q: Array, base: Pose) -> Iterator[SolidObstacle]:
        """Yield the geoms of the hand and of what it holds, as `list_obstacles`.

        q (nv,): rad; base: pose in the world.
        """
        yield from self._list(q, base, [each for each in self._geoms.tolist() if each not in self._body.links])

    def _list(self, q: Array, base: Pose, geoms: list[int]) -> Iterator[SolidObstacle]:
        self._move(q)
        for geom in geoms:
            at = Pose(self._data.geom_xpos[geom], self._data.geom_xmat[geom].reshape(3, 3))
            kind, half, middle, points = self._read_solid(geom)
            there = base @ at @ Pose(middle, np.eye(3))
            yield SolidObstacle(self._body.names[geom], pose_key(there), tuple(half.tolist()), kind, points)

    def _move(self, q: Array) -> None:
        self._data.qpos[: self._body.joints] = q
        mujoco.mj_kinematics(self._body.compiled, self._data)

    def _read_solid(self, geom: int) -> tuple[Kind, Array, Array, bytes]:
        """Return the kind of a geom, half its size (3,) and its middle (3,) in its frame in m, the points of a hull."""
        model = self._body.compiled
        size, middle = model.geom_size[geom], np.zeros(3)
        radius, length = float(size[0]), float(size[1])
        match mujoco.mjtGeom(model.geom_type[geom]):
            case mujoco.mjtGeom.mjGEOM_CYLINDER:
                return "cylinder", np.array([radius, radius, length]), middle, b""
            case mujoco.mjtGeom.mjGEOM_CAPSULE:
                return "capsule", np.array([radius, radius, length + radius]), middle, b""
            case mujoco.mjtGeom.mjGEOM_SPHERE:
                return "sphere", np.full(3, radius), middle, b""
            case mujoco.mjtGeom.mjGEOM_MESH:
                mesh = model.geom_dataid[geom]
                first = model.mesh_vertadr[mesh]
                points = model.mesh_vert[first : first + model.mesh_vertnum[mesh]].astype(float)
                return "hull", np.abs(points).max(axis=0), middle, points.tobytes()
            case _:
                return "box", model.geom_aabb[geom, 3:].copy(), model.geom_aabb[geom, :3].copy(), b""


def read_other_arms(
    state: WorldState, arm: str, base: Pose, postures: Mapping[str, Array], openings: Mapping[str, float]
) -> tuple[SolidObstacle, ...]:
    """Return the parts of all arms but one that stand in postures, in the frame of the base of that one.

    postures: (nv,) in rad, by IRI. openings: m, of grippers by IRI; the fingers of others are open. Left out are arms
    that are too far away, of which a model or the place is not known, or to whose model the posture does not belong.
    """
    return tuple(
        part
        for other, q in sorted(postures.items(), key=lambda each: each[0])
        if other != arm
        for part in _read_parts(state, other, base.inverse(), q, openings)
    )


def _read_parts(
    state: WorldState, arm: str, inward: Pose, q: Array, openings: Mapping[str, float]
) -> Iterator[SolidObstacle]:
    with suppress(FrameError, SheetError, ValueError):
        base = inward @ pose(state, arm)
        if np.linalg.norm(base.position) < FAR_M:
            known = {each: _opening_m(state, each, openings) for each in state.objects(arm, HAS_GRIPPER)}
            yield from tuple(ArmParts(read_arm_assembly(state, arm, known)).list_obstacles(q, base))


def _opening_m(state: WorldState, gripper: str, openings: Mapping[str, float]) -> float:
    known = openings.get(gripper)
    return sheet_of(state, gripper).number("maxOpening") if known is None else known
