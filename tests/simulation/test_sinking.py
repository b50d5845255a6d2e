"""A tool has sunk when it is below where it touched, wherever that was believed to be."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.insertion import UNSURE_M, SinkBelow
from skillc_runtime.primitives.primitive import SkillFailure, Status

UP = np.array([0.0, 0.0, 1.0])
DEPTH_M, PATIENCE_S, BELIEVED_M = 0.002, 10.0, 0.3


def sinking(height_m: float) -> tuple[SinkBelow, Any]:
    """Return the primitive, and an arm whose tool presses at a height."""
    arm: Any = SimpleNamespace(
        measured=SimpleNamespace(pose=Pose.of((0.1, 0.0, height_m))), take_fault=lambda: None, speed=1.0
    )
    cell: Any = SimpleNamespace(arm=lambda individual: arm, now=0.0)
    target = Pose.of((0.1, 0.0, BELIEVED_M))
    sink = SinkBelow(cell, arm="lab:Arm", target=target, along=UP, depth=DEPTH_M, patience=PATIENCE_S)
    sink.start()
    return sink, arm


@pytest.mark.parametrize("off_m", [-0.004, 0.0, 0.004])
def test_a_surface_is_where_it_is_touched(off_m: float) -> None:
    """An arm whose base is turned by .3 degrees finds a block some mm lower or higher than it is believed to be."""
    sink, arm = sinking(BELIEVED_M + off_m)
    assert sink.tick() is Status.RUNNING, "it presses on the block beside the hole"
    arm.measured.pose = Pose.of((0.1, 0.0, BELIEVED_M + off_m - 0.0015))
    assert sink.tick() is Status.RUNNING
    arm.measured.pose = Pose.of((0.1, 0.0, BELIEVED_M + off_m - 0.0021))
    assert sink.tick() is Status.SUCCESS


def test_a_tool_that_fell_in_at_once_has_sunk() -> None:
    sink, _ = sinking(BELIEVED_M - UNSURE_M - 0.005)
    assert sink.tick() is Status.SUCCESS


def test_nothing_gives_way_for_ever() -> None:
    sink, _ = sinking(BELIEVED_M - 0.004)
    sink.cell.now = PATIENCE_S + 0.1
    with pytest.raises(SkillFailure, match=r"the tool sank 0\.0 mm below the target, not 2 mm"):
        sink.tick()
