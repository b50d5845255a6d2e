"""A gripper in the model of a cell: its fingers, what they touch, and what it holds; a backend moves it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import mujoco
import numpy as np
from msgspec.structs import replace

from skillc_runtime.backends.simulation.arms.arm import ModelledArm
from skillc_runtime.backends.simulation.bases.base import BaseStep
from skillc_runtime.backends.simulation.checkpoint import SavedGrip, SavedGripper, make_pose
from skillc_runtime.backends.simulation.contacts import Contacts
from skillc_runtime.backends.simulation.hands.finger_sensor import FingerSensor
from skillc_runtime.backends.simulation.hands.gripper_geoms import find_handles, find_pads
from skillc_runtime.backends.simulation.hands.loss_watch import COUNTS, HELD_AT
from skillc_runtime.backends.simulation.model.contact_bits import HANDLE, PAD
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import GripperSpec, ToolSpec
from skillc_runtime.devices.arm import ArmLoad
from skillc_runtime.devices.gripper import has_closed_further
from skillc_runtime.devices.ground_truth import HandSample
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.world.space.bodies import RigidBody

OPPOSING = -0.7
"""Cosine below which two contact normals count as opposite sides."""

NOTHING: frozenset[int] = frozenset()


class ModelledGripper(ABC):
    """One gripper of a cell that is computed from a MuJoCo model, implementing `Gripper`; subclasses move it.

    What counts as held follows from what the fingers measure. What the palm really `carries` is another matter: it is
    decided by contact, and only the simulation and its ground truth see it.
    """

    def __init__(
        self,
        facts: GripperSpec,
        names: dict[str, str],
        things: tuple[ToolSpec | RigidBody, ...],
        arm: ModelledArm,
        model: Any,
        data: Any,
        contacts: Contacts,
        sensor: FingerSensor,
    ) -> None:
        self._contacts, self._sensor = contacts, sensor
        self._facts, self._names, self._arm, self._model, self._data = facts, names, arm, model, data
        self._things = {thing.individual: thing for thing in things}
        self._handles = {thing: find_handles(model, names[thing]) for thing in self._things}
        self._bits = model.geom_contype.copy(), model.geom_conaffinity.copy()
        self._name = names[facts.individual]
        self._actuator = model.actuator(part_name(self._name, "opening")).id
        self._palm = model.body(part_name(self._name, "palm")).id
        self._tool_centre = model.site(part_name(self._name, "tcp")).id
        self.pads = find_pads(model, self._name)
        self._holding, self._held, self._carried = "", np.zeros(2), ""
        self._in_tool_centre, self._payload_kg, self._limit_n = Pose.of((0.0, 0.0, 0.0)), 0.0, 0.0
        self._load: ArmLoad | None = None
        self._centre: Array | None = None
        """The centre of mass (3,) of what is held that was told since it was grasped, in m, in its own frame."""
        self._idle, self._goal = True, facts.first_opening_m
        self._set_fingers(facts.first_opening_m)

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
        return self._sensor.read(self._data.time, self._true_opening_m)

    @property
    def opening_error_m(self) -> float:
        """The greatest error of the measured opening in m."""
        return self._sensor.greatest_error_m

    @property
    def blocked(self) -> bool:
        """Whether something keeps the fingers from closing: at rest, they press with the force that they were given."""
        return self._idle and self._is_at_force_limit() and self.opening_m > self.opening_error_m

    @property
    def moving(self) -> bool:
        """Whether the fingers still move, or were blocked just now."""
        return not self._idle

    @property
    def holding(self) -> str | None:
        """The IRI of the object that counts as held; None as soon as the fingers close further: it was lost."""
        return None if not self._holding or self._has_closed_further() else self._holding

    @property
    def counted(self) -> str:
        """The IRI of the object that was last counted as held, lost or not; empty for none."""
        return self._holding

    @property
    def carries(self) -> str | None:
        """The IRI of the object that really moves with the palm."""
        return self._carried or None

    def sample(self) -> HandSample:
        """Return where the gripper really is and how it grips; the sensor of the fingers is not read."""
        position = self._data.site_xpos[self._tool_centre].copy()
        return HandSample(position, self._true_opening_m, self._finger_force_n, self._sensor.last_m)

    @abstractmethod
    def move(self, opening_m: float, force_n: float) -> None:
        """Move the fingers to an opening in m with at most a force in N, both limited to those of the gripper."""

    @abstractmethod
    def stop(self) -> None:
        """Stop the fingers at their present opening."""

    @abstractmethod
    def step(self, period_s: float) -> None:
        """Advance the fingers by one step."""

    def touches(self, thing: str) -> bool:
        """Tell whether pads of two fingers really touch an object from opposite sides; never one without a body."""
        normals, _ = self._contacts_with(thing)
        return any(one @ other < OPPOSING for one in normals for other in normals)

    def attach(self, thing: str, in_tool_centre: Pose, mass_kg: float) -> None:
        """Count an object as held; it becomes the arm's payload and tool centre point, at `in_tool_centre`.

        `mass_kg` is the arm's payload, whatever the body really weighs. What really is between
        the fingers, if anything is, moves with the palm from now on, at its true pose.
        RuntimeError if the fingers are not blocked, or the cell has no body of the object.
        """
        if not self.blocked:
            raise RuntimeError(f"nothing keeps the fingers of {self._name} from closing")
        if thing not in self._things:
            raise RuntimeError(
                f"{self._names.get(thing, thing)} cannot be held: it had no body when the cell was built. "
                "A thing to handle needs a pose and skiros:SizeX, SizeY and SizeZ in the scene"
            )
        self._count(thing, self.opening_m, in_tool_centre, mass_kg)
        self._carry(next((each for each in (thing, *self._things) if self.touches(each)), ""))

    def save(self) -> SavedGripper:
        """Return the state of the gripper, at rest."""
        carried = bool(self._carried)
        in_palm = self._in_palm(self._carried) if carried else Pose.of((0.0, 0.0, 0.0))
        return SavedGripper(
            opening_m=self._true_opening_m,
            force_n=self._limit_n,
            carried=self._carried,
            in_palm=in_palm.numbers,
            grip=self._save_grip() if carried else None,
            counted=self._holding,
            counted_at_m=float(self._held[HELD_AT]),
            in_tool_centre=self._in_tool_centre.numbers,
            mass_kg=self._payload_kg,
            centre=None if self._centre is None else (*self._centre.tolist(),),
        )

    def restore(self, saved: SavedGripper) -> None:
        """Take the state of an earlier gripper, once positions are computed; it does not hold what has no body here."""
        self._restore_fingers(saved.opening_m, saved.force_n)
        if saved.carried in self._things:
            self._place(saved.carried)[:] = (self._pose(self._palm) @ make_pose(saved.in_palm)).numbers
            mujoco.mj_fwdPosition(self._model, self._data)
            self._fix(saved.carried, make_pose(saved.in_palm), saved.grip)
        if saved.counted in self._things:
            self._count(saved.counted, saved.counted_at_m, make_pose(saved.in_tool_centre), saved.mass_kg)
            if saved.centre is not None:
                self.correct_load(saved.mass_kg, np.array(saved.centre))

    def detach(self) -> None:
        """Hold nothing; the arm's payload and tool centre point become those of the empty gripper."""
        self.drop()
        if self._holding:
            self._holding, self._held[COUNTS] = "", 0.0
            self._load = None
            self._arm.set_load(None)

    @property
    def load(self) -> ArmLoad | None:
        """What the arm counts as its payload; None for nothing."""
        return self._load

    def correct_load(self, mass_kg: float, centre: Array) -> None:
        """Let the arm count what is held with this mass in kg, centre of mass (3,) in m in its own frame."""
        if self._load is None:
            raise RuntimeError(f"{self._name} holds nothing")
        self._payload_kg, self._centre = mass_kg, centre
        self._load = replace(self._load, mass_kg=mass_kg, centre=centre)
        self._arm.set_load(self._load)

    def lose(self) -> None:
        """Let what the palm carries go, as `drop`; the fingers close on with their force, which tells of the loss."""
        self.drop()
        self.move(0.0, self._limit_n)

    def loss_message(self) -> str | None:
        """Return a message if the fingers have closed further than on what counts as held, else None."""
        if not self._holding or not self._has_closed_further():
            return None
        return (
            f"{self._name} has lost {self._names[self._holding]}: its fingers have closed from "
            f"{self._held[HELD_AT] * 1e3:.0f} mm to {self.opening_m * 1e3:.0f} mm"
        )

    def drop(self) -> None:
        """Let what the palm carries go, which nobody may know of: it counts as held until the fingers measure it."""
        if self._carried:
            self._set_grip_contact(self._carried, True)
            self._let_go(self._carried)
            self._carried = ""

    def _carry(self, thing: str) -> None:
        """Let an object, which the fingers touch, move with the palm; none if empty."""
        self.drop()
        if thing:
            self._fix(thing, self._in_palm(thing), None)

    def _fix(self, thing: str, in_palm: Pose, grip: SavedGrip | None) -> None:
        """Let an object move with the palm; `grip` is how friction holds it, None if that is to be measured."""
        self._hold(thing, in_palm, grip)
        self._carried = thing
        self._set_grip_contact(thing, False)

    def _count(self, thing: str, opening_m: float, in_tool_centre: Pose, mass_kg: float) -> None:
        """Count an object as held between fingers with a measured opening; it is the arm's payload."""
        self._holding, self._held[:] = thing, (1.0, opening_m)
        self._in_tool_centre, self._payload_kg, self._centre = in_tool_centre, mass_kg, None
        block = self._model.body(part_name(self._names[thing], "block")).id
        centre = self._pose(block).inverse().apply(self._data.subtree_com[block]) - self._centre_error(thing)
        tool = in_tool_centre @ working_face(self._things[thing].size)
        self._load = ArmLoad(mass_kg, centre, in_tool_centre, tool)
        self._arm.set_load(self._load)

    def _centre_error(self, thing: str) -> Array:
        """Return how far the centre of mass (3,) of an object is from where it is known to be, in m, in its frame."""
        return np.zeros(3)

    def _has_closed_further(self) -> bool:
        """Whether the fingers have closed so far since they took hold that what they held is not between them."""
        return has_closed_further(self.opening_m, float(self._held[HELD_AT]))

    @property
    def needs_base_motion(self) -> bool:
        """Whether it carries an object that has to be moved with the base of the arm."""
        return bool(self._carried)

    def move_with_base(self, step: BaseStep) -> None:
        """Move a carried object with the base of the arm."""
        if self._carried:
            place = self._place(self._carried)
            place[:] = (step.motion @ Pose.of(place[:3], place[3:])).numbers

    @property
    @abstractmethod
    def _true_opening_m(self) -> float:
        """The true distance between the fingers in m."""

    @property
    @abstractmethod
    def _finger_force_n(self) -> float | None:
        """The force in N with which each finger presses, or pressed when it grasped; None if it is not computed."""

    @abstractmethod
    def contact_force(self) -> Array | None:
        """Return the force (3,) in N with which hand and held object press on the rest; None if not computed."""

    @abstractmethod
    def _is_at_force_limit(self) -> bool:
        """Return whether the fingers press with the force that they were given, on whatever is between them."""

    @abstractmethod
    def _hold(self, thing: str, in_palm: Pose, grip: SavedGrip | None) -> None:
        """Fix an object to the palm, at its true pose there; how friction holds it is measured if `grip` is None."""

    @abstractmethod
    def _save_grip(self) -> SavedGrip | None:
        """Return how friction holds what is carried; None if that is not computed."""

    @abstractmethod
    def _restore_fingers(self, opening_m: float, force_n: float) -> None:
        """Let the fingers rest at an opening in m, with at most a force in N."""

    @abstractmethod
    def _let_go(self, thing: str) -> None:
        """Release an object."""

    def _set_fingers(self, opening_m: float) -> None:
        """Set the opening at once: each joint of its tendon takes its share."""
        tendon = int(self._model.actuator_trnid[self._actuator, 0])
        first = int(self._model.tendon_adr[tendon])
        span = slice(first, first + int(self._model.tendon_num[tendon]))
        joints, shares = self._model.wrap_objid[span], self._model.wrap_prm[span]
        self._data.qpos[self._model.jnt_qposadr[joints]] = opening_m / shares.sum()

    def _set_grip_contact(self, thing: str, on: bool) -> None:
        """Enable or disable contact of pads with an object: while it is held, contact would only cost time."""
        (kinds, met), handles = self._bits, sorted(self._handles[thing])
        self._model.geom_contype[handles] = kinds[handles] & (~0 if on else ~HANDLE)
        self._model.geom_conaffinity[handles] = met[handles] & (~0 if on else ~PAD)
        if not on:
            self.stop()

    def _in_palm(self, thing: str) -> Pose:
        """Return the true pose of an object in the palm."""
        block = self._model.body(part_name(self._names[thing], "block")).id
        return self._pose(self._palm).inverse() @ self._pose(block)

    def _place(self, thing: str) -> Array:
        """Return a view of the coordinates (7,) of an object, which lies free for the model: m and a quaternion."""
        first = int(self._model.joint(part_name(self._names[thing], "free")).qposadr[0])
        place: Array = self._data.qpos[first : first + 7]
        return place

    def _contacts_with(self, thing: str) -> tuple[list[Array], float]:
        """Return the contact normals (3,), in the world, of pads on an object, and the least friction."""
        contacts, handles = self._contacts.data.contact, self._handles.get(thing, NOTHING)
        normals: list[Array] = []
        frictions: list[float] = []
        for index, (one, other) in enumerate(self._contacts.geoms.tolist()):
            if {one, other} & self.pads and {one, other} & handles:
                normals.append(contacts.frame[index, :3] * (1.0 if one in self.pads else -1.0))
                frictions.append(float(contacts.friction[index, 0]))
        return normals, min(frictions, default=0.0)

    def _pose(self, body: int) -> Pose:
        return Pose(self._data.xpos[body].copy(), self._data.xmat[body].reshape(3, 3).copy())
