"""Grasps of a body from above, derived from its shape, its pose and the data sheet of the gripper; a stated one counts.

A hand points along z of its frame, and its fingers close along y. The tool centre point lies between the pads.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import FRICTION_UNLESS_STATED, RigidBody, read_body
from skillc_runtime.world.space.frame_tree import Unplaced
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.overhead import HAND_ABOVE_M, roof_problem
from skillc_runtime.world.space.shapes import Capsule, Cylinder, Sphere
from skillc_runtime.world.state.data_sheet import number_of, sheet_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.terms import (
    FINGER_DEPTH,
    FINGER_SPREAD,
    FINGER_TIP,
    FRICTION,
    GRASP_FORCE,
    GRASP_WIDTH,
    GRASPING_POSE,
    HAS_A,
    HAS_GRIPPER,
    WEIGHT,
)
from skillc_runtime.world.state.world_state import WorldState

UP = np.array([0.0, 0.0, 1.0])
OPENING_CLEARANCE_M = 0.04
"""How much farther than an object is wide the fingers are opened around it, if they can."""

LEAST_CLEARANCE_M = 0.006
"""How much farther than an object is wide the fingers must open at least."""

SUPPORT_CLEARANCE_M = 0.004
"""How far the tips of the fingers stay above what an object stands on."""

LEAST_HOLD_M = 0.002
"""How far an object must stand out above the tool centre point."""

FINGER_DEPTH_M, FINGER_TIP_M = 0.03, 0.01
"""How much of the fingers is free above and below the tool centre point, unless the data sheet says it."""

STANDING = 0.7
"""The cosine of the tilt up to which a round thing counts as standing."""

GRASP_FORCE_N = 30.0
"""The grasping force for what states none and is not heavy."""

GRAVITY_M_S2 = 9.81
ACCELERATION_M_S2 = 1.0
"""How hard an arm may accelerate what it holds."""


class GraspError(EvaluationError):
    """A gripper cannot grasp a thing: `problem` says why, with numbers, `cure` what to do; `name` is the diagnostic."""

    def __init__(self, problem: str, cure: str = "", name: str = "no-grasp") -> None:
        super().__init__(f"{problem}; {cure}" if cure else problem)
        self.problem, self.cure, self.name = problem, cure, name


@dataclass(frozen=True, slots=True, eq=False)
class GraspCandidate:
    """Where the tool centre point is in the world, and how wide the thing is between the fingers in m."""

    tool: Pose
    width_m: float


def find_grasp(state: WorldState, gripper: str, thing: str, choice: int = 1) -> GraspCandidate:
    """Return a grasp, the best for choice 1; a stated GraspingPose is the only one.

    GraspError if there are not so many; FrameError, MissingFact or SheetError if facts are missing.
    """
    grasps = find_grasps(state, gripper, thing)
    if choice > len(grasps):
        short = state.vocabulary.short
        raise GraspError(f"{short(gripper)} has no other way to grasp {short(thing)}: {len(grasps)} is known")
    return grasps[choice - 1]


def find_grasps(state: WorldState, gripper: str, thing: str) -> tuple[GraspCandidate, ...]:
    """Return all grasps, the best one first; errors as of `find_grasp`."""
    stated = stated_pose(state, thing, GRASPING_POSE)
    if stated is None:
        return _derive(state, gripper, thing)
    tool = pose(state, stated)
    width_m = width_between(state, gripper, thing, tool)
    widest = _check_width(state, gripper, thing, [0.0 if width_m is None else width_m])
    return (GraspCandidate(tool, widest if width_m is None else width_m),)


def stated_pose(state: WorldState, thing: str, cls: str) -> str | None:
    """Return the pose of a class that a thing states; the first by IRI of several, None without one."""
    return min((each for each in state.objects(thing, HAS_A) if state.is_a(each, cls)), default=None)


def grasp_opening_m(state: WorldState, gripper: str, grasp: GraspCandidate) -> float:
    """Return how far the fingers open around a thing, in m."""
    return min(grasp.width_m + OPENING_CLEARANCE_M, sheet_of(state, gripper).number("maxOpening"))


def grasp_force_n(state: WorldState, gripper: str, thing: str) -> float:
    """Return the force in N of a finger: what is stated, else what carries the weight with some reserve."""
    _check_weight(state, gripper, thing)
    needed = 1.5 * _needed_force_n(state, thing)
    strongest = sheet_of(state, gripper).number("maxForce")
    return min(number_of(state, thing, GRASP_FORCE, default=max(GRASP_FORCE_N, needed)), strongest)


def grasp_problem(state: WorldState, gripper: str, thing: str) -> GraspError | None:
    """Return why a gripper cannot grasp a thing as it lies; None if it can. Other errors as of `find_grasp`.

    Of a thing whose pose is not known, as an arm carries it, only the weight counts.
    """
    try:
        _check_weight(state, gripper, thing)
        with suppress(Unplaced):
            find_grasps(state, gripper, thing)
    except GraspError as error:
        return error
    return None


def width_between(state: WorldState, gripper: str, thing: str, tool: Pose) -> float | None:
    """Return how wide a thing is between the fingers of a hand in the world, in m; None if nothing says so.

    Two fingers that are apart meet a round thing beside its middle.
    """
    stated = state.value(thing, GRASP_WIDTH)
    if isinstance(stated, float):
        return stated
    body = read_body(state, thing)
    if body is None:
        return None
    low, high = span(body, tool.rotation[:, 1])
    half_m, beside_m = (high - low) / 2, _spread_m(state, gripper) / 2
    if not _is_round(body) or beside_m >= half_m:
        return high - low
    return half_m + float(np.sqrt(half_m**2 - beside_m**2))


def _spread_m(state: WorldState, gripper: str) -> float:
    return number_of(state, sheet_of(state, gripper).individual, FINGER_SPREAD, default=0.0)


def _is_round(body: RigidBody) -> bool:
    """Whether a body is round, seen from above."""
    standing = abs(float(body.pose.rotation[2, 2])) > STANDING
    return isinstance(body.shape, Sphere) or (standing and isinstance(body.shape, Cylinder | Capsule))


def span(body: RigidBody, direction: Array) -> tuple[float, float]:
    """Return where a body begins and ends along a direction (3,) of length 1 in the world, in m from the origin."""
    low = min(-each.reach(-direction, body.pose) for each in body.solids)
    return low, max(each.reach(direction, body.pose) for each in body.solids)


def _derive(state: WorldState, gripper: str, thing: str) -> tuple[GraspCandidate, ...]:
    body = read_body(state, thing)
    short = state.vocabulary.short
    if body is None:
        pose(state, thing)
        raise GraspError(f"nothing says how to grasp {short(thing)}: it has no body", "state a skiros:GraspingPose")
    if _is_round(body) and body.size[0] <= _spread_m(state, gripper):
        apart = 1e3 * _spread_m(state, gripper)
        raise GraspError(
            f"{short(thing)} has a diameter of {1e3 * body.size[0]:.0f} mm and slips between the fingers of "
            f"{short(gripper)}, which are {apart:.0f} mm apart",
            "use a gripper whose fingers meet",
        )
    away = _away_from_arm(state, gripper, body.pose.position)
    closings = _closings(body, away)
    spans = [span(body, each) for each in closings]
    widths = [high - low for low, high in spans]
    stated = state.value(thing, GRASP_WIDTH)
    fits = _check_width(state, gripper, thing, widths)
    height_m = _tool_height(state, gripper, body)
    roof = roof_problem(state, _middle(body, height_m), HAND_ABOVE_M)
    if roof is not None:
        raise GraspError(
            f"where {short(gripper)} would grasp {short(thing)}, {roof}", "put it where nothing is above it"
        )
    found: list[GraspCandidate] = []
    for closing, width_m in zip(closings, widths, strict=True):
        if width_m <= fits:
            held_m = float(stated) if isinstance(stated, float) and len(found) == 0 else width_m
            found.append(GraspCandidate(Pose(_middle(body, height_m), _hand(closing, away)), held_m))
    return tuple(sorted(found, key=lambda each: round(each.width_m, 3)))


def _check_width(state: WorldState, gripper: str, thing: str, widths: list[float]) -> float:
    """Return the greatest width in m that the fingers take; GraspError if all widths are greater."""
    widest = sheet_of(state, gripper).number("maxOpening")
    if min(widths) <= widest - LEAST_CLEARANCE_M:
        return widest - LEAST_CLEARANCE_M
    short, each = state.vocabulary.short, " and ".join(dict.fromkeys(f"{1e3 * width:.0f}" for width in widths))
    raise GraspError(
        f"{short(thing)} is {each} mm wide between the fingers, and {short(gripper)} takes at most "
        f"{1e3 * (widest - LEAST_CLEARANCE_M):.0f} mm: it opens to {1e3 * widest:.0f} mm",
        "use a wider gripper, lay it down differently, or state `skillc:graspWidth` where it is narrower",
        "too-wide",
    )


def _tool_height(state: WorldState, gripper: str, body: RigidBody) -> float:
    """Return the height in m of the tool centre point: the middle of the body, or as deep as the fingers reach."""
    sheet = sheet_of(state, gripper).individual
    depth_m = number_of(state, sheet, FINGER_DEPTH, default=FINGER_DEPTH_M)
    over_m = number_of(state, sheet, FINGER_TIP, default=FINGER_TIP_M) + SUPPORT_CLEARANCE_M
    bottom, top = span(body, UP)
    height_m = max((bottom + top) / 2, top - depth_m, bottom + over_m)
    if height_m > top - LEAST_HOLD_M:
        short = state.vocabulary.short
        raise GraspError(
            f"{short(body.individual)} is {1e3 * (top - bottom):.0f} mm high as it lies, and the fingers of "
            f"{short(gripper)} need {1e3 * (over_m + LEAST_HOLD_M):.0f} mm to hold it from above",
            "lay it down differently, or state a skiros:GraspingPose",
        )
    return height_m


def _middle(body: RigidBody, height_m: float) -> Array:
    """Return the point (3,) in m, in the world, over or in the middle of a body at a height in m."""
    x, y = (sum(span(body, axis)) / 2 for axis in np.eye(3)[:2])
    return np.array([x, y, height_m])


def _closings(body: RigidBody, away: Array) -> tuple[Array, Array]:
    """Return two horizontal directions (3,) across a body in which fingers can close, first that across `away`."""
    axes = body.pose.rotation
    if _is_round(body):
        along = away
    elif isinstance(body.shape, Cylinder | Capsule):
        along = axes[:, 2]
    else:
        along = axes[:, int(np.argmin(np.abs(axes[2])))]
    along = np.array([along[0], along[1], 0.0]) / np.hypot(along[0], along[1])
    across = np.cross(UP, along)
    return (across, along) if abs(along @ away) >= abs(across @ away) else (along, across)


def _hand(closing: Array, away: Array) -> Array:
    """Return the rotation (3, 3) of a hand that points down and closes along a direction; x points off the arm."""
    x = np.cross(closing, -UP)
    x = x if x @ away >= 0 else -x
    return np.column_stack([x, np.cross(-UP, x), -UP])


def _away_from_arm(state: WorldState, gripper: str, point: Array) -> Array:
    """Return the horizontal direction (3,) from the base of the arm to a point (3,) in the world."""
    arm = min(state.subjects(HAS_GRIPPER, gripper), default=None)
    away = np.array([1.0, 0.0, 0.0]) if arm is None else point - pose(state, arm).position
    away[2] = 0.0
    distance = float(np.linalg.norm(away))
    return away / distance if distance > 1e-6 else np.array([1.0, 0.0, 0.0])


def _check_weight(state: WorldState, gripper: str, thing: str) -> None:
    """Check that friction bears the thing; GraspError if 2 mu F < m (g + a)."""
    strongest = sheet_of(state, gripper).number("maxForce")
    force_n = min(number_of(state, thing, GRASP_FORCE, default=strongest), strongest)
    if force_n >= _needed_force_n(state, thing):
        return
    mass_kg, friction, short = _mass_kg(state, thing), _friction(state, thing), state.vocabulary.short
    held_kg = 2 * friction * force_n / (GRAVITY_M_S2 + ACCELERATION_M_S2)
    raise GraspError(
        f"{short(thing)} weighs {mass_kg:.3g} kg, and with {force_n:g} N and a friction of {friction:g} "
        f"{short(gripper)} carries at most {held_kg:.2g} kg",
        f"use a stronger gripper, or state its true `{short(WEIGHT)}` and `{short(FRICTION)}`",
        "too-heavy",
    )


def _needed_force_n(state: WorldState, thing: str) -> float:
    """Return the least force in N of a finger that carries a thing: F = m (g + a) / (2 mu)."""
    load_n = _mass_kg(state, thing) * (GRAVITY_M_S2 + ACCELERATION_M_S2)
    return load_n / max(2 * _friction(state, thing), 1e-6)


def _mass_kg(state: WorldState, thing: str) -> float:
    body = read_body(state, thing)
    return number_of(state, thing, WEIGHT, default=0.0) if body is None else body.mass_kg


def _friction(state: WorldState, thing: str) -> float:
    return number_of(state, thing, FRICTION, default=FRICTION_UNLESS_STATED)
