"""Limits of devices that are facts, against which arguments are checked before anything moves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Literal

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.primitives.place_description import describe_place
from skillc_runtime.world.space.frames import moves_with, pose, size
from skillc_runtime.world.space.shared_cell import find_shared_limit
from skillc_runtime.world.state.data_sheet import sheet_of
from skillc_runtime.world.state.terms import HAS_ARM, HAS_WORKSPACE, MOBILE_ROBOT

if TYPE_CHECKING:
    from skillc_runtime.world.state.values import Value
    from skillc_runtime.world.state.world_state import WorldState
if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


def distance_outside_workspace(state: WorldState, arm: str, point: Array) -> float:
    """Return how far a point (3,) m in the world is outside the workspace of an arm, in m; 0 inside or without one.

    A workspace moves with the base of its arm. Of a mobile robot it is known only if its frame moves with the robot;
    0 otherwise. FrameError when a pose is not known.
    """
    space = min(state.objects(arm, HAS_WORKSPACE), default=None)
    if space is None or any(
        state.is_a(robot, MOBILE_ROBOT) and not moves_with(state, space, robot)
        for robot in state.subjects(HAS_ARM, arm)
    ):
        return 0.0
    pose(state, arm)
    local = pose(state, space).inverse().apply(point)
    return float(np.linalg.norm(np.maximum(np.abs(local) - size(state, space) / 2, 0.0)))


CORRECTION_M = 0.05
"""How far things may be from where the world model has them until they are sensed."""


def find_excess(
    arguments: Mapping[str, Value], parameter: str, unit: str, limit: tuple[str, str], state: WorldState
) -> str | None:
    """Return by how much a number exceeds a limit of a device, if both are known.

    `limit` is the parameter of the device and the name of the number in its data sheet. SheetError if it has none.
    """
    value, device = arguments.get(parameter), arguments.get(limit[0])
    if not isinstance(value, float) or not isinstance(device, str):
        return None
    greatest = sheet_of(state, device).number(limit[1])
    if value <= greatest:
        return None
    return f"`{parameter}` is {value:g} {unit}, more than the {greatest:g} {unit} that {_short(state, device)} allows"


def find_unshareable(
    arguments: Mapping[str, Value], parameter: str, limit: Literal["force", "speed"], state: WorldState
) -> str | None:
    """Return by how much a force or a speed exceeds what people bear whom the arm may meet; None without any."""
    value, arm = arguments.get(parameter), arguments.get("arm")
    if not isinstance(value, float) or not isinstance(arm, str):
        return None
    shared = find_shared_limit(state, arm)
    greatest, unit, region = (
        (shared.force_n, "N", shared.weakest) if limit == "force" else (shared.speed_m_s, "m/s", shared.slowest)
    )
    if value <= greatest:
        return None
    return (
        f"`{parameter}` is {value:g} {unit}, more than the {greatest:.3g} {unit} that {_short(state, region)} bears, "
        f"which {_short(state, arm)} may meet"
    )


def find_place_outside(
    arguments: Mapping[str, Value], parameters: tuple[str, ...], arm: str, state: WorldState
) -> str | None:
    """Return which pose or path of the tool is outside the workspace of its arm, and where it is farthest outside.

    Only what lies farther outside than things may be from where they are believed. FrameError if a pose is not known.
    """
    device = arguments.get(arm)
    if not isinstance(device, str):
        return None
    places = [(name, place.position) for name in parameters for place in _poses(arguments.get(name))]
    far = [distance_outside_workspace(state, device, position) for _, position in places]
    farthest = max(range(len(far)), key=lambda number: far[number], default=0)
    if not far or far[farthest] <= CORRECTION_M:
        return None
    name, position = places[farthest]
    where, short = describe_place(state, position), _short(state, device)
    return f"`{name}` is up to {1e3 * far[farthest]:.0f} mm outside the workspace of {short}, at {where}"


def _poses(value: Value | None) -> Iterator[Pose]:
    """Yield the poses in a value."""
    if isinstance(value, Pose):
        yield value
    elif isinstance(value, tuple):
        for each in value:
            yield from _poses(each)


def _short(state: WorldState, individual: str) -> str:
    return state.vocabulary.short(individual)
