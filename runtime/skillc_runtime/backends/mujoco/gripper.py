"""A simulated gripper: a servo for the opening; contact from opposite sides is a grasp.

A weld holds the object, since friction grasps creep in rigid-body simulation, as long as friction could carry the load
on the weld. After that only contact and friction hold it.
"""

from __future__ import annotations

from typing import Any

from skillc_runtime.backends.mujoco.arm import Payload, SimulatedArm
from skillc_runtime.backends.mujoco.grip import Grip, make_grip
from skillc_runtime.backends.mujoco.names import part_name, weld_name
from skillc_runtime.backends.mujoco.scene_spec import GripperSpec, ToolSpec
from skillc_runtime.devices.gripper import working_face
from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation

STILL_M_S, STILL_TIME_S = 0.002, 0.05
"""Fingers that have been slower than this for this time, at their goal or blocked, have arrived."""

HANDLE, PAD = 4, 8
"""Contact bits of handles and of the fingers' pads."""

OPPOSING = -0.7
"""Cosine below which two contact normals count as opposite sides."""


class SimulatedGripper:
    """One gripper of a simulated cell, implementing `Gripper`; contact is required for a grasp, a weld holds it."""

    def __init__(
        self,
        facts: GripperSpec,
        names: dict[str, str],
        tools: tuple[ToolSpec, ...],
        arm: SimulatedArm,
        model: Any,
        data: Any,
    ) -> None:
        self._facts, self._names, self._arm, self._model, self._data = facts, names, arm, model, data
        self._tools = {tool.individual: tool for tool in tools}
        self._name = names[facts.individual]
        self._actuator = model.actuator(part_name(self._name, "opening")).id
        self._length = data.actuator_length[self._actuator : self._actuator + 1]
        self._speed = data.actuator_velocity[self._actuator : self._actuator + 1]
        self.pads = frozenset(_pads(model, self._name))
        self._set_opening(facts.first_opening_m)
        self._still_since, self._holding, self._idle = 0.0, "", True
        self._grip: Grip | None = None

    @property
    def individual(self) -> str:
        """The gripper's IRI."""
        return self._facts.individual

    @property
    def max_opening_m(self) -> float:
        """The greatest distance between the fingers in m."""
        return self._facts.max_opening_m

    @property
    def max_force_n(self) -> float:
        """The greatest grasping force in N."""
        return self._facts.max_force_n

    @property
    def opening_m(self) -> float:
        """The measured distance between the fingers in m."""
        return float(self._length[0])

    @property
    def moving(self) -> bool:
        """Whether the fingers still move, or were blocked just now."""
        return not self._idle

    @property
    def holding(self) -> str | None:
        """The IRI of the object that counts as held."""
        return self._holding or None

    def move(self, opening_m: float, force_n: float) -> None:
        """Move the fingers to an opening in m with at most a force in N, both limited to those of the gripper."""
        force = min(force_n, self._facts.max_force_n)
        self._model.actuator_forcerange[self._actuator] = (-force, force)
        self._goal = min(max(opening_m, 0.0), self._facts.max_opening_m)
        self._target, self._idle, self._still_since = self.opening_m, False, self._data.time

    def stop(self) -> None:
        """Stop the fingers at their present opening."""
        self._goal = self._target = self.opening_m
        self._data.ctrl[self._actuator], self._idle = self._target, True

    def step(self, period_s: float) -> None:
        """Advance the servo's target by one step."""
        if self._idle:
            return
        way = self._facts.finger_speed_m_s * period_s
        self._target += min(max(self._goal - self._target, -way), way)
        self._data.ctrl[self._actuator] = self._target
        if abs(self._speed[0]) > STILL_M_S:
            self._still_since = self._data.time
        elif self._data.time - self._still_since > STILL_TIME_S:
            arrived = abs(self.opening_m - self._goal) < STILL_M_S
            self._idle = arrived or self._target == self._goal or self._is_at_force_limit()

    def touches(self, thing: str) -> bool:
        """Tell whether pads of at least two fingers touch an object from opposite sides."""
        normals, _ = self._contacts_with(thing)
        return any(one @ other < OPPOSING for one in normals for other in normals)

    def attach(self, thing: str, in_tool_centre: Pose) -> None:
        """Hold a touched object by a weld at its true pose; it becomes the arm's payload and tool centre point.

        The arm assumes it at `in_tool_centre`. Raises RuntimeError if it is not touched from opposite sides.
        """
        if not self.touches(thing):
            raise RuntimeError(f"the fingers do not touch {self._names[thing]} from both sides")
        hand = self._model.body(part_name(self._name, "palm")).id
        block = self._model.body(part_name(self._names[thing], "block")).id
        truth = _pose(self._data, hand).inverse() @ _pose(self._data, block)
        equality = self._model.equality(weld_name(self._name, self._names[thing])).id
        force = abs(float(self._data.actuator_force[self._actuator]))
        normals, friction = self._contacts_with(thing)
        self._grip = make_grip(self._data, equality, hand, normals, friction, force)
        row = self._model.eq_data[equality]
        row[:3], row[3:6], row[6:10], row[10] = 0.0, truth.position, quaternion_from_rotation(truth.rotation), 1.0
        self._data.eq_active[equality] = 1
        self._holding, tool = thing, self._tools[thing]
        self._set_grip_contact(thing, False)
        centre = _pose(self._data, block).inverse().apply(self._data.subtree_com[block])
        payload = Payload(tool.mass_kg, (self._arm.fixed_tool @ in_tool_centre).apply(centre))
        self._arm.carry(payload, in_tool_centre @ working_face(tool.size))

    def detach(self) -> None:
        """Remove the weld; the arm's payload and tool centre point become those of the empty gripper."""
        if not self._holding:
            return
        equality = self._model.equality(weld_name(self._name, self._names[self._holding])).id
        self._set_grip_contact(self._holding, True)
        self._data.eq_active[equality], self._holding, self._grip = 0, "", None
        self._arm.carry_nothing()

    def slip_message(self, now: float) -> str | None:
        """Return a message if the held object slips, None while friction carries it.

        To be called in each step, between `mj_step2` and the next `mj_step1`.
        """
        pull = None if self._grip is None else self._grip.overload(self._data, now)
        if self._grip is None or pull is None:
            return None
        return (
            f"{self._names[self._holding]} slips out of {self._name}: {pull:.0f} N pull at it, "
            f"the grip bears {self._grip.bears_n:.0f} N"
        )

    def lose(self) -> None:
        """Remove the weld of a held object and close the fingers with the same force."""
        self.detach()
        self.move(0.0, float(self._model.actuator_forcerange[self._actuator, 1]))

    def move_with_base(self, motion: Pose) -> None:
        """Move a held object with the base of the arm: new = motion @ old, in the world."""
        if self._holding:
            joint = self._model.joint(part_name(self._names[self._holding], "free"))
            q = self._data.qpos[joint.qposadr[0] : joint.qposadr[0] + 7]
            moved = motion @ Pose.of(q[:3], q[3:])
            q[:3], q[3:] = moved.position, quaternion_from_rotation(moved.rotation)

    def _set_opening(self, opening_m: float) -> None:
        """Set the opening at once: each joint of its tendon takes its share."""
        tendon = int(self._model.actuator_trnid[self._actuator, 0])
        first = int(self._model.tendon_adr[tendon])
        span = slice(first, first + int(self._model.tendon_num[tendon]))
        joints, shares = self._model.wrap_objid[span], self._model.wrap_prm[span]
        self._data.qpos[self._model.jnt_qposadr[joints]] = opening_m / shares.sum()
        self._data.ctrl[self._actuator] = self._goal = self._target = opening_m

    def _set_grip_contact(self, thing: str, on: bool) -> None:
        """Enable or disable contact of pads with an object: while a weld holds it, contact would only cost time."""
        handle = self._model.geom(part_name(self._names[thing], "handle")).id
        self._model.geom_contype[handle], self._model.geom_conaffinity[handle] = (HANDLE, PAD) if on else (0, 0)
        if not on:
            self.stop()

    def _is_at_force_limit(self) -> bool:
        """Return whether the servo pushes with its greatest force."""
        return bool(
            abs(self._data.actuator_force[self._actuator]) > 0.95 * self._model.actuator_forcerange[self._actuator, 1]
        )

    def _contacts_with(self, thing: str) -> tuple[list[Array], float]:
        """Return the contact normals (3,), in the world, of pads on an object, and the least friction."""
        contacts, handle = self._data.contact, self._model.geom(part_name(self._names[thing], "handle")).id
        normals: list[Array] = []
        frictions: list[float] = []
        for index in range(self._data.ncon):
            one, other = contacts.geom[index]
            if {one, other} & self.pads and handle in (one, other):
                normals.append(contacts.frame[index, :3] * (1.0 if one in self.pads else -1.0))
                frictions.append(float(contacts.friction[index, 0]))
        return normals, min(frictions, default=0.0)


def _pads(model: Any, gripper: str) -> list[int]:
    prefix = part_name(gripper, "")
    return [
        g for g in range(model.ngeom) if model.geom(g).name.startswith(prefix) and model.geom(g).name.endswith("_pad")
    ]


def _pose(data: Any, body: int) -> Pose:
    return Pose(data.xpos[body].copy(), data.xmat[body].reshape(3, 3).copy())
