"""Reads how parts look from above, by which pictures classify them."""

from __future__ import annotations

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Pose
from skillc_runtime.vision.part_look import TOLERATED_M2, PartLook
from skillc_runtime.world.space.frames import pose, size
from skillc_runtime.world.state.data_sheet import SheetError, number_of, triple_of
from skillc_runtime.world.state.terms import PART_KIND, SKILLC
from skillc_runtime.world.state.world_state import WorldState

FIRST_CODE, LAST_CODE, LABEL_SIZE, FACE_COLOUR, TOLERATED_DEFECT = (
    SKILLC + name for name in ("firstCode", "lastCode", "labelSize", "faceColour", "toleratedDefect")
)


def read_looks(state: WorldState, part: str) -> tuple[PartLook, ...]:
    """Return how a part would look from above as one of each kind, in order of IRI; SheetError if a fact is missing."""
    if PART_KIND not in state.vocabulary.classes:
        return ()
    across, up, _ = size(state, part)
    return tuple(_read(state, kind, (across, up)) for kind in sorted(state.instances(PART_KIND)))


def face_of(state: WorldState, part: str) -> Pose:
    """Return the pose in the world of the middle of the upper face of a part, z out of it; FrameError if not known."""
    return pose(state, part) @ Pose(np.array([0.0, 0.0, size(state, part)[2] / 2]), np.eye(3))


def _read(state: WorldState, kind: str, face: tuple[float, float]) -> PartLook:
    first, last = (round(number_of(state, kind, each)) for each in (FIRST_CODE, LAST_CODE))
    colour = triple_of(state, kind, FACE_COLOUR)
    if colour is None:
        raise SheetError(f"{state.vocabulary.short(kind)} has no skillc:faceColour in the world model")
    look = PartLook(
        kind=kind,
        codes=(first, last),
        size=face,
        label_m=number_of(state, kind, LABEL_SIZE),
        colour=colour,
        tolerated_m2=number_of(state, kind, TOLERATED_DEFECT, default=TOLERATED_M2),
    )
    if look.plate_m >= min(face):
        short = state.vocabulary.short
        raise SheetError(f"a label of {short(kind)} with its rim has {1e3 * look.plate_m:.0f} mm, more than the face")
    return look
