"""Fixtures in the simulation: their models where they really stand."""

from __future__ import annotations

from typing import Any

import mujoco

from skillc_runtime.backends.mujoco.fixture_spec import FixtureSpec
from skillc_runtime.backends.mujoco.fixture_variation import FixtureVariation
from skillc_runtime.backends.mujoco.names import part_name
from skillc_runtime.motion.pose import quaternion_from_rotation

BLOCKAGE = "blockage"
"""The geom of a model that gets in the way of its use; it is left out unless that is wanted."""


def add_fixture(spec: Any, name: str, fixture: FixtureSpec, true: FixtureVariation) -> None:
    """Attach the model of a fixture to the world as it really is; one that is missing is seen and touched by nobody."""
    model, pose = mujoco.MjSpec.from_file(str(fixture.model)), true.true_pose(fixture.pose)
    blockage = model.geom(BLOCKAGE)
    if blockage is not None and not true.blocked:
        model.delete(blockage)
    for geom in model.geoms:
        _rub(geom, true.friction)
        if not true.present:
            _vanish(geom)
    for joint in model.joints:
        joint.stiffness[0] *= 1.0 + true.stiffness_share
    frame = spec.worldbody.add_frame(pos=pose.position, quat=quaternion_from_rotation(pose.rotation))
    spec.attach(model, prefix=part_name(name, ""), frame=frame)


def _rub(geom: Any, friction: float | None) -> None:
    if friction is not None:
        geom.friction[0] = friction


def _vanish(geom: Any) -> None:
    geom.contype = geom.conaffinity = 0
    geom.rgba = [0.0, 0.0, 0.0, 0.0]
