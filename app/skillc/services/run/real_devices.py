"""How far simulated devices are from what they should be, as a run asks for it."""

from __future__ import annotations

from msgspec.structs import replace

from skillc.errors import RequestError
from skillc.services.tasks.loading import LoadedTask
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.reality import IDEAL, set_reality
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState


def with_reality(task: LoadedTask, reality: str) -> LoadedTask:
    """Return a task in a world of its own, in which arms and tools are as far from ideal as `reality` says.

    RequestError if it says nothing, or if nothing would differ; SheetError if a device has no data sheet.
    """
    return replace(task, world=WorldModel(require_reality(reality, task.world.snapshot())))


def require_reality(reality: str, state: WorldState) -> WorldState:
    """Return a world in which arms and tools are as far from ideal as `reality` says; errors as of `with_reality`."""
    try:
        return set_reality(state, reality)
    except ValueError as error:
        raise RequestError(f"--reality {reality}: {error}") from error


def check_reality(cell: Backend, reality: str) -> None:
    """Raise RequestError if devices of a cell cannot be other than they are."""
    if reality != IDEAL and not cell.capabilities.imperfect:
        raise RequestError(f"--reality {reality}: only what computes physics, such as mujoco, has imperfect devices")
