"""What is far from everything is left out of the search for contacts, which finds the same all the same."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from cells import HANDS, at_the_eraser, cell, grasp, lift, reach_for_eraser

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.mujoco.contact_pairs import find_pairs
from skillc_runtime.backends.mujoco.far_bodies import FarBodies, find_gap, make_far_bodies, measure_way
from skillc_runtime.motion.numerics.compiled import COMPILES
from skillc_runtime.motion.pose import Array

pytestmark = pytest.mark.skipif(not COMPILES, reason="without compiled functions nothing is left out")

SLIDING = """
<mujoco>
  <worldbody>
    <geom type="plane" size="1 1 .1"/>
    <body pos="0 0 .5">
      <joint type="slide" axis="0 0 1" {limits}/>
      <geom type="sphere" size=".1" mass="1"/>
      <body pos=".5 0 0"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .3 0 0" size=".02" mass="1"/></body>
    </body>
    <body pos="2 0 .3"><freejoint/><geom type="box" size=".2 .1 .05" mass="1"/></body>
  </worldbody>
</mujoco>
"""


def contacts(model: mujoco.MjModel, data: mujoco.MjData) -> list[list[int]]:
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)
    found: list[list[int]] = data.contact.geom[: data.ncon].tolist()
    return found


def moved(model: mujoco.MjModel, qpos: Array, rng: np.random.Generator, way: float) -> Array:
    """Return coordinates near others: about as many rad and m away."""
    there = qpos.copy()
    mujoco.mj_integratePos(model, there, rng.normal(0.0, way, model.nv), 1.0)
    return there


def check_from(far: FarBodies, model: mujoco.MjModel, data: mujoco.MjData, rng: np.random.Generator) -> tuple[int, int]:
    """Look, and move from there; return how often something was left out, and contacts."""
    far.renew()
    far.leave_out(0.0)
    contacts(model, data)
    far.take_in(0.0)
    start, pos, left_out, found = data.qpos.copy(), data.mocap_pos.copy(), 0, 0
    for _ in range(10):
        data.qpos[:] = moved(model, start, rng, 10.0 ** rng.uniform(-4.0, -1.5))
        data.mocap_pos[:] = pos + rng.normal(0.0, 0.005, pos.shape)
        every = model.body_contype.copy()
        expected = contacts(model, data)
        far.leave_out(0.0)
        left_out += not np.array_equal(model.body_contype, every)
        assert contacts(model, data) == expected
        far.take_in(0.0)
        assert np.array_equal(model.body_contype, every), "only while it is searched"
        found += len(expected)
    data.mocap_pos[:] = pos
    return left_out, found


@pytest.mark.parametrize("scene", HANDS)
def test_the_same_contacts_are_found_wherever_joints_and_bases_move(scene: str) -> None:
    there, rng = cell(scene), np.random.default_rng(1)
    model, data = there.model, mujoco.MjData(there.model)
    far, hinges = FarBodies(model, data), model.jnt_type == mujoco.mjtJoint.mjJNT_HINGE
    left_out, found = 0, 0
    for _ in range(100):
        data.qpos[:] = there.data.qpos
        data.qpos[model.jnt_qposadr[hinges]] = rng.uniform(*np.clip(model.jnt_range[hinges], -np.pi, np.pi).T)
        one, more = check_from(far, model, data, rng)
        left_out, found = left_out + one, found + more
    assert left_out > 100
    assert found > 100


@pytest.mark.parametrize("limits", ["", 'range="-.3 .3" limited="true"'])
def test_slides_and_free_bodies_do_not_escape(limits: str) -> None:
    model, rng = mujoco.MjModel.from_xml_string(SLIDING.format(limits=limits)), np.random.default_rng(2)
    data, left_out, found = mujoco.MjData(model), 0, 0
    far = FarBodies(model, data)
    for _ in range(200):
        data.qpos[:2] = rng.uniform(-0.4, 0.3), rng.uniform(-np.pi, np.pi)
        data.qpos[2:5] = rng.uniform((-0.5, -0.1, 0.1), (2.0, 0.1, 0.5))
        data.qpos[5:] = rng.normal(size=4)
        data.qpos[5:] /= np.linalg.norm(data.qpos[5:])
        one, more = check_from(far, model, data, rng)
        left_out, found = left_out + one, found + more
    assert left_out > 100
    assert found > 100


@pytest.mark.parametrize("name", ["iiwa_table", "slides"])
def test_distances_are_bounded_and_change_by_no_more_than_what_moves_things(name: str) -> None:
    model = cell(name).model if name != "slides" else mujoco.MjModel.from_xml_string(SLIDING.format(limits=""))
    data, rng, shares, bounds = mujoco.MjData(model), np.random.default_rng(3), [], 0
    far = FarBodies(model, data)
    pairs = [row for row in far.clearances.pairs.astype(int).tolist() if not row[5]]

    def measure() -> Array:
        return np.array([mujoco.mj_geomDistance(model, data, one, other, 10.0, None) for one, other, *_ in pairs])

    for _ in range(20):
        data.qpos[:] = moved(model, model.qpos0, rng, 0.5)
        far.renew()
        contacts(model, data)
        far.take_in(0.0)
        before, gaps = measure(), np.array([find_gap(far.clearances, one, other) for one, other, *_ in pairs])
        assert (before[gaps > 0.0] > gaps[gaps > 0.0] - 1e-6).all()
        bounds += (gaps > 0.0).sum()
        for _ in range(10):
            data.qpos[:] = moved(model, far.clearances.ways.last_qpos, rng, 0.05)
            contacts(model, data)
            change, way = np.abs(measure() - before)[before > 0.0].max(), measure_way(far.clearances.ways)
            assert change < way
            shares.append(change / way)
    assert bounds > 20
    assert max(shares) > 0.1, "a bound that is worth something"


def test_what_mujoco_never_compares_is_no_pair() -> None:
    model = cell("iiwa_table").model
    pairs = {frozenset(pair) for pair in find_pairs(model)[:, :2].astype(int).tolist()}
    links = [
        geom for geom in range(model.ngeom) if model.body(model.geom_bodyid[geom]).name.endswith(("link1", "base"))
    ]
    assert not any(frozenset((one, other)) in pairs for one in links for other in links)
    assert len(pairs) > 100


def test_levers_that_are_not_known_leave_nothing_out() -> None:
    ball = '<mujoco><worldbody><body><joint type="ball"/><geom size=".1"/></body></worldbody></mujoco>'
    model = mujoco.MjModel.from_xml_string(ball)
    assert make_far_bodies(model, mujoco.MjData(model)) is None


@pytest.mark.parametrize("scene", HANDS)
def test_a_grasp_is_the_same_to_the_last_bit(scene: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with_all = grasped(scene, monkeypatch, leaves_out=False)
    fewer = grasped(scene, monkeypatch, leaves_out=True)
    assert fewer.physics.far is not None
    assert with_all.physics.far is None
    for name in ("qpos", "qvel", "qacc", "sensordata", "xpos"):
        assert np.array_equal(getattr(fewer.data, name), getattr(with_all.data, name)), name


def grasped(scene: str, monkeypatch: pytest.MonkeyPatch, leaves_out: bool) -> SimulatedCell:
    if not leaves_out:
        monkeypatch.setattr("skillc_runtime.backends.mujoco.physics.make_far_bodies", lambda model, data: None)
    there = at_the_eraser(scene)
    reach_for_eraser(there, scene)
    grasp(there, scene)
    lift(there, scene)
    monkeypatch.undo()
    return there
