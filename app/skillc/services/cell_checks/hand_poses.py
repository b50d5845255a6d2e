"""Checks that some arm has a posture in which its hand grasps a thing, or is over the floor of a container."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from skillc.services.cell_checks.facts import placing_fact
from skillc_runtime.control.inverse_kinematics import solve_inverse_kinematics
from skillc_runtime.control.laws.virtual_arm import VirtualArm, load_virtual_model
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.primitives.known_limits import CORRECTION_M
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.handling import approach_pose
from skillc_runtime.world.space.bodies import has_body, read_shape
from skillc_runtime.world.space.bounding_boxes import bounding_box
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.grasping.grasps import WAYS, find_grasp
from skillc_runtime.world.space.grasping.grip_force import GraspError
from skillc_runtime.world.space.shape.shapes import Bin
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import CONTAINER, HAS_A, HAS_GRIPPER, MANIPULATABLE, PLACING_POSE
from skillc_runtime.world.state.world_state import WorldState

ROUND = 6
"""Decimals to which poses are compared with those that were solved before."""

OVER_FLOOR_M = 0.03
"""How high over the floor of a bin the hand is at least that puts something there."""

DOWN = tuple(np.array([[c, s, 0.0], [s, -c, 0.0], [0.0, 0.0, -1.0]]) for c, s in ((1, 0), (0, 1)))
"""Rotations (3, 3) of a hand that points down."""

SHIFTS = ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 1.0, 0.0))
"""Where a thing may be that is not where the scene has it, as shares of the greatest error."""

Ways = list[tuple[Pose, ...]]
"""Ways of doing something, each with the poses of the hand in the world that it needs."""


def check_postures(state: WorldState, known: frozenset[str]) -> Iterator[SceneViolation]:
    """Yield things that no hand can grasp, and bins into which none can put anything, for want of a posture.

    Those that are `known` to be out of reach are left out, and what is not known well enough to tell.
    """
    try:
        hands = _read_hand_reaches(state)
    except (SheetError, FrameError):
        return
    for thing in sorted(state.instances(MANIPULATABLE) - known):
        yield from _unreached(state, thing, {hand: _grasps(state, hand, thing) for hand in hands}, "grasp it")
    for bin_ in sorted(state.instances(CONTAINER) - state.instances(MANIPULATABLE) - known):
        ways = _puttings(state, bin_)
        yield from _unreached(state, bin_, dict.fromkeys(hands, ways), "put something on its floor")


def _grasps(state: WorldState, hand: HandReach, thing: str) -> Ways:
    """Return the ways to grasp a thing: where the hand is, and from where it approaches; those that are known."""
    found: Ways = []
    for way in WAYS:
        with suppress(GraspError, FrameError, SheetError):
            tool = find_grasp(state, hand.gripper, thing, way).tool
            found.append((tool, approach_pose(state, hand.gripper, thing, way)))
    return found


def _puttings(state: WorldState, bin_: str) -> Ways:
    """Return poses of a hand that points down into a bin, over the middle of its floor and halfway to its walls."""
    if any(state.is_a(each, PLACING_POSE) for each in state.objects(bin_, HAS_A)) or not has_body(state, bin_):
        return []
    try:
        shape, box = read_shape(state, bin_), bounding_box(state, bin_)
    except (FrameError, SheetError):
        return []
    if not isinstance(shape, Bin):
        return []
    x, y, _ = shape.inside
    height = shape.wall_m + OVER_FLOOR_M - float(box.half[2])
    spots = [(0.0, 0.0), (x / 4, 0.0), (-x / 4, 0.0), (0.0, y / 4), (0.0, -y / 4)]
    return [(Pose(box.middle.apply(np.array([u, v, height])), turn),) for u, v in spots for turn in DOWN]


def _unreached(state: WorldState, thing: str, ways: dict[HandReach, Ways], what: str) -> Iterator[SceneViolation]:
    """Yield a thing if there are ways to do something with it, and no arm has postures for one of them.

    It is a warning if one has where the thing may really be.
    """
    known = {hand: each for hand, each in ways.items() if each}
    if not known or _is_reached(known, SHIFTS[0]):
        return
    nearly = any(_is_reached(known, shift) for shift in SHIFTS[1:])
    short = state.vocabulary.short
    arms = " and ".join(sorted(short(hand.arm) for hand in known))
    message = f"{short(thing)} is out of reach: no posture of {arms} brings the hand where it would {what}"
    cure = "move it or the arm: the hand must also be turned as it has to be there"
    yield SceneViolation(
        thing, placing_fact(state, thing), "out-of-reach", message, cure, "warning" if nearly else "error"
    )


def _is_reached(ways: dict[HandReach, Ways], shift: tuple[float, float, float]) -> bool:
    moved = CORRECTION_M * np.array(shift)
    return any(
        all(hand.reaches(Pose(each.position + moved, each.rotation)) for each in way)
        for hand, found in ways.items()
        for way in found
    )


@dataclass(frozen=True, slots=True, eq=False)
class HandReach:
    """An arm with a gripper: its IRIs, its base in the world, its models, and its home posture (nv,) in rad."""

    arm: str
    gripper: str
    base: Pose
    models: tuple[str, str]
    home: tuple[float, ...]

    def reaches(self, hand: Pose) -> bool:
        """Whether some posture puts the hand at a pose in the world; the same answer in each call."""
        there = self.base.inverse() @ hand
        place = tuple(np.round(there.position, ROUND).tolist())
        turn = tuple(np.round(there.rotation, ROUND).ravel().tolist())
        return _reaches(self.models, self.home, place, turn)


def _read_hand_reaches(state: WorldState) -> list[HandReach]:
    """Return all arms that have a gripper, in order of IRI; their models are loaded.

    SheetError or FrameError if their facts are missing, or do not fit the models.
    """
    pairs = sorted((arm, gripper) for arm, gripper in state.pairs(HAS_GRIPPER))
    return [_read(state, arm, gripper) for arm, gripper in pairs]


def _read(state: WorldState, arm: str, gripper: str) -> HandReach:
    sheet = sheet_of(state, arm)
    models = str(sheet.model), str(sheet_of(state, gripper).model)
    home = tuple(sheet.posture("home").tolist())
    _arm_with_hand(models, home)
    return HandReach(arm, gripper, pose(state, arm), models, home)


@lru_cache(maxsize=1000)
def _reaches(
    models: tuple[str, str], home: tuple[float, ...], place: tuple[float, ...], turn: tuple[float, ...]
) -> bool:
    arm, limits = _arm_with_hand(models, home)
    target = Pose(np.array(place), np.array(turn).reshape(3, 3))
    return solve_inverse_kinematics(arm, target, np.array(home), limits) is not None


@lru_cache(maxsize=8)
def _arm_with_hand(models: tuple[str, str], home: tuple[float, ...]) -> tuple[VirtualArm, Array]:
    """Return an arm whose tool is the centre of its empty hand, and the ranges (nv, 2) of its joints in rad.

    SheetError if a model cannot be read, lacks its flange or its tool centre point, or has other joints than `home`.
    """
    # The simulator is slow to import.
    from pathlib import Path

    import mujoco

    try:
        model = load_virtual_model(Path(models[0]))
        hand = mujoco.MjModel.from_xml_path(models[1])
        data = mujoco.MjData(hand)
        mujoco.mj_kinematics(hand, data)
        centre = data.site("tcp")
        arm, q = VirtualArm(model), np.array(home)
        arm.update_kinematics(q)
    except (ValueError, KeyError) as error:
        raise SheetError(f"the models of the data sheets cannot be used: {error}") from error
    arm.mount_tool(q, arm.tool @ Pose(centre.xpos.copy(), centre.xmat.reshape(3, 3).copy()))
    return arm, model.jnt_range.copy()
