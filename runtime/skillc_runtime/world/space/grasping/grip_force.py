"""Whether friction between the fingers of a gripper carries a thing, and the force that this takes."""

from __future__ import annotations

from skillc_runtime.world.space.bodies import FRICTION_UNLESS_STATED, read_body
from skillc_runtime.world.state.data_sheet import number_of, sheet_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.terms import FRICTION, GRASP_FORCE, HAND_MASS, HAS_GRIPPER, HAS_SHEET, PAYLOAD, WEIGHT
from skillc_runtime.world.state.world_state import WorldState

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


class NoOtherWay(GraspError):
    """A gripper has no grasp of the way that was asked for; why not any other one is said of that."""


def grasp_force_n(state: WorldState, gripper: str, thing: str) -> float:
    """Return the force in N of a finger: what is stated, else what carries the weight with some reserve."""
    check_weight(state, gripper, thing)
    needed = 1.5 * _needed_force_n(state, thing)
    strongest = sheet_of(state, gripper).number("maxForce")
    return min(number_of(state, thing, GRASP_FORCE, default=max(GRASP_FORCE_N, needed)), strongest)


def check_weight(state: WorldState, gripper: str, thing: str) -> None:
    """Check that friction and the arm bear the thing.

    GraspError if 2 mu F < m (g + a), or if it weighs more than the payload of the arm allows.
    """
    strongest = sheet_of(state, gripper).number("maxForce")
    force_n = min(number_of(state, thing, GRASP_FORCE, default=strongest), strongest)
    if force_n >= _needed_force_n(state, thing):
        too_much = find_excess_load(state, gripper, thing, mass_of(state, thing))
        if too_much is not None:
            raise GraspError(
                too_much, f"use a stronger arm, or state its true `{state.vocabulary.short(WEIGHT)}`", "too-heavy"
            )
        return
    mass_kg, friction, short = mass_of(state, thing), _friction(state, thing), state.vocabulary.short
    held_kg = 2 * friction * force_n / (GRAVITY_M_S2 + ACCELERATION_M_S2)
    raise GraspError(
        f"{short(thing)} weighs {mass_kg:.3g} kg, and with {force_n:g} N and a friction of {friction:g} "
        f"{short(gripper)} carries at most {held_kg:.2g} kg",
        f"use a stronger gripper, or state its true `{short(WEIGHT)}` and `{short(FRICTION)}`",
        "too-heavy",
    )


def find_excess_load(state: WorldState, gripper: str, thing: str, mass_kg: float) -> str | None:
    """Return that a thing and the hand that holds it weigh more than the arm carries; None if they do not.

    Nothing is known of an arm whose sheet states no `payload`; a hand whose sheet states no `handMass` counts as light.
    mass_kg: kg, of the thing and all that it carries.
    """
    arm = min(state.subjects(HAS_GRIPPER, gripper), default=None)
    sheet = None if arm is None else next(iter(state.objects(arm, HAS_SHEET)), None)
    most_kg = None if sheet is None else state.value(sheet, PAYLOAD)
    if arm is None or not isinstance(most_kg, float):
        return None
    hand_kg = number_of(state, sheet_of(state, gripper).individual, HAND_MASS, default=0.0)
    if mass_kg + hand_kg <= most_kg:
        return None
    short = state.vocabulary.short
    return (
        f"{short(thing)} weighs {mass_kg:.3g} kg and {short(gripper)} {hand_kg:.3g} kg, "
        f"together more than the {most_kg:.3g} kg that {short(arm)} carries"
    )


def _needed_force_n(state: WorldState, thing: str) -> float:
    """Return the least force in N of a finger that carries a thing: F = m (g + a) / (2 mu)."""
    load_n = mass_of(state, thing) * (GRAVITY_M_S2 + ACCELERATION_M_S2)
    return load_n / max(2 * _friction(state, thing), 1e-6)


def mass_of(state: WorldState, thing: str) -> float:
    """Return the mass of a thing in kg, as far as the world model knows."""
    body = read_body(state, thing)
    return number_of(state, thing, WEIGHT, default=0.0) if body is None else body.mass_kg


def _friction(state: WorldState, thing: str) -> float:
    return number_of(state, thing, FRICTION, default=FRICTION_UNLESS_STATED)
