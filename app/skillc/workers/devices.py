"""Lists the devices of a cell with what their data sheets state."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from skillc.contract.device import Device, DeviceKind, SheetFigure
from skillc_runtime.world.state.elements import Element
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    CAMERA,
    COMPLIANT_CONTROLLER,
    END_EFFECTOR,
    HAS_A,
    HAS_SHEET,
    MOBILE_ROBOT,
    ROBOT,
    SENSOR,
    TEMPLATE,
)
from skillc_runtime.world.state.world_state import WorldState

KINDS: Mapping[DeviceKind, str] = MappingProxyType(
    {
        "base": MOBILE_ROBOT,
        "robot": ROBOT,
        "arm": ARM_DEVICE,
        "gripper": END_EFFECTOR,
        "camera": CAMERA,
        "sensor": SENSOR,
    }
)
"""The class of each kind; a device is of the first kind that fits."""


def list_devices(state: WorldState) -> tuple[Device, ...]:
    """Return the devices of a world, in the order of their IRIs."""
    kinds = {iri: kind for kind, cls in tuple(KINDS.items())[::-1] for iri in state.instances(cls)}
    real = sorted(kinds.keys() - state.instances(TEMPLATE))
    return tuple(_describe(iri, kinds, state) for iri in real)


def _describe(iri: str, kinds: Mapping[str, DeviceKind], state: WorldState) -> Device:
    short = state.vocabulary.short
    holders = sorted(each for each in state.subjects(HAS_A, iri) if each in kinds)
    controller = state.value(iri, COMPLIANT_CONTROLLER)
    return Device(
        iri,
        short(iri),
        kinds[iri],
        tuple(sorted(map(short, state.types(iri)))),
        holders[0] if holders else None,
        None if controller is None else str(controller),
        tuple(_read_figures(iri, state)),
    )


def _read_figures(iri: str, state: WorldState) -> list[SheetFigure]:
    sheets = (Element(state, each) for each in sorted(state.objects(iri, HAS_SHEET)))
    stated = (each for sheet in sheets for each in sheet.properties)
    return [SheetFigure(state.vocabulary.short(each.property), _plain(each.value), each.unit) for each in stated]


def _plain(value: object) -> str | bool | int | float:
    return value if isinstance(value, str | bool | int | float) else str(value)
