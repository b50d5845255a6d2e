"""What the arms of a kinematic cell touch: the contacts, their forces on arms, and the parts that yield to them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from skillc_runtime.backends.kinematic.arm import KinematicArm
from skillc_runtime.backends.kinematic.contact import (
    FINGERS,
    FIXED,
    FREE,
    RIGID_N_M,
    TOOL,
    Motion,
    Points,
    compute_contacts,
    make_forces,
)
from skillc_runtime.backends.kinematic.contact_sensors import ContactSensors
from skillc_runtime.backends.kinematic.yielding import YieldingParts
from skillc_runtime.backends.simulation.model.contact_bits import HANDLE, PAD, WORKS
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.arrays import OutVector

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
