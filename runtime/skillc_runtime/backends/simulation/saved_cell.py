"""Saves the true state of a simulated cell, and restores it in one that was built again."""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Mapping
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.bases.base import SimulatedBase
from skillc_runtime.backends.simulation.checkpoint import Checkpoint, make_pose
from skillc_runtime.backends.simulation.hands.gripper import ModelledGripper
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.pose import Array, Pose, PoseNumbers
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose, relocation_changes
from skillc_runtime.world.state.world_state import WorldState

NOTHING = zlib.compress(b"")
"""What is saved of a surface on which there was no work."""

SAME = 1e-9
"""Poses whose numbers differ by less are equal."""


def read_scene_again(state: WorldState, checkpoint: Checkpoint | None) -> SceneSpec:
    """Read what a simulation needs, with all things where a checkpoint has their places, None for no checkpoint.

    So the differences between reality and facts are those of the first cell, whatever was learnt since. SheetError or
    FrameError if a fact is missing.
    """
    if checkpoint is not None:
        for thing, numbers in checkpoint.places.items():
            place = make_pose(numbers)
            if thing in state.individuals and not _is_at(state, thing, place):
                state = state.with_changes(relocation_changes(state, thing, place))
    return read_scene_spec(state)


def save_cell(
    scene: SceneSpec,
    model: Any,
    data: Any,
    bases: Mapping[str, SimulatedBase],
    grippers: Mapping[str, ModelledGripper],
    coverage: Mapping[str, CoverageMap],
) -> Checkpoint:
    """Return the true state of a cell from its parts, which are by IRI."""
    doses = {surface: each.dose for surface, each in coverage.items() if each.dose.any()}
    return Checkpoint(
        places=_list_places(scene),
        joints={name: tuple(data.qpos[span].tolist()) for name, span in _list_joints(model)},
        bases={robot: each.pose.numbers for robot, each in bases.items()},
        grippers={gripper: each.save() for gripper, each in grippers.items()},
        time_s=float(data.time),
        worked={surface: zlib.compress(dose.astype("<f4").tobytes(), 1) for surface, dose in doses.items()},
        clean={name: zlib.compress(each.clean.tobytes(), 1) for name, each in coverage.items() if each.clean.any()},
    )


def restore_cell(
    saved: Checkpoint,
    model: Any,
    data: Any,
    bases: Mapping[str, SimulatedBase],
    grippers: Mapping[str, ModelledGripper],
    coverage: Mapping[str, CoverageMap],
) -> None:
    """Put bases and joints where they were, and let grippers hold what they held; what is new stays as it is."""
    for robot in sorted(saved.bases.keys() & bases.keys()):
        bases[robot].place(make_pose(saved.bases[robot]))
    for name, span in _list_joints(model):
        if len(coordinates := saved.joints.get(name, ())) == span.stop - span.start:
            data.qpos[span] = coordinates
    mujoco.mj_fwdPosition(model, data)
    for gripper in sorted(saved.grippers.keys() & grippers.keys()):
        grippers[gripper].restore(saved.grippers[gripper])
    _restore_work(coverage, saved)


def _list_places(scene: SceneSpec) -> dict[str, PoseNumbers]:
    """Return where all things of a scene are believed to be, what carries others before that."""
    fixed = sorted((each for each in scene.bodies if not each.movable), key=lambda each: each.slide is not None)
    kinds = (scene.bases, fixed, scene.fixtures, scene.surfaces, scene.movable, scene.tools)
    things = {each.individual: each.pose.numbers for kind in kinds for each in kind}
    return things | {each.individual: each.base.numbers for each in scene.arms}


def read_posture(saved: Checkpoint | None, arm: str, start: Array) -> Array:
    """Return the posture (nv,) in rad of the arm of a short name; `start` if it had other joints, or none."""
    joints = saved.joints if saved is not None else {}
    found = [each for name, values in joints.items() if name.startswith(part_name(arm, "")) for each in values]
    return np.array(found) if len(found) == start.size else start


def _restore_work(coverage: Mapping[str, CoverageMap], saved: Checkpoint) -> None:
    """Set where and how long tools have worked on the surfaces that have the same size as those that were saved.

    What has been learnt since of how clean they are is nothing that they have been before.
    """
    for surface, each in coverage.items():
        dose, clean = (
            np.frombuffer(zlib.decompress(named.get(surface, NOTHING)), kind)
            for named, kind in ((saved.worked, "<f4"), (saved.clean, "?"))
        )
        if surface in saved.places:
            each.clean[:] = clean.reshape(each.clean.shape) if clean.size == each.clean.size else False
        if dose.size == each.dose.size:
            each.dose[:] = dose.reshape(each.dose.shape)


def _is_at(state: WorldState, thing: str, place: Pose) -> bool:
    try:
        here = pose(state, thing)
    except FrameError:
        return False
    return bool(
        np.allclose(here.position, place.position, 0.0, SAME) and np.allclose(here.rotation, place.rotation, 0.0, SAME)
    )


def _list_joints(model: Any) -> Iterator[tuple[str, slice]]:
    """Yield each joint: its name, or its number within its body, and where its coordinates are."""
    ends = [*model.jnt_qposadr[1:].tolist(), int(model.nq)]
    for number, end in zip(range(model.njnt), ends, strict=False):
        joint = model.joint(number)
        body = model.body(int(joint.bodyid[0]))
        yield joint.name or f"{body.name}#{number - int(body.jntadr[0])}", slice(int(joint.qposadr[0]), end)
