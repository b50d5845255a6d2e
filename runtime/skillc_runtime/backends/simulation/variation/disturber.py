"""Lets things happen to a simulated cell: somebody pushes a hand, moves or takes a thing, presses a stop."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol, assert_never

import numpy as np

from skillc_runtime.backends.simulation.arms.stops import SimulatedStops
from skillc_runtime.backends.simulation.hands.gripper import ModelledGripper
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.devices.disturbances import (
    Disturbance,
    DisturbanceRefused,
    LoseArm,
    MoveThing,
    PressEmergencyStop,
    PushArm,
    TakeThing,
)
from skillc_runtime.motion.pose import Array, Pose, exp, quaternion_from_rotation


class DisturbedCell(Protocol):
    """What a cell offers to those who disturb it."""

    def push_hand(self, arm: str, force_n: Array) -> None:
        """Push the hand of an arm with a force (3,) in N in the world from now on; 0 ends it. KeyError without hand."""
        ...

    def refresh(self) -> None:
        """Compute what follows from positions in `data` that were changed between two steps."""
        ...


class SimulatedDisturber:
    """Disturbs a cell; implements `Disturber`. Pushes act in each step, so that they take exactly as long as stated.

    `hands` are by arm.
    """

    def __init__(
        self, cell: DisturbedCell, scene: SceneSpec, model: Any, data: Any, hands: Mapping[str, ModelledGripper],
        stops: SimulatedStops,
    ) -> None:  # fmt: skip
        self._cell, self._scene, self._model, self._data, self._hands = cell, scene, model, data, hands
        self._stops = stops
        self._pushes: dict[str, tuple[PushArm, float]] = {}

    def disturb(self, disturbance: Disturbance) -> None:
        """Let something happen between two ticks; DisturbanceRefused if it is not possible."""
        match disturbance:
            case PushArm(arm=arm):
                self._check_hand(arm)
                self._pushes[arm] = disturbance, float(self._data.time) + disturbance.duration_s
            case MoveThing():
                self._move(disturbance)
            case TakeThing():
                self._take(disturbance)
            case PressEmergencyStop(pressed=pressed):
                self._stops.press(pressed)
            case LoseArm(arm=arm, lost=lost):
                self._check_arm(arm)
                self._stops.lose(arm, lost)
            case _:
                assert_never(disturbance)

    @property
    def acts(self) -> bool:
        """Whether somebody still pushes."""
        return bool(self._pushes)

    def step(self, now: float) -> None:
        """Apply the forces of the step that begins at `now` s."""
        for arm, (push, ends) in tuple(self._pushes.items()):
            acts = now < ends
            self._cell.push_hand(arm, np.array(push.force_n) if acts else np.zeros(3))
            if not acts:
                del self._pushes[arm]

    def _check_arm(self, arm: str) -> None:
        if all(each.individual != arm for each in self._scene.arms):
            raise DisturbanceRefused(f"{arm} is no arm of the cell")

    def _check_hand(self, arm: str) -> None:
        try:
            self._cell.push_hand(arm, np.zeros(3))
        except KeyError:
            raise DisturbanceRefused(f"{arm} is no arm with a hand that can be pushed") from None

    def _move(self, wanted: MoveThing) -> None:
        """Put a thing elsewhere, at rest; nothing else is moved out of its way."""
        if self._hand_with(wanted.thing) is not None:
            name = self._scene.names[wanted.thing]
            raise DisturbanceRefused(f"{name} is in a gripper; it can be taken out of the hand")
        self._shift(wanted.thing, np.array(wanted.by_m), wanted.turn_rad)

    def _take(self, wanted: TakeThing) -> None:
        """Let a hand lose what it holds, and put that elsewhere; fingers that press on nothing close."""
        hand = self._hand_with(wanted.thing)
        if hand is None:
            raise DisturbanceRefused(f"{self._scene.names.get(wanted.thing, wanted.thing)} is in no gripper")
        hand.lose()
        self._shift(wanted.thing, np.array(wanted.by_m), 0.0)

    def _hand_with(self, thing: str) -> ModelledGripper | None:
        """Return the gripper that really holds a thing; None for none."""
        return next((each for each in self._hands.values() if each.carries == thing), None)

    def _shift(self, thing: str, by_m: Array, turn_rad: float) -> None:
        """Move a thing, at rest then, and turn it about the vertical."""
        if all(each.individual != thing for each in self._scene.graspable):
            raise DisturbanceRefused(f"{thing} is nothing that can be moved")
        joint = self._model.joint(part_name(self._scene.names[thing], "free"))
        first, velocity = int(joint.qposadr[0]), int(joint.dofadr[0])
        q = self._data.qpos[first : first + 7]
        before = Pose.of(q[:3], q[3:])
        turned = exp(np.array([0.0, 0.0, turn_rad])) @ before.rotation
        q[:3], q[3:] = before.position + by_m, quaternion_from_rotation(turned)
        self._data.qvel[velocity : velocity + 6] = 0.0
        self._cell.refresh()
