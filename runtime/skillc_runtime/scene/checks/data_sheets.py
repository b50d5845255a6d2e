"""What a scene must say of data sheets: they are of their devices' kind, and speak of as many joints everywhere."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    ARM_SHEET,
    BASE_SHEET,
    END_EFFECTOR,
    FIXTURE,
    FIXTURE_SHEET,
    GRIPPER_SHEET,
    HAS_POSTURE,
    HAS_SHEET,
    JOINT_ACCELERATIONS,
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
)
"""Kinds of devices and of sheets that describe them; of sheets of other kinds nothing is known here."""


def check_data_sheets(state: WorldState) -> Iterator[SceneViolation]:
    """Yield the sheets that cannot describe their device, or any; where the vocabulary has no sheets there is none."""
    if {HAS_SHEET, HAS_POSTURE} <= state.facts.keys():
        yield from _wrong_sheets(state)
        for sheet in sorted(state.instances(ARM_SHEET)):
            yield from _joints(state, sheet)


def _wrong_sheets(state: WorldState) -> Iterator[SceneViolation]:
    short, known = state.vocabulary.short, set(chain.from_iterable(kinds for _, kinds in KINDS))
    for device, sheet in sorted(state.pairs(HAS_SHEET)):
        needed = {kind for cls, kinds in KINDS if state.is_a(device, cls) for kind in kinds}
        told = {kind for kind in known if state.is_a(sheet, kind)}
        if needed and told and needed.isdisjoint(told):
            message = f"{short(sheet)} is a {_names(state, told)}, and {short(device)} needs a {_names(state, needed)}"
            fitting = sorted({short(each) for kind in needed for each in state.instances(kind)})
            cure = f"there is {', '.join(fitting)}" if fitting else ""
            yield SceneViolation(device, HAS_SHEET, "wrong-sheet", message, cure)


def _names(state: WorldState, classes: set[str]) -> str:
    return " or ".join(sorted(map(state.vocabulary.short, classes)))


def _joints(state: WorldState, sheet: str) -> Iterator[SceneViolation]:
    """Each list of a sheet is numbers, one for each joint; the speeds say how many joints there are."""
    postures = ((posture, JOINT_VALUES) for posture in sorted(state.objects(sheet, HAS_POSTURE)))
    for owner, term in ((sheet, JOINT_SPEEDS), (sheet, JOINT_ACCELERATIONS), *postures):
        told = _miscounted(state, sheet, owner, term)
        if told is not None:
            yield SceneViolation(owner, term, "joint-numbers", *told)


def _miscounted(state: WorldState, sheet: str, owner: str, term: str) -> tuple[str, str] | None:
    """Return what is wrong with a list of numbers that is stated, and its cure."""
    text, short = state.value(owner, term), state.vocabulary.short
    if text is None:
        return None
    numbers, speeds, what = _numbers(text), _numbers(state.value(sheet, JOINT_SPEEDS)), f"{short(owner)}.{short(term)}"
    if numbers is None:
        return f'{what} = "{text}" is not numbers separated by spaces', "write a number for each joint"
    if owner == sheet and min(numbers, default=0.0) <= 0:
        return f'{what} = "{text}" is to be above 0 for each joint', ""
    if speeds and len(numbers) != len(speeds):
        message = f"{what} has {len(numbers)} numbers, and {short(sheet)}.{short(JOINT_SPEEDS)} {len(speeds)}"
        return message, "write a number for each joint in both"
    return None


def _numbers(text: object) -> list[float] | None:
    try:
        return [float(part) for part in str(text).split()]
    except ValueError:
        return None
