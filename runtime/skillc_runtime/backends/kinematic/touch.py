"""What the arms of a kinematic cell touch: the contacts, their forces on arms, and the parts that yield to them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.kinematic.arm import KinematicArm
from skillc_runtime.backends.kinematic.contact import (
    FINGERS,
    FIXED,
    FREE,
    RIGID_N_M,
    TOOL,
    Forces,
    Motion,
    Points,
    compute_contacts,
    make_forces,
)
from skillc_runtime.backends.simulation.model.contact_bits import HANDLE, PAD, WORKS
from skillc_runtime.backends.simulation.names import (
    box_geom_name,
    contact_sensor_name,
    face_sensor_name,
    part_name,
    pressing_sensor_name,
)
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.arrays import OutVector
from skillc_runtime.motion.pose import Array

PAD_POINTS = 8
"""Contact points of a pad that lies flat; together they are as stiff as its sheet says."""


class Touch:
    """All contacts of a cell, updated once a step. What nobody holds touches fingers and what is held."""

    def __init__(self, scene: SceneSpec, arms: Sequence[KinematicArm], model: Any, data: Any) -> None:
        names, parts, count = scene.names, YieldingParts(scene, model, data), len(arms)
        self._arms, self._model, self._data, self._parts = arms, model, data, parts
        self._geoms = {each.individual: geoms_of(model, names[each.individual]) for each in scene.graspable}
        self._bits = model.geom_contype.copy(), model.geom_conaffinity.copy()
        self._held: list[str | None] = [None] * count
        self._carried: list[tuple[str, ...]] = [()] * count
        self._pads = {each.individual: each for each in scene.tools if not each.rigid}
        self._stiffness: OutVector = np.full(2 * count, RIGID_N_M)
        self._carrier: OutVector = np.full(model.ngeom, float(FIXED))
        for number, arm in enumerate(scene.arms):
            if arm.gripper is not None:
                self._carrier[geoms_of(model, names[arm.gripper.individual])] = 2 * number + FINGERS
        for tool in self._geoms:
            self._set_carrier(tool, FREE)
        links, tools = np.array([each.links for each in arms], dtype=np.float64), np.zeros((count, 3))
        axes, anchors = np.zeros((parts.count, 3)), np.zeros((parts.count, 3))
        self._motion = Motion(
            links.reshape(count, 2), data.cvel, data.subtree_com, tools, axes, anchors, parts.slides, parts.moves
        )
        self._forces, self._touched = make_forces(count, model.ngeom, parts.count), False
        self._sensors = ContactSensors(scene, self._forces, model, data)

    def hold(self, number: int, tool: str | None, riders: Sequence[str] = ()) -> None:
        """Let the arm of a number carry a tool, with what stands on it, from now on, or none."""
        before, self._held[number] = self._held[number], tool
        if before == tool:
            return
        for each in self._carried[number]:
            self._set_carrier(each, FREE)
        self._carried[number] = () if tool is None else (tool, *riders)
        for each in self._carried[number]:
            self._set_carrier(each, 2 * number + TOOL)
        if tool is not None:
            pad = self._pads.get(tool)
            stiffness = RIGID_N_M if pad is None else pad.sheet.number("padStiffness") / PAD_POINTS
            self._stiffness[2 * number + TOOL] = stiffness

    def update(self, period_s: float) -> None:
        """Find the contacts in the present positions; let arms and sensors feel them, and yielding parts yield."""
        forces, touched = self._forces, self._data.ncon > 0
        if touched or self._touched:
            self._compute_contacts()
            self._sensors.update(self._held)
        self._touched = touched
        if self._parts.count:
            self._parts.step(forces.joint, period_s)
        for number, arm in enumerate(self._arms):
            arm.feel(forces.wrench[number])

    def _compute_contacts(self) -> None:
        contact, motion, parts = self._data.contact, self._motion, self._parts
        for number, arm in enumerate(self._arms):
            motion.tool[number] = arm.tool_point()
        if parts.count:
            motion.axis[:], motion.anchor[:] = parts.axes, parts.anchors
        points = Points(contact.dist, contact.frame, contact.pos, contact.geom.astype(np.float64))
        compute_contacts(self._forces, points, motion, self._carrier, self._stiffness)

    def _set_carrier(self, tool: str, carrier: int) -> None:
        """Set who carries a tool or a body: fingers touch it while it is free, all but fingers while it is held."""
        model, geoms = self._model, self._geoms[tool]
        self._carrier[geoms] = carrier
        types, affinities = self._bits
        working = geoms[types[geoms] & WORKS > 0]
        model.geom_contype[working] = types[working] & (HANDLE if carrier == FREE else ~HANDLE)
        model.geom_conaffinity[working] = affinities[working] & (PAD if carrier == FREE else ~PAD)


def geoms_of(model: Any, device: str) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
    """Return the numbers of the geoms of a device or tool."""
    prefix = part_name(device, "")
    return np.array(
        [g for g in range(model.ngeom) if model.body(model.geom_bodyid[g]).name.startswith(prefix)], dtype=np.int64
    )


class YieldingParts:
    """The joints of all fixtures. slides (j,): 1 if it slides; moves (j, geoms): 1 if the joint moves a geom."""

    def __init__(self, scene: SceneSpec, model: Any, data: Any) -> None:
        prefixes = tuple(part_name(scene.names[each.individual], "") for each in scene.fixtures)
        joints = [j for j in range(model.njnt) if prefixes and model.joint(j).name.startswith(prefixes)]
        dofs, places = model.jnt_dofadr[joints], model.jnt_qposadr[joints]
        self.count, self._joints, self._dofs, self._places, self._data = len(joints), joints, dofs, places, data
        self.slides = (model.jnt_type[joints] == mujoco.mjtJoint.mjJNT_SLIDE).astype(np.float64)
        self.moves = np.array([_moved(model, int(model.jnt_bodyid[j])) for j in joints]).reshape(-1, model.ngeom)
        self._stiffness, self._damping = model.jnt_stiffness[joints].reshape(-1), model.dof_damping[dofs]
        self._rest = model.qpos_spring[places]
        limited = model.jnt_limited[joints].astype(bool)
        self._least = np.where(limited, model.jnt_range[joints, 0], -np.inf)
        self._most = np.where(limited, model.jnt_range[joints, 1], np.inf)

    @property
    def axes(self) -> Array:
        """The axes (j, 3) of the joints in the world."""
        axes: Array = self._data.xaxis[self._joints]
        return axes

    @property
    def anchors(self) -> Array:
        """The anchors (j, 3) in m of the joints in the world."""
        anchors: Array = self._data.xanchor[self._joints]
        return anchors

    def step(self, pressed: Array, period_s: float) -> None:
        """Move for one step: (d / T + k + k_c) dq = f - k (q - q_0).

        pressed (j, 2): f, N or N m, and the stiffness k_c of the contacts, with which a part comes to its balance.
        """
        q, force, contact = self._data.qpos[self._places], pressed[:, 0], pressed[:, 1]
        resisting = self._damping / period_s + self._stiffness + contact
        change = (force - self._stiffness * (q - self._rest)) / np.where(resisting > 0.0, resisting, np.inf)
        after = np.clip(q + change, self._least, self._most)
        self._data.qpos[self._places], self._data.qvel[self._dofs] = after, (after - q) / period_s


def _moved(model: Any, body: int) -> Array:
    """Return 1 for each geom (geoms,) on a body or on its descendants, else 0."""

    def is_moved(at: int) -> bool:
        while at not in (0, body):
            at = int(model.body_parentid[at])
        return at == body

    return np.array([float(is_moved(int(each))) for each in model.geom_bodyid])


class ContactSensors:
    """The touch and contact sensors of a cell. A tool's row: its force on its face, on all things, on each surface."""

    def __init__(self, scene: SceneSpec, forces: Forces, model: Any, data: Any) -> None:
        self._on_geom = forces.on_geom.reshape(-1, model.ngeom, 3)
        self._forces, self._values = forces, data.sensordata
        addresses = {model.sensor(each).name: int(model.sensor(each).adr[0]) for each in range(model.nsensor)}
        names = scene.names
        self._tools = {t.individual: _Tool(scene, names[t.individual], addresses, model) for t in scene.tools}
        fixtures = tuple(part_name(names[each.individual], "") for each in scene.fixtures)
        self._fixtures = [
            (addresses[name], np.flatnonzero(model.geom_bodyid == model.site_bodyid[model.sensor(name).objid[0]]))
            for name in addresses
            if model.sensor(name).type[0] == mujoco.mjtSensor.mjSENS_TOUCH and fixtures and name.startswith(fixtures)
        ]

    def update(self, held: Sequence[str | None]) -> None:
        """Write the forces on the tools that arms hold, in the order of arms, and on all fixtures."""
        on_geom, values, forces = self._on_geom, self._values, self._forces
        for address, geoms in self._fixtures:
            values[address] = np.linalg.norm(on_geom[:, geoms].sum(axis=(0, 1)))
        for number, tool in enumerate(held):
            if tool in self._tools:
                carrier = 2 * number + TOOL
                self._tools[tool].update(values, on_geom[carrier], forces.net[carrier], forces.total[carrier])


class _Tool:
    """The sensors of one tool."""

    def __init__(self, scene: SceneSpec, name: str, addresses: dict[str, int], model: Any) -> None:
        self._touch = addresses[face_sensor_name(name, "touch")]
        self._contact = addresses[contact_sensor_name(name)]
        self._surfaces = [
            (addresses[sensor], model.geom(box_geom_name(surface)).id)
            for surface in (scene.names[each.individual] for each in scene.surfaces)
            if (sensor := pressing_sensor_name(name, surface)) in addresses
        ]

    def update(self, values: Array, on_geom: Array, net: Array, total_n: float) -> None:
        """Write the forces of the tool in N: on each geom (geoms, 3), on all (3,), and the sum of normal forces."""
        values[self._touch] = total_n
        values[self._contact : self._contact + 3] = net
        for address, geom in self._surfaces:
            values[address : address + 3] = on_geom[geom]
