"""Describes disturbances of a simulated cell in a line."""

from __future__ import annotations

from typing import assert_never

from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.devices.disturbances import Disturbance, LoseArm, MoveThing, PressEmergencyStop, PushArm, TakeThing


def describe_disturbance(disturbance: Disturbance) -> str:
    """Return what happened to a cell."""
    match disturbance:
        case PushArm(arm=arm, force_n=force, duration_s=seconds):
            return f"somebody pushes {local_name(arm)} with ({_list(force)}) N for {seconds:g} s"
        case MoveThing(thing=thing, by_m=by, turn_rad=turn):
            return f"somebody moves {local_name(thing)} by ({_list(by)}) m and turns it by {turn:g} rad"
        case TakeThing(thing=thing, by_m=by):
            return f"somebody takes {local_name(thing)} out of the hand and puts it ({_list(by)}) m beside"
        case PressEmergencyStop(pressed=pressed):
            return f"somebody {'presses' if pressed else 'releases'} the emergency stop"
        case LoseArm(arm=arm, lost=lost):
            return f"{local_name(arm)} {'does not answer' if lost else 'answers again'}"
        case _:
            assert_never(disturbance)


def _list(numbers: tuple[float, float, float]) -> str:
    return ", ".join(f"{each:g}" for each in numbers)
