"""Checks poses that are stated by angles or by what a thing is on: stated once, on something, with sizes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.frames import arm_with_sensor
from skillc_runtime.world.space.shape.shapes import SHELF_BOARDS
from skillc_runtime.world.state.terms import (
    ANCHOR,
    ANGLES,
    BASE_FRAME_ID,
    BOARD,
    BOARDS,
    FACE,
    HAS_SHEET,
    IMAGE_SHEET,
    INSPECTION_CAMERA,
    LOCATION,
    OFFSET,
    ON,
    ORIENTATION,
    POSITION,
    SCENE,
    SHAPE,
    SIZE,
)
from skillc_runtime.world.state.world_state import WorldState


def supports_of(state: WorldState) -> dict[str, str]:
    """Return what each thing is stated to be on; nothing if the vocabulary has no such relation."""
    return dict(sorted(state.facts[ON].pairs(), reverse=True)) if ON in state.facts else {}


def check_stated_poses(state: WorldState) -> Iterator[SceneViolation]:
    """Yield poses that are stated twice, parts of poses without the rest, and supports or things without a size."""
    if ON not in state.facts:
        return
    supports = supports_of(state)
    detailed = (*ANGLES, *OFFSET, ANCHOR, FACE, BOARD)
    written = {each for name in detailed for each, value in state.stored[name].items() if value is not None}
    for individual in sorted(written | supports.keys()):
        yield from _stated_twice(state, individual, supports)
        if individual in supports:
            yield from _partial_on(state, individual)
            yield from _no_board(state, individual, supports[individual])
            yield from _without_size(state, individual, supports)
        else:
            yield from _on_nothing(state, individual)
    yield from _on_flange(state)


def _on_flange(state: WorldState) -> Iterator[SceneViolation]:
    """Yield cameras on flanges, by whose images something is inspected, whose place there is not stated."""
    short = state.vocabulary.short
    cameras = state.instances(INSPECTION_CAMERA) if INSPECTION_CAMERA in state.vocabulary.classes else ()
    for camera in sorted(cameras):
        arm = arm_with_sensor(state, camera)
        lost = [each for each in POSITION if each in state.stored and state.value(camera, each) is None]
        if arm and lost and any(state.is_a(each, IMAGE_SHEET) for each in state.objects(camera, HAS_SHEET)):
            message = f"{short(camera)} is on the flange of {short(arm)} and has no {', '.join(map(short, lost))}"
            yield SceneViolation(camera, None, "partial-pose", message, "write where it is in the flange, in m")


def _stated_twice(state: WorldState, individual: str, supports: dict[str, str]) -> Iterator[SceneViolation]:
    short = state.vocabulary.short
    in_frame, angles, quaternion = (
        _stated(state, individual, names) for names in ((BASE_FRAME_ID, *POSITION), ANGLES, ORIENTATION)
    )
    if in_frame and individual in supports:
        message = f"{short(individual)} has a {short(in_frame[0])} and is on {short(supports[individual])}"
        yield SceneViolation(individual, ON, "two-poses", message, f"keep the {short(in_frame[0])} or `{short(ON)}`")
    if angles and quaternion:
        message = f"{short(individual)} has a {short(angles[0])} and a {short(quaternion[0])}: its turn is stated twice"
        cure = "keep the angles, in degrees, or the quaternion"
        yield SceneViolation(individual, angles[0], "two-poses", message, cure)


def _partial_on(state: WorldState, individual: str) -> Iterator[SceneViolation]:
    """Yield an incomplete quaternion of a thing that is on another."""
    short, stated = state.vocabulary.short, _stated(state, individual, ORIENTATION)
    if stated and len(stated) < len(ORIENTATION):
        lost = [short(name) for name in ORIENTATION if name not in stated]
        message = f"{short(individual)} has a {short(stated[0])} and no {', '.join(lost)}"
        yield SceneViolation(individual, stated[0], "partial-pose", message, "write all four, or `skillc:yaw DEGREES`")


def _no_board(state: WorldState, individual: str, support: str) -> Iterator[SceneViolation]:
    """Yield a board that what a thing is on does not have."""
    short, board = state.vocabulary.short, state.value(individual, BOARD)
    if not isinstance(board, int):
        return
    stated = state.value(support, BOARDS)
    boards = stated if isinstance(stated, int) else SHELF_BOARDS
    what = f"{short(individual)} is on board {board} of {short(support)}, which"
    if state.value(support, SHAPE) != "shelf":
        cure = f'write `{short(SHAPE)} "shelf"` for it, or no `{short(BOARD)}`'
        yield SceneViolation(individual, BOARD, "partial-pose", f"{what} is no shelf", cure)
    elif board > boards:
        cure = f"boards are counted from the bottom, from 1 to {boards}"
        yield SceneViolation(individual, BOARD, "partial-pose", f"{what} has {boards}", cure)


def _on_nothing(state: WorldState, individual: str) -> Iterator[SceneViolation]:
    """Yield an offset or an angle of a thing that is neither on another, nor in a frame, nor on an arm."""
    short, offset = state.vocabulary.short, _stated(state, individual, (*OFFSET, ANCHOR, FACE, BOARD))
    framed = state.value(individual, BASE_FRAME_ID) is not None or arm_with_sensor(state, individual) is not None
    angles = [] if framed else _stated(state, individual, ANGLES)
    for name in [*offset[:1], *angles[:1]]:
        message = f"{short(individual)} has a {short(name)} and is on nothing"
        yield SceneViolation(individual, name, "partial-pose", message, f"say what it is on: `{short(ON)} THING`")


def _without_size(state: WorldState, individual: str, supports: dict[str, str]) -> Iterator[SceneViolation]:
    """Yield what a thing is on if its size is not known, and a part of the thing's own size that is missing."""
    support = supports[individual]
    short, lost = state.vocabulary.short, _lacking(state, support)
    if len(lost) == len(SIZE) and any(state.is_a(support, cls) for cls in (LOCATION, SCENE)):
        special = [
            name for name, plain in ((ANCHOR, "centre"), (FACE, "top")) if _other(state, individual, name, plain)
        ]
        lost = lost if special else []
    if lost and (support not in supports or len(lost) == len(SIZE)):
        message = f"{short(individual)} is on {short(support)}, which has no {', '.join(map(short, lost))}"
        cure = (
            f"write the size of {short(support)} in m, `{short(SIZE[0])} 0.6`, or place {short(individual)} in a frame"
        )
        yield SceneViolation(individual, ON, "missing-size", message, cure)
    own = _lacking(state, individual)
    if 0 < len(own) < len(SIZE):
        message = f"{short(individual)} is on {short(support)}, and has no {', '.join(map(short, own))}"
        yield SceneViolation(individual, ON, "missing-size", message, "write all three, or none for a point")


def _lacking(state: WorldState, individual: str) -> list[str]:
    """Return the sizes that a thing lacks, except those whose lack `check_required` reports."""
    known = state.vocabulary.classes
    required = {name for cls in state.classes.get(individual) if cls in known for name in known[cls].required}
    return [name for name in SIZE if state.value(individual, name) is None and name not in required]


def _other(state: WorldState, individual: str, name: str, plain: str) -> bool:
    return state.value(individual, name) not in (None, plain)


def _stated(state: WorldState, individual: str, names: Sequence[str]) -> list[str]:
    return [name for name in names if state.value(individual, name) is not None]
