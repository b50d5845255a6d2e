"""Arms of scenes whose data sheets serve neither their controller nor their model."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_dsl.diagnostics import Diagnostic
from skillc_runtime.commands._diagnostics import span_of
from skillc_runtime.world.individuals import iri_of
from skillc_runtime.world.scene import Scene
from skillc_runtime.world.sheet import Sheet, SheetError
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.terms import ARM_DEVICE, COMPLIANT_CONTROLLER, HAS_SHEET


def unfit_sheets(scene: Scene, path: str) -> Iterator[Diagnostic]:
    """Yield the places in the scene file at `path` where an arm names a sheet that lacks what it needs."""
    for each in scene.said:
        arm = iri_of(each.subject)
        if each.predicate == HAS_SHEET and each.lines.path == path and scene.state.is_a(arm, ARM_DEVICE):
            lacking = _lacking(scene.state, arm, Sheet(scene.state, iri_of(each.object)))
            if lacking is not None:
                message = f"{scene.state.vocabulary.short(arm)} cannot be run with this sheet: {lacking}"
                yield Diagnostic("unfit-sheet", span_of(each.object_place), message, "name the sheet of this arm")


def _lacking(state: WorldState, arm: str, sheet: Sheet) -> str | None:
    """Return what a sheet lacks for an arm; what keeps its controller from being known is told elsewhere."""
    # The controllers bring the simulator with them, which takes long to import.
    import mujoco

    from skillc_runtime.controllers.gains import UnknownController, gains

    controller = state.value(arm, COMPLIANT_CONTROLLER)
    try:
        if controller is not None:
            gains(str(controller), sheet.number)
        joints, home = len(mujoco.MjSpec.from_file(str(sheet.model)).joints), sheet.posture("home").size
    except UnknownController:
        return None
    except SheetError as error:
        return str(error)
    except ValueError as error:
        return f"its model cannot be read: {error}"
    return None if joints == home else f"its model has {joints} joints, and its posture home {home} numbers"
