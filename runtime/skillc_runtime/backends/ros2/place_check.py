"""Compares where the facts have the bases of arms with where ROS 2 has them (tf)."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec
from math import degrees
from time import sleep

import numpy as np

from skillc_runtime.backends.ros2.facts import LINKED
from skillc_runtime.backends.ros2.receiver import Receiver
from skillc_runtime.backends.ros2.transforms import Transforms
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.pose import log
from skillc_runtime.world.space.frame_tree import WORLD_FRAME
from skillc_runtime.world.state.world_state import WorldState

LOOK_S = 2.0
NEAR_M, NEAR_RAD = 0.02, 0.03


def check_places(state: WorldState, scene: SceneSpec) -> Iterator[str]:
    """Yield a sentence for each arm whose base tf has elsewhere; nothing where there is no tf of it."""
    frames = {each.individual: str(frame) for each in scene.arms if (frame := state.value(each.individual, LINKED))}
    if not frames or find_spec("tf2_msgs") is None:
        return
    receiver = Receiver("skillc_check_frames")
    try:
        transforms = Transforms(receiver)
        receiver.begin()
        sleep(LOOK_S)
        with receiver.lock:  # wait ends: with the messages that have arrived
            found = {arm: transforms.find(frame, WORLD_FRAME) for arm, frame in frames.items()}
    finally:
        receiver.close()
    for arm in scene.arms:
        if (transform := found.get(arm.individual)) is None:
            continue
        away = float(np.linalg.norm(transform.pose.position - arm.base.position))
        turned = float(np.linalg.norm(log(transform.pose.rotation @ arm.base.rotation.T)))
        if away > NEAR_M or turned > NEAR_RAD:
            yield (
                f"{scene.names[arm.individual]}: tf has {frames[arm.individual]} {away:.2f} m and "
                f"{degrees(turned):.0f} deg from where the facts have the base of the arm"
            )
