"""What an arm touches where nothing was known to be is a fact from then on, and the next plan goes around it."""

from __future__ import annotations

from math import hypot
from pathlib import Path

import pytest

from refinement.hidden_post import run_with_post
from skillc_runtime.primitives.touched_obstacles import find_explained
from skillc_runtime.recording.events import NodeEnded
from skillc_runtime.world.space.bounding_boxes import bounding_box
from skillc_runtime.world.state.changes import RemoveIndividual
from skillc_runtime.world.state.facts import PropertyFact
from skillc_runtime.world.state.terms import POSITION, SIZE, TOUCHED_OBSTACLE
from space.rooms import at, lab, thing, world

TOUCHED = lab("Touched-1")
HALF_HAND_M = 0.15
"""How far a touch of the hand may be from where its middle is, and half the post."""


@pytest.mark.parametrize(
    ("physics", "post"),
    [
        pytest.param(False, (0.35, -0.05, 0.03), marks=pytest.mark.slow),
        pytest.param(True, (0.4, -0.05, 0.02), marks=pytest.mark.sim),
    ],
)
def test_the_arm_touches_a_post_and_then_goes_around_it(
    tmp_path: Path, physics: bool, post: tuple[float, float, float]
) -> None:
    ended = run_with_post(tmp_path, *post, physics)
    assert (ended.run.end, len(ended.claims)) == ("succeeded", 2), ended.run.reason
    state = ended.world.snapshot()
    assert TOUCHED in state.instances(TOUCHED_OBSTACLE)
    height_m, x, y = post
    for each in state.instances(TOUCHED_OBSTACLE):
        box = bounding_box(state, each)
        beside_m = hypot(box.middle.position[0] - 0.5 - x, box.middle.position[1] - y)
        assert beside_m < (HALF_HAND_M if physics else 0.06)
        assert box.lowest == pytest.approx(0.6) and box.corners[:, 2].max() < 0.6 + height_m + 0.06
    measured = "sensed" if physics else "idealised"
    where = ended.world.deciding_write(PropertyFact(TOUCHED, POSITION[0]))
    large = ended.world.deciding_write(PropertyFact(TOUCHED, SIZE[0]))
    assert where is not None and (where.evidence, where.origin) == (measured, "MoveJoints")
    assert large is not None and large.evidence == "assumed"
    failures = [each.failure for each in ended.events if isinstance(each, NodeEnded) and each.failure is not None]
    assert {each.kind for each in failures} == {"space"}
    assert "nothing is known to be there" in failures[0].message


@pytest.mark.sim
def test_what_an_arm_touched_when_its_own_limit_stopped_it_is_known_to_the_next_run(tmp_path: Path) -> None:
    ended = run_with_post(tmp_path, 0.4, -0.05, 0.02, physics=True, bears_n=20.0)
    why = [each.failure.message for each in ended.events if isinstance(each, NodeEnded) and each.failure is not None]
    assert "beyond the 20 N" in why[0], "it was stopped before the motion has felt the touch"
    assert (ended.run.end, ended.claims[:2]) == ("succeeded", ["all 2 checked in space", "none"]), ended.run.reason
    where = ended.world.deciding_write(PropertyFact(TOUCHED, POSITION[0]))
    assert where is not None and (where.evidence, where.origin) == ("sensed", "MoveJoints")


def test_a_thing_that_is_found_there_was_what_was_touched() -> None:
    obstacle = thing("Touched-1", at(0.5, 0.0, 0.7), size=(0.04, 0.04, 0.2), cls=TOUCHED_OBSTACLE)
    far = thing("Touched-2", at(0.5, 0.4, 0.7), size=(0.04, 0.04, 0.2), cls=TOUCHED_OBSTACLE)
    cup = thing("Cup", at(0.55, 0.0, 0.7), size=(0.1, 0.1, 0.1))
    assert find_explained(world(obstacle, far, cup), lab("Cup")) == [RemoveIndividual(TOUCHED)]
    assert find_explained(world(obstacle, far, thing("Cup")), lab("Cup")) == []
