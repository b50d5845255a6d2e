"""Ways around boxes: every one is free when looked at closely, begins and ends where it shall, within all limits."""

from __future__ import annotations

import os
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from collision.around import aside, box, contacts, home, pillar, posture
from collision.test_contacts import least_distance
from simulation.cells import SCENES
from skillc_runtime.collision import path_planning as ways
from skillc_runtime.collision.collision_checker import SLACK_M, CollisionChecker
from skillc_runtime.collision.path_planning import NoPath, find_motion_collision, plan_joint_path
from skillc_runtime.motion.paths.joint_path import joint_path
from skillc_runtime.motion.pose import Array

EXAMPLES = int(os.environ.get("SKILLC_WAYS", "6"))
"""How many random cells are tried by default; each may be searched for a second."""

UPRIGHT = [0.7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]

places = st.tuples(st.floats(0.25, 0.6), st.floats(-2.0, 2.0), st.floats(0.7, 1.3))


def finely(postures: list[Array], step: float = 0.005) -> list[Array]:
    """Postures along straight pieces, no joint farther than `step` rad from one to the next."""
    found = [postures[0]]
    for one, other in pairwise(postures):
        count = max(1, int(np.ceil(np.abs(other - one).max() / step)))
        found += [one + (other - one) * (index / count) for index in range(1, count + 1)]
    return found


def is_free(of: CollisionChecker, start: Array, found: tuple[Array, ...]) -> None:
    """Check that nothing is touched and, blended, no limit of the joints is broken, by other means than the search."""
    postures = [start, *found]
    assert min(least_distance(of, q) for q in finely(postures)[::4]) > 0.0
    assert all(of.find_collision(q) is None or of.find_collision(q).distance_m > 0.0 for q in finely(postures))
    speed = np.full(len(start), 0.5)
    motion = joint_path(postures, speed, speed / 0.5, [0.0] * (len(postures) - 2))
    touch = find_motion_collision(of, motion)
    nearest = min(of.model.margin, least_distance(of, start), least_distance(of, found[-1]))
    assert touch is None or touch.distance_m > nearest - of.model.margin / 2 - SLACK_M
    samples = [motion.at(time) for time in np.linspace(0.0, motion.duration, 200).tolist()]
    assert all(
        (np.abs(now.dq) <= speed + 1e-9).all() and (np.abs(now.ddq) <= 2 * speed + 1e-9).all() for now in samples
    )
    assert (motion.at(0.0).q == start).all() and np.allclose(motion.at(motion.duration).q, found[-1], atol=1e-9)


@pytest.mark.parametrize("scene", SCENES)
@settings(max_examples=EXAMPLES, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much])
@given(where=places, turn=st.floats(-1.6, 1.6))
def test_whatever_way_is_found_is_free(scene: str, where: tuple[float, float, float], turn: float) -> None:
    radius, angle, height = where
    of, known = contacts(
        scene, box("Box-1", (radius * np.cos(angle), radius * np.sin(angle), height), (0.1, 0.14, 0.9))
    )
    start, goal = home(scene), aside(scene, turn)
    assume(least_distance(of, start) > 0.03)
    try:
        found = plan_joint_path(of, start, [goal], known)
    except NoPath as why:
        assert "lab:" in str(why)
        return
    assert (found[-1] == goal).all()
    is_free(of, start, found)


@pytest.mark.parametrize("scene", SCENES)
def test_a_way_around_is_found_the_same_each_time(scene: str) -> None:
    (of, known), start, goal = contacts(scene, pillar(scene)), home(scene), aside(scene)
    found = plan_joint_path(of, start, [goal], known)
    assert len(found) > 1
    is_free(of, start, found)
    again = plan_joint_path(contacts(scene, pillar(scene))[0], start, [goal], known)
    assert len(again) == len(found)
    assert all((one == other).all() for one, other in zip(found, again, strict=True))


def test_without_search_it_goes_over_a_posture_that_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ways, "SEARCHES", ())
    changes = [*pillar("iiwa_table"), *posture("iiwa_table", "upright", UPRIGHT)]
    of, known = contacts("iiwa_table", changes)
    found = plan_joint_path(of, home("iiwa_table"), [aside("iiwa_table")], known)
    assert [q.tolist() for q in found] == [UPRIGHT, aside("iiwa_table").tolist()]
    is_free(of, home("iiwa_table"), found)


def test_where_nothing_is_in_the_way_it_goes_straight() -> None:
    of, known = contacts("iiwa_table", [])
    assert [q.tolist() for q in plan_joint_path(of, home("iiwa_table"), [aside("iiwa_table")], known)] == [
        aside("iiwa_table").tolist()
    ]


def test_a_goal_that_touches_is_told_and_another_one_taken() -> None:
    of, known = contacts("iiwa_table", pillar("iiwa_table"))
    into, beside = aside("iiwa_table", 0.65), aside("iiwa_table", -0.3)
    with pytest.raises(NoPath, match=r"where it shall go lab:.* would touch lab:Pillar"):
        plan_joint_path(of, home("iiwa_table"), [into], known)
    assert plan_joint_path(of, home("iiwa_table"), [into, beside], known) == (beside,)


def test_a_search_ends_after_so_many_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ways, "SEARCHES", ())
    of, known = contacts("ur5e_whiteboard", pillar("ur5e_whiteboard"))
    with pytest.raises(
        NoPath, match=r"straight way lab:\S+.* would touch lab:Pillar; no way around was found in \d+ looks"
    ):
        plan_joint_path(of, home("ur5e_whiteboard"), [aside("ur5e_whiteboard")], known)
    assert of.checks < 2000
