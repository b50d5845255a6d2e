"""Looks at the arms, grippers and bases of a cell whose control processes run, without moving any of them."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from math import atan2
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.control_process.joint_doubts import (
    find_beyond,
    find_confusion,
    find_opposite_speeds,
    find_opposite_weights,
)
from skillc_runtime.backends.control_process.remote.control_watch import find_control_state
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.real_time.device_cell import CellDevices
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.control.kinematics import Kinematics
from skillc_runtime.control.laws.virtual_arm import load_virtual_model
from skillc_runtime.control.measured import is_still
from skillc_runtime.devices.arm import ArmState
from skillc_runtime.devices.backend import DeviceStop
from skillc_runtime.devices.observed import (
    DIFFERS_HEADING_RAD,
    DIFFERS_M,
    ObservedArm,
    ObservedBase,
    ObservedCell,
    ObservedGripper,
    ObservedJoint,
)
from skillc_runtime.motion.pose import Array, Pose

FELT_N, FELT_BY_TORQUES_N = 4.0, 12.0
"""A tool at rest that feels more is remarked, by a force-torque sensor, or by the torques of the joints."""

GRAVITY_M_S2 = 9.81
KEPT = 10
"""Measurements that are compared to find speeds that contradict positions."""


class DeviceObserver:
    """Implements `CellObserver` for a cell of real devices."""

    def __init__(self, scene: SceneSpec, arms: Mapping[str, RemoteArmDriver], others: CellDevices) -> None:
        self._scene, self._others = scene, others
        self._looks = [_ArmLook(facts, scene.names[facts.individual], arms[facts.individual]) for facts in scene.arms]

    def observe(self) -> ObservedCell:
        """Return what the devices report now."""
        scene, others = self._scene, self._others
        fault = others.find_fault()
        return ObservedCell(
            arms=tuple(look.observe() for look in self._looks),
            grippers=tuple(
                ObservedGripper(
                    gripper=scene.names[hand.individual],
                    opening_m=float(others.grippers[hand.individual].opening_m),
                    scene_opening_m=float(hand.first_opening_m),
                    blocked=others.grippers[hand.individual].blocked,
                )
                for hand in (arm.gripper for arm in scene.arms)
                if hand is not None and hand.individual in others.grippers
            ),
            bases=tuple(
                observe_base(scene.names[each.individual], others.bases[each.individual].pose, each.pose)
                for each in scene.bases
                if each.individual in others.bases
            ),
            faults=() if fault is None else (fault.reason if isinstance(fault, DeviceStop) else fault,),
        )


class _ArmLook:
    """Looks at one arm."""

    def __init__(self, facts: ArmSpec, name: str, arm: RemoteArmDriver) -> None:
        self._facts, self._name, self._arm = facts, name, arm
        model: Any = mujoco.MjModel.from_xml_path(str(facts.model))
        self._joints = tuple(model.joint(number).name for number in range(facts.home.size))
        self._kinematics = Kinematics(load_virtual_model(facts.model))
        self._seen: deque[tuple[Array, Array]] = deque(maxlen=KEPT)

    def observe(self) -> ObservedArm:
        arm, home = self._arm, self._facts.home
        snapshot, base = arm.process.read(), arm.base()
        condition, sentence = find_control_state(arm.process)
        state = snapshot.state
        at_home, _ = self._kinematics.tool_at(home, state)
        force = self._feel(state)
        if not self._seen or snapshot.phase != "lost":
            self._seen.append((state.q.copy(), state.dq.copy()))
        return ObservedArm(
            arm=self._name,
            condition=condition,
            sentence=sentence,
            joints=tuple(
                ObservedJoint(joint=name, measured_rad=float(q), scene_rad=float(there))
                for name, q, there in zip(self._joints, state.q, home, strict=True)
            ),
            tool_m=_point(base.apply(state.tool.position)),
            scene_tool_m=_point(base.apply(at_home.position)),
            force_n=None if force is None else _point(base.rotation @ force),
            period_s=arm.process.connected.period_s,
            lost=int(snapshot.number("lost")),
            late_s=snapshot.number("late_s"),
            felt="" if force is None else self._describe_felt(state, base.rotation @ force),
            remarks=tuple(self._find_remarks(state)),
        )

    def _feel(self, state: ArmState) -> Array | None:
        """Return the force (3,) in N on the tool in base; None where nothing measures it."""
        if self._facts.force_torque:
            return state.wrench[:3].copy()
        if not self._measures_torques:
            return None
        wrench, *_ = np.linalg.lstsq(state.jacobian.T, state.bias - state.effort, rcond=0.05)
        return np.asarray(wrench[:3], dtype=float)

    @property
    def _measures_torques(self) -> bool:
        connected = self._arm.process.connected
        return connected.mode == "torque" and connected.abilities.measures_effort

    def _describe_felt(self, state: ArmState, force: Array) -> str:
        most = FELT_N if self._facts.force_torque else FELT_BY_TORQUES_N
        return describe_felt(force) if is_still(state.dq) and np.linalg.norm(force) > most else ""

    def _find_remarks(self, state: ArmState) -> Iterator[str]:
        names, home = self._joints, self._facts.home
        if (beyond := find_beyond(names, state.q, self._arm.limits.range)) is not None:
            yield beyond
            return
        if (confusion := find_confusion(names, state.q, home)) is not None:
            yield confusion
        seen, speeds = (np.array(each) for each in zip(*self._seen, strict=True))
        yield from find_opposite_speeds(names, seen, speeds)
        if self._measures_torques:
            yield from find_opposite_weights(names, state.bias, state.effort)


def describe_felt(force: Array) -> str:
    """Return what a force (3,) in N on a tool at rest, in the world, may come from."""
    total, down = float(np.linalg.norm(force)), -float(force[2])
    if abs(down) < 0.8 * total:
        return f"the tool feels {total:.1f} N at rest: if nothing touches it, its force-torque sensor has to be tared"
    mass_kg = abs(down) / GRAVITY_M_S2
    way, wrong = ("down", "less") if down > 0.0 else ("up", "more")
    return (
        f"the tool feels {total:.1f} N {way} at rest: if nothing touches it, the scene has {mass_kg:.2f} kg {wrong} at "
        "the flange than there is, or the sensor has to be tared"
    )


def observe_base(name: str, measured: Pose, stated: Pose) -> ObservedBase:
    """Return a base beside where the scene has it."""
    here, there = _place(measured), _place(stated)
    away = float(np.hypot(here[0] - there[0], here[1] - there[1]))
    turned = abs((here[2] - there[2] + np.pi) % (2 * np.pi) - np.pi)
    remarks: tuple[str, ...] = ()
    if away > DIFFERS_M or turned > DIFFERS_HEADING_RAD:
        remarks = (f"it is {away:.2f} m and {np.degrees(turned):.0f} deg away from where the scene has it",)
    return ObservedBase(base=name, place=here, scene_place=there, remarks=remarks)


def _place(pose: Pose) -> tuple[float, float, float]:
    x, y, _ = pose.position
    return float(x), float(y), atan2(pose.rotation[1, 0], pose.rotation[0, 0])


def _point(point: Array) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z
