"""The devices of a cell, with what their data sheets state."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_runtime.devices.control_report import ControlReport

DeviceKind: TypeAlias = Literal["base", "robot", "arm", "gripper", "camera", "sensor"]


class SheetFigure(msgspec.Struct, frozen=True):
    """What a data sheet states: `property` is its short name; `unit` is that of the SI, empty without one."""

    property: str
    value: str | bool | int | float
    unit: str


class Device(msgspec.Struct, frozen=True):
    """A device: its IRI, its short name (`label`), its classes, and the device that it is part of.

    `figures` are those of its data sheet, `controller` is that of an arm.
    """

    iri: str
    label: str
    kind: DeviceKind
    types: tuple[str, ...]
    part_of: str | None
    controller: str | None
    figures: tuple[SheetFigure, ...]


class DeviceStatus(msgspec.Struct, frozen=True):
    """A device, and the operation that holds it; null if it is free.

    `control` is the report of the process that controls a real arm, at most a second old; null without one.
    """

    device: Device
    held_by: str | None
    control: ControlReport | None = None
