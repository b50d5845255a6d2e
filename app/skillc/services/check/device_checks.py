"""Checks arms in scenes: controllers that an arm cannot use, data sheets that do not fit controller or model."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

import pyoxigraph as ox

from skillc.services.project.project import Project
from skillc.services.scene.diagnostics import with_shown_path
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.source import Span
from skillc_dsl.spelling import did_you_mean
from skillc_rdf.turtle.parser import parse
from skillc_rdf.turtle.statements import Statement
from skillc_runtime.control.gains import CONTROLLERS, RobotGains, UnknownController, read_gains, read_law
from skillc_runtime.devices.arm import Mode
from skillc_runtime.scene.documents import BASE
from skillc_runtime.scene.load import LoadedScene
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.world.state.data_sheet import DataSheet, SheetError
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    COMPLIANT_CONTROLLER,
    FORCE_TORQUE_SENSOR,
    HAS_SENSOR,
    HAS_SHEET,
    POSTURE_NAME,
    TO_BE_STATED,
)
from skillc_runtime.world.state.world_state import WorldState

HOME = "home"
"""The posture that every arm has."""

INCOMPLETE = "incomplete-sheet"
"""The problem of a data sheet with properties that are still to be stated."""


def check_controllers(scene: LoadedScene, path: str) -> Iterator[Diagnostic]:
    """Yield the places in the scene file at `path` where an arm names a controller that does not exist or fit it."""
    named = [each for each in scene.said if each.predicate == COMPLIANT_CONTROLLER and each.lines.path == path]
    if not named:
        return
    known = tuple(CONTROLLERS)
    for each in named:
        name = each.object.value if isinstance(each.object, ox.Literal) else str(each.object)
        if ":" in name or name in known:
            yield from _unusable_controller(scene.state, name, each)
        else:
            span, near = with_shown_path(each.object_place), get_close_matches(name, known, n=1)
            message = f'there is no controller "{name}"; there are: {", ".join(known)}'
            fix = Fix(span, f'"{near[0]}"', f'write "{near[0]}"', safe=False) if near else None
            yield Diagnostic("unknown-controller", span, message, did_you_mean(name, known), fix=fix)


def _unusable_controller(state: WorldState, name: str, statement: Statement) -> Iterator[Diagnostic]:
    """Yield why an arm cannot use the controller that a statement names: one that is shipped, or a class of a user."""
    span, arm = with_shown_path(statement.object_place), iri_of(statement.subject)
    try:
        law = read_law(name, _any_number)
    except UnknownController as error:
        yield Diagnostic("unknown-controller", span, str(error), "name `module:Class` of a control law")
        return
    short, modes = state.vocabulary.short, _modes(state, arm)
    if modes and law.mode not in modes and not isinstance(law, RobotGains):
        message = f'"{name}" gives {law.mode} commands, and {short(arm)} takes {" and ".join(modes)} commands'
        other = next(each for each in CONTROLLERS if read_law(each, _any_number).mode in modes)
        fix = Fix(span, f'"{other}"', f'write "{other}"', safe=False)
        yield Diagnostic("unfit-controller", span, message, f'"{other}" gives such commands', fix=fix)
    elif law.needs_force and not any(state.is_a(each, FORCE_TORQUE_SENSOR) for each in state.objects(arm, HAS_SENSOR)):
        message = f'"{name}" needs the forces at the wrist, and {short(arm)} has no {short(FORCE_TORQUE_SENSOR)}'
        help_ = f"write `{short(HAS_SENSOR)} lab:Sensor-1` here, and `lab:Sensor-1 a {short(FORCE_TORQUE_SENSOR)} .`"
        yield Diagnostic("unfit-controller", span, message, help_)


def _any_number(_: str) -> float:
    """Stand for the numbers of a data sheet where only the kind of a controller matters."""
    return 1.0


def _modes(state: WorldState, arm: str) -> tuple[Mode, ...]:
    """Return the kinds of commands that an arm takes; none if its class does not say."""
    # The simulator is slow to import.
    from skillc_runtime.backends.simulation.scene_reading import MODES

    return tuple(mode for cls, mode in MODES.items() if state.is_a(arm, cls))


def check_sheets(scene: LoadedScene, path: str) -> Iterator[Diagnostic]:
    """Yield the places in the scene file at `path` where an arm names a data sheet that lacks required data."""
    for each in scene.said:
        arm = iri_of(each.subject)
        if each.predicate == HAS_SHEET and each.lines.path == path and scene.state.is_a(arm, ARM_DEVICE):
            sheet = DataSheet(scene.state, iri_of(each.object))
            if sheet.unstated:
                yield _incomplete(scene, arm, sheet, with_shown_path(each.object_place))
                continue
            missing = _missing_from(scene.state, arm, sheet)
            if missing is not None:
                message = f"{scene.state.vocabulary.short(arm)} cannot be run with this sheet: {missing}"
                yield _misspelt_home(scene, path, sheet, message) or Diagnostic(
                    "unfit-sheet", with_shown_path(each.object_place), message, "name the sheet of this arm"
                )


def _incomplete(scene: LoadedScene, arm: str, sheet: DataSheet, span: Span) -> Diagnostic:
    """Return the diagnostic of an arm whose data sheet says that properties are still to be stated."""
    short = scene.state.vocabulary.short
    names = ", ".join(f"skillc:{name}" for name in sheet.unstated)
    message = f"{short(arm)} cannot be run: {short(sheet.individual)} does not state {names} yet"
    return Diagnostic(INCOMPLETE, span, message, f"write them in the sheet, and remove them from {short(TO_BE_STATED)}")


def check_project_sheets(project: Project) -> Iterator[Diagnostic]:
    """Yield the data sheets of a project that say that properties are still to be stated."""
    files = (file for folder in project.ontologies for file in sorted((folder / "robots").glob("*.ttl")))
    for file in files:
        statements = parse(str(file), file.read_text("utf-8", errors="replace"), BASE).statements
        for each in statements:
            if each.predicate == TO_BE_STATED and isinstance(each.object, ox.Literal) and each.object.value.strip():
                yield _unstated(each.object.value, with_shown_path(each.object_place))


def _unstated(properties: str, span: Span) -> Diagnostic:
    """Return the diagnostic of a data sheet that lists properties, separated by spaces, as still to be stated."""
    names = ", ".join(f"skillc:{name}" for name in properties.split())
    message = f"this data sheet does not state {names} yet, so that no scene can use its arm"
    return Diagnostic(INCOMPLETE, span, message, "write them, with their source, and remove them here", "warning")


def _misspelt_home(scene: LoadedScene, path: str, sheet: DataSheet, message: str) -> Diagnostic | None:
    """Return the diagnostic at a posture in this file whose name is close to the missing one; None without one."""
    near = get_close_matches(HOME, sheet.posture_names, n=1) if HOME not in sheet.posture_names else []
    for each in scene.said:
        named = each.predicate == POSTURE_NAME and iri_of(each.subject) in sheet.postures and each.lines.path == path
        if named and scene.state.value(iri_of(each.subject), POSTURE_NAME) in near:
            span = with_shown_path(each.object_place)
            fix = Fix(span, f'"{HOME}"', f'write "{HOME}"', safe=False)
            return Diagnostic("unfit-sheet", span, message, f"did you mean `{HOME}`?", fix=fix)
    return None


def _missing_from(state: WorldState, arm: str, sheet: DataSheet) -> str | None:
    """Return what a sheet lacks for an arm, or None; unusable controllers are reported by `check_controllers`."""
    # The simulator is slow to import.
    import mujoco

    controller, modes = state.value(arm, COMPLIANT_CONTROLLER), _modes(state, arm)
    try:
        if controller is not None and (not modes or read_law(str(controller), _any_number).mode in modes):
            read_gains(str(controller), sheet.number)
        joints, home = len(mujoco.MjSpec.from_file(str(sheet.model)).joints), sheet.posture(HOME).size
    except UnknownController:
        return None
    except SheetError as error:
        return str(error)
    except ValueError as error:
        return f"its model cannot be read: {error}"
    return None if joints == home else f"its model has {joints} joints, and its posture home {home} numbers"
