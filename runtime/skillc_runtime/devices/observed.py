"""What the devices of a cell tell of themselves, beside what the scene says of them; nothing moves for that."""

from __future__ import annotations

from typing import Protocol

import msgspec

DIFFERS_RAD, DIFFERS_M, DIFFERS_HEADING_RAD = 0.05, 0.02, 0.05
"""A joint, a tool or base, and the heading of a base that differ by more from the scene are marked."""


class ObservedJoint(msgspec.Struct, frozen=True, kw_only=True):
    """A joint of an arm, as it is measured and where the arm's home is in the scene, in rad."""

    joint: str
    measured_rad: float
    scene_rad: float

    @property
    def differs(self) -> bool:
        """Whether the joint is elsewhere than at home."""
        return abs(self.measured_rad - self.scene_rad) > DIFFERS_RAD


class ObservedArm(msgspec.Struct, frozen=True, kw_only=True):
    """An arm: its `condition` with what to do about it, its joints, and its tool in the world in m.

    `force_n` is what its tool feels, in the world in N, None where nothing measures it. Of the cycles of its control
    process `lost` were without a state of the device; the last one was `late_s` s late. `remarks` say what contradicts
    the scene, or cannot be; `felt` what a force at rest may come from, which keeps no task from beginning: many devices
    are tared when they are taken under control.
    """

    arm: str
    condition: str
    sentence: str
    joints: tuple[ObservedJoint, ...]
    tool_m: tuple[float, float, float]
    scene_tool_m: tuple[float, float, float]
    force_n: tuple[float, float, float] | None
    period_s: float
    lost: int
    late_s: float
    felt: str = ""
    remarks: tuple[str, ...] = ()

    @property
    def is_ready(self) -> bool:
        """Whether it can be taken under control."""
        return self.condition in ("ready", "in-control")


class ObservedGripper(msgspec.Struct, frozen=True, kw_only=True):
    """A gripper: the distance between its fingers as it is measured and in the scene, in m."""

    gripper: str
    opening_m: float
    scene_opening_m: float
    blocked: bool


class ObservedBase(msgspec.Struct, frozen=True, kw_only=True):
    """A mobile base, as it is measured and in the scene: (x, y) in m and the heading in rad, in the world."""

    base: str
    place: tuple[float, float, float]
    scene_place: tuple[float, float, float]
    remarks: tuple[str, ...] = ()


class ObservedCell(msgspec.Struct, frozen=True, kw_only=True):
    """The devices of a cell; `faults` are what devices besides its arms report."""

    arms: tuple[ObservedArm, ...]
    grippers: tuple[ObservedGripper, ...] = ()
    bases: tuple[ObservedBase, ...] = ()
    faults: tuple[str, ...] = ()

    @property
    def problems(self) -> tuple[str, ...]:
        """Why no task can begin in the cell: a sentence for each device that is not ready or contradicts the scene."""
        not_ready = [f"{each.arm}: {each.sentence or each.condition}" for each in self.arms if not each.is_ready]
        told = [f"{each.arm}: {remark}" for each in self.arms for remark in each.remarks]
        elsewhere = [f"{each.base}: {remark}" for each in self.bases for remark in each.remarks]
        return (*not_ready, *told, *elsewhere, *self.faults)


class CellObserver(Protocol):
    """Looks at the devices of a cell."""

    def observe(self) -> ObservedCell:
        """Return what the devices tell now."""
        ...
