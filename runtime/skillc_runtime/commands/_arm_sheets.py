"""Arms of scenes whose data sheets serve neither their controller nor their model."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_runtime.commands._diagnostics import with_shown_path
from skillc_runtime.control.gains import UnknownController, read_gains
from skillc_runtime.scene.load import Scene
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.world.state.data_sheet import Sheet, SheetError
from skillc_runtime.world.state.terms import ARM_DEVICE, COMPLIANT_CONTROLLER, HAS_SHEET, POSTURE_NAME
from skillc_runtime.world.state.world_state import WorldState

HOME = "home"
"""The posture that every arm has."""


def unfit_sheets(scene: Scene, path: str) -> Iterator[Diagnostic]:
    """Yield the places in the scene file at `path` where an arm names a sheet that lacks what it needs."""
    for each in scene.said:
        arm = iri_of(each.subject)
        if each.predicate == HAS_SHEET and each.lines.path == path and scene.state.is_a(arm, ARM_DEVICE):
            sheet = Sheet(scene.state, iri_of(each.object))
            lacking = _lacking(scene.state, arm, sheet)
            if lacking is not None:
                message = f"{scene.state.vocabulary.short(arm)} cannot be run with this sheet: {lacking}"
                yield _misspelt_home(scene, path, sheet, message) or Diagnostic(
                    "unfit-sheet", with_shown_path(each.object_place), message, "name the sheet of this arm"
                )


def _misspelt_home(scene: Scene, path: str, sheet: Sheet, message: str) -> Diagnostic | None:
    """Return what is reported at the name of a posture in this file that is close to the one that is missing."""
    near = get_close_matches(HOME, sheet.posture_names, n=1) if HOME not in sheet.posture_names else []
    for each in scene.said:
        named = each.predicate == POSTURE_NAME and iri_of(each.subject) in sheet.postures and each.lines.path == path
        if named and scene.state.value(iri_of(each.subject), POSTURE_NAME) in near:
            span = with_shown_path(each.object_place)
            fix = Fix(span, f'"{HOME}"', f'write "{HOME}"', safe=False)
            return Diagnostic("unfit-sheet", span, message, f"did you mean `{HOME}`?", fix=fix)
    return None


def _lacking(state: WorldState, arm: str, sheet: Sheet) -> str | None:
    """Return what a sheet lacks for an arm; what keeps its controller from being known is told elsewhere."""
    # The simulator takes long to import.
    import mujoco

    controller = state.value(arm, COMPLIANT_CONTROLLER)
    try:
        if controller is not None:
            read_gains(str(controller), sheet.number)
        joints, home = len(mujoco.MjSpec.from_file(str(sheet.model)).joints), sheet.posture(HOME).size
    except UnknownController:
        return None
    except SheetError as error:
        return str(error)
    except ValueError as error:
        return f"its model cannot be read: {error}"
    return None if joints == home else f"its model has {joints} joints, and its posture home {home} numbers"
