"""What a cell can do: its library and its devices; and the version of the server."""

from __future__ import annotations

from importlib.metadata import version

from skillc.contract.api.version import VersionInfo
from skillc.contract.device import Device, DeviceStatus
from skillc.contract.library import LibraryDescription, LibraryStatus
from skillc.server.asking import ask_about
from skillc.server.http.api_call import ApiCall
from skillc.server.http.openapi import VERSION
from skillc.server.routes.world import QUERY_S
from skillc.workers.questions import list_devices


async def show_version(call: ApiCall) -> VersionInfo:
    return VersionInfo(version("skillc"), VERSION)


async def list_libraries(call: ApiCall) -> tuple[LibraryStatus, ...]:
    return tuple(
        LibraryStatus(
            each.checked.name,
            each.checked.hash,
            each.refused,
            tuple(cell.settings.name for cell in call.server.find_users(each)),
            each.pending,
        )
        for each in call.server.libraries
    )


async def show_library(call: ApiCall) -> LibraryDescription:
    return call.server.library_of(call.server.find_cell(call.path["cell"])).checked.description


async def list_robots(call: ApiCall) -> tuple[DeviceStatus, ...]:
    devices = await ask_about(call, list_devices, tuple[Device, ...], QUERY_S)
    cell = call.server.find_cell(call.path["cell"])
    held = {each.id: each.devices for each in cell.operations.values() if each.devices != ()}
    return tuple(DeviceStatus(each, _find_holder(each.iri, held), cell.alive.arms.get(each.iri)) for each in devices)


def _find_holder(device: str, held: dict[str, tuple[str, ...] | None]) -> str | None:
    """Return the operation that holds a device, by itself or with the whole cell."""
    return next((each for each, devices in held.items() if devices is None or device in devices), None)
