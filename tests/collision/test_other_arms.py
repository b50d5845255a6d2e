"""Another arm is an obstacle as it stands, and two ways meet if and only if arms come close on them."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from collision.around import OWN
from simulation.cells import ARM, SCENES, world
from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.arm_parts import NOTHING, ArmParts
from skillc_runtime.collision.collision_checker import CollisionChecker
from skillc_runtime.collision.collision_model import MOVES, build_collision_model
from skillc_runtime.collision.swept_space import CUBE_M, SweptSpace, sweep_space
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.world.state.data_sheet import sheet_of
from skillc_runtime.world.state.terms import HAS_GRIPPER


def read_arm(scene: str):
    state, arm = world(scene), ARM[scene]
    openings = dict.fromkeys(state.objects(arm, HAS_GRIPPER), 0.05)
    return read_arm_assembly(state, arm, openings), sheet_of(state, arm).posture("home")


def turned(yaw_deg: float, x: float, y: float = 0.0) -> Pose:
    return Pose(np.array([x, y, 0.0]), exp(np.array([0.0, 0.0, np.deg2rad(yaw_deg)])))


@pytest.mark.parametrize("scene", SCENES)
def test_the_parts_of_another_arm_stand_where_its_links_are(scene: str) -> None:
    """In a model with the arm's parts as obstacles where the arm is, each lies on the geom that it stands for."""
    assembly, home = read_arm(scene)
    q = home + 0.3
    parts = tuple(ArmParts(assembly).list_obstacles(q, turned(0.0, 0.0)))
    model = build_collision_model(assembly, NOTHING.with_blocks(parts))
    data = mujoco.MjData(model.compiled)
    data.qpos[: model.joints], data.qpos[model.joints :] = q, model.fingers
    mujoco.mj_kinematics(model.compiled, data)
    moving = np.flatnonzero(model.compiled.geom_contype == MOVES)
    blocks = [model.compiled.geom(f"block/{number}").id for number in range(len(parts))]
    assert len(moving) == len(blocks) > 10
    assert [model.names[each] for each in blocks] == [model.names[each] for each in moving]
    assert np.abs(data.geom_xpos[blocks] - data.geom_xpos[moving]).max() < 1e-5
    assert np.abs(data.geom_xmat[blocks] - data.geom_xmat[moving]).max() < 1e-5
    assert np.allclose(model.compiled.geom_rbound[blocks], model.compiled.geom_rbound[moving], atol=1e-6)


def test_an_arm_does_not_go_where_another_one_stands() -> None:
    assembly, home = read_arm("iiwa_table")
    for x, free in ((1.0, False), (2.5, True)):
        other = tuple(ArmParts(assembly).list_obstacles(home, turned(180.0, x)))
        contacts = CollisionChecker(build_collision_model(assembly, NOTHING.with_blocks(other)), home)
        touch = contacts.find_collision(home)
        assert (touch is None) == free
        if touch is not None:
            assert touch.one.startswith(OWN) and touch.other.startswith(OWN)


def boxes(middles: Array, half: Array, rotation: Array) -> SweptSpace:
    return SweptSpace(middles, np.broadcast_to(rotation, (len(middles), 3, 3)), np.tile(half, (len(middles), 1)))


def test_what_comes_near_meets_and_what_is_far_does_not() -> None:
    rng, met = np.random.default_rng(3), 0
    for _ in range(60):
        sides, places = rng.uniform(0.02, 0.12, (2, 3)), rng.uniform(-0.25, 0.25, (2, 3))
        turns = [exp(rng.uniform(-2.0, 2.0, 3)) for _ in range(2)]
        one, other = (boxes(places[[k]], sides[k], turns[k]) for k in range(2))
        inside = [places[k] + (rng.uniform(-1.0, 1.0, (400, 3)) * sides[k]) @ turns[k].T for k in range(2)]
        far = np.linalg.norm(inside[0][:, None] - inside[1], axis=-1).min()
        if far < CUBE_M:
            met += 1
            assert one.meets(other) and other.meets(one)
        elif far > 3.5 * CUBE_M:
            assert not one.meets(other)
    assert 10 < met < 55


def test_ways_of_two_arms_meet_only_between_them() -> None:
    assembly, home = read_arm("iiwa_table")
    aside = home.copy()
    aside[0] += 1.2
    way = sweep_space(assembly, turned(0.0, 0.0), (home, aside))
    assert not way.meets(sweep_space(assembly, turned(180.0, 2.6), (home, aside)))
    assert way.meets(sweep_space(assembly, turned(180.0, 1.0), (home, aside)))
