"""Finds in a run what was picked up and put down: which thing, by which hand, when, and where it was to go."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec
from msgspec.structs import replace

from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledPose
from skillc_runtime.world.state.terms import ARM_DEVICE, END_EFFECTOR
from skillc_runtime.world.state.world_state import WorldState

GRASPED, RELEASED = "grasped", "released"
"""The words with which primitives highlight that they have grasped or released something."""

TARGET = "target"
"""The name of the parameter with the pose to which a skill moves the tool."""


class Handling(msgspec.Struct, frozen=True):
    """A thing that a gripper of an arm held, all by IRI, from `grasped_s` to `released_s`; None if it never let go.

    `target_m` is the place (x, y) in m in the world to which the arm was last sent before it let go: where the middle
    of the thing should be. None if it is not known.
    """

    thing: str
    arm: str
    gripper: str
    grasped_s: float
    released_s: float | None = None
    target_m: tuple[float, float] | None = None


def find_handlings(history: RunHistory, state: WorldState) -> tuple[Handling, ...]:
    """Return what was picked up in a run, in order of time, from the highlights of its primitives."""
    ended = ((call.ended, call) for call in history.calls if call.status == "success" and call.ended is not None)
    calls = sorted(ended, key=_by_time)
    found: list[Handling] = []
    highlights = ((time, choice, each) for time, choice in calls for each in choice.highlights)
    for ended_s, call, highlight in highlights:
        if highlight.word == GRASPED:
            found += _begin(highlight.what.iri, call, ended_s, state)
        elif highlight.word == RELEASED:
            _end(found, highlight.what.iri, ended_s, calls)
    return tuple(found)


def find_targets(handlings: Sequence[Handling]) -> dict[str, tuple[float, float]]:
    """Return where the middle of each thing should be, (x, y) in m in the world, by IRI: that of its last handling."""
    last = {each.thing: each for each in handlings}
    return {thing: each.target_m for thing, each in last.items() if each.target_m is not None}


def _by_time(call: tuple[float, RecordedCall]) -> float:
    return call[0]


def _begin(thing: str, call: RecordedCall, time: float, state: WorldState) -> Iterator[Handling]:
    """Yield the handling that begins with a call, if it names an arm and a gripper."""
    arm, gripper = (
        next((each for each in call.individuals if state.is_a(each, cls)), None) for cls in (ARM_DEVICE, END_EFFECTOR)
    )
    if arm is not None and gripper is not None:
        yield Handling(thing, arm, gripper, time)


def _end(found: list[Handling], thing: str, time: float, calls: Sequence[tuple[float, RecordedCall]]) -> None:
    """Replace the last handling of a thing by the same with its end, if it has none yet."""
    number = next((i for i in reversed(range(len(found))) if found[i].thing == thing), None)
    if number is None or found[number].released_s is not None:
        return
    held = found[number]
    targets = (_target(call, held.arm) for at, call in calls if held.grasped_s < at < time)
    last = [each for each in targets if each is not None][-1:]
    found[number] = replace(held, released_s=time, target_m=last[0] if last else None)


def _target(call: RecordedCall, arm: str) -> tuple[float, float] | None:
    """Return the place (x, y) in m to which a call moves an arm; None if it does not."""
    target, moved = call.bindings.get(TARGET), call.bindings.get("arm")
    is_pose = isinstance(target, LabelledPose) and isinstance(moved, LabelledIri) and moved.iri == arm
    return target.position_m[:2] if is_pose and isinstance(target, LabelledPose) else None
