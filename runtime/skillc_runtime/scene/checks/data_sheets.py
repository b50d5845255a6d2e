"""Checks data sheets: they are of the kind of their devices, and have the same number of joints everywhere."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    ARM_SHEET,
    BASE_SHEET,
    CAMERA,
    CAMERA_SHEET,
    END_EFFECTOR,
    FIXTURE,
    FIXTURE_SHEET,
    GRIPPER_SHEET,
    HAS_POSTURE,
    HAS_SHEET,
    INSPECTION_CAMERA,
    INSPECTION_SHEET,
    JOINT_ACCELERATIONS,
    JOINT_JERKS,
    JOINT_SPEEDS,
    JOINT_VALUES,
    MOBILE_ROBOT,
    RIGID_TOOL_SHEET,
    TOOL,
    TOOL_SHEET,
)
from skillc_runtime.world.state.world_state import WorldState

KINDS = (
    (ARM_DEVICE, (ARM_SHEET,)),
    (END_EFFECTOR, (GRIPPER_SHEET,)),
    (MOBILE_ROBOT, (BASE_SHEET,)),
    (TOOL, (TOOL_SHEET, RIGID_TOOL_SHEET)),
    (FIXTURE, (FIXTURE_SHEET,)),
    (CAMERA, (CAMERA_SHEET,)),
    (INSPECTION_CAMERA, (INSPECTION_SHEET,)),
)
"""Kinds of devices with the kinds of sheets that describe them; other kinds are not checked."""


def list_sheet_kinds(vocabulary: Vocabulary, cls: str) -> frozenset[str]:
    """Return the kinds of sheets that describe devices of a class; none if it is not a known kind of device."""
    return frozenset(kind for device, kinds in KINDS if vocabulary.is_a(cls, device) for kind in kinds)


def check_data_sheets(state: WorldState) -> Iterator[SceneViolation]:
    """Yield sheets of the wrong kind and invalid lists of joint values; nothing if the vocabulary has no sheets."""
    if {HAS_SHEET, HAS_POSTURE} <= state.facts.keys():
        yield from _wrong_sheets(state)
        for sheet in sorted(state.instances(ARM_SHEET)):
            yield from _joint_lists(state, sheet)


def _wrong_sheets(state: WorldState) -> Iterator[SceneViolation]:
    short, known = state.vocabulary.short, set(chain.from_iterable(kinds for _, kinds in KINDS))
    for device, sheet in sorted(state.pairs(HAS_SHEET)):
        needed = {kind for cls, kinds in KINDS if state.is_a(device, cls) for kind in kinds}
        actual = {kind for kind in known if state.is_a(sheet, kind)}
        if needed and actual and needed.isdisjoint(actual):
            message = (
                f"{short(sheet)} is a {_names(state, actual)}, and {short(device)} needs a {_names(state, needed)}"
            )
            fitting = sorted({short(each) for kind in needed for each in state.instances(kind)})
            cure = f"there is {', '.join(fitting)}" if fitting else ""
            yield SceneViolation(device, HAS_SHEET, "wrong-sheet", message, cure)


def _names(state: WorldState, classes: set[str]) -> str:
    return " or ".join(sorted(map(state.vocabulary.short, classes)))


def _joint_lists(state: WorldState, sheet: str) -> Iterator[SceneViolation]:
    """Yield lists of a sheet that are not numbers, one for each joint; the speeds define the number of joints."""
    postures = ((posture, JOINT_VALUES) for posture in sorted(state.objects(sheet, HAS_POSTURE)))
    for owner, term in ((sheet, JOINT_SPEEDS), (sheet, JOINT_ACCELERATIONS), (sheet, JOINT_JERKS), *postures):
        problem = _list_problem(state, sheet, owner, term)
        if problem is not None:
            yield SceneViolation(owner, term, "joint-numbers", *problem)


def _list_problem(state: WorldState, sheet: str, owner: str, term: str) -> tuple[str, str] | None:
    """Return what is wrong with a list of numbers, if it is stated, and a hint."""
    text, short = state.value(owner, term), state.vocabulary.short
    if text is None:
        return None
    numbers, speeds, what = _numbers(text), _numbers(state.value(sheet, JOINT_SPEEDS)), f"{short(owner)}.{short(term)}"
    if numbers is None:
        return f'{what} = "{text}" is not numbers separated by spaces', "write a number for each joint"
    if owner == sheet and min(numbers, default=0.0) <= 0:
        return f'{what} = "{text}" must be above 0 for each joint', ""
    if speeds and len(numbers) != len(speeds):
        message = f"{what} has {len(numbers)} numbers, and {short(sheet)}.{short(JOINT_SPEEDS)} {len(speeds)}"
        return message, "write a number for each joint in both"
    return None


def _numbers(text: object) -> list[float] | None:
    try:
        return [float(part) for part in str(text).split()]
    except ValueError:
        return None
