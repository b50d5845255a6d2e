"""Creates a new scene: a workstation, with or without an arm on a pedestal."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from skillc.errors import RequestError, ServiceError
from skillc.services.library.libraries import load_vocabulary
from skillc.services.reporting.files import inspect_path
from skillc.services.scaffolding.project_templates import open_templates
from skillc_ontology import catalogue
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.terms import ARM_DEVICE, COMPLIANT_CONTROLLER, HAS_GRIPPER, HAS_SENSOR, HAS_SHEET
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class _Arm:
    """An arm with a gripper as terms of a scene: prefixed names, and the name of the controller."""

    cls: str
    sheet: str
    controller: str
    gripper: str
    gripper_sheet: str
    sensors: tuple[str, ...]


def create_scene(path: Path, arm: str | None) -> None:
    """Write a new scene file, completely or not at all; `arm` is the name of an arm's class without its prefix.

    RequestError if the file exists or does not end in .ttl, or no shipped scene has such an arm. ServiceError if it
    cannot be written.
    """
    if path.suffix != ".ttl":
        raise RequestError(f"{path} is not a .ttl file; write {path.with_suffix('.ttl')}")
    found = inspect_path(path)
    if found.kind != "missing":
        raise RequestError(f"{path} {found.is_what} already; choose another name or remove it")
    text = _format(None if arm is None else _find_arm(arm))
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        raise ServiceError(f"cannot create {path}: {error.strerror}") from error


def _find_arm(name: str) -> _Arm:
    """Return an arm as a shipped scene has it, with the gripper that it carries there."""
    vocabulary, known = load_vocabulary(), set[str]()
    for scene in sorted(catalogue.scene_names()):
        state = load_scene(catalogue.scene_path(scene), vocabulary)
        for arm in sorted(state.instances(ARM_DEVICE)):
            cls = vocabulary.short(min(state.types(arm)))
            known.add(cls.rpartition(":")[2])
            if cls.rpartition(":")[2].casefold() == name.casefold() and state.objects(arm, HAS_GRIPPER):
                return _describe_arm(state, arm)
    raise RequestError(f"there is no arm {name}; there is {', '.join(sorted(known))}")


def _describe_arm(state: WorldState, arm: str) -> _Arm:
    short = state.vocabulary.short
    gripper = min(state.objects(arm, HAS_GRIPPER))
    return _Arm(
        cls=short(min(state.types(arm))),
        sheet=short(min(state.objects(arm, HAS_SHEET))),
        controller=str(state.value(arm, COMPLIANT_CONTROLLER)),
        gripper=short(min(state.types(gripper))),
        gripper_sheet=short(min(state.objects(gripper, HAS_SHEET))),
        sensors=tuple(short(min(state.types(each))) for each in sorted(state.objects(arm, HAS_SENSOR))),
    )


def _format(arm: _Arm | None) -> str:
    title = f"A cell with an arm of the class {arm.cls}" if arm else "A cell"
    return open_templates().get_template("scene.ttl.j2").render(title=title, arm=arm).rstrip() + "\n"
