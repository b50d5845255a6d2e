"""The shipped arm models have the kinematics and inertia that pinocchio reads from the same files."""

import re
from itertools import product
from pathlib import Path

import mujoco
import numpy as np
import pinocchio
import pytest

import skillc_ontology

ROBOTS = Path(skillc_ontology.__file__).parent / "robots"
GRIPPERS = ROBOTS.parent / "grippers"
TOTAL_MASS_KG = {"ur5e": 21.7, "iiwa14": 30.61, "panda": 16.691901, "fr3": 17.891401}
POSTURES = 200
REACH_AT_ZERO_M = {
    "ur5e": (0.8172, 0.2329, 0.0628),
    "iiwa14": (0.0, 0.0, 1.306),
    "panda": (0.088, 0.0, 0.926),
    "fr3": (0.088, 0.0, 0.926),
}


@pytest.mark.parametrize("robot", TOTAL_MASS_KG)
def test_flange_jacobian_mass_matrix_and_gravity_agree_with_pinocchio(robot: str) -> None:
    path = str(ROBOTS / f"{robot}.xml")
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    other = pinocchio.buildModelFromMJCF(path)
    other_data = other.createData()
    flange, site = other.getFrameId("flange"), model.site("flange").id
    ours, jacobian = np.empty((model.nv, model.nv)), np.empty((6, model.nv))
    postures = np.random.default_rng(1).uniform(*model.jnt_range.T, (POSTURES, model.nv))
    assert len(postures) == POSTURES
    for q in postures:
        data.qpos[:] = q
        mujoco.mj_forward(model, data)
        pinocchio.framesForwardKinematics(other, other_data, q)
        np.testing.assert_allclose(data.site("flange").xpos, other_data.oMf[flange].translation, atol=1e-12)
        np.testing.assert_allclose(data.site("flange").xmat.reshape(3, 3), other_data.oMf[flange].rotation, atol=1e-12)
        mujoco.mj_jacSite(model, data, jacobian[:3], jacobian[3:], site)
        theirs = pinocchio.computeFrameJacobian(other, other_data, q, flange, pinocchio.LOCAL_WORLD_ALIGNED)
        np.testing.assert_allclose(jacobian, theirs, atol=1e-12)
        mass = np.triu(pinocchio.crba(other, other_data, q))
        mujoco.mj_fullM(model, data, ours)
        np.testing.assert_allclose(ours, mass + np.triu(mass, 1).T, atol=1e-12)
        gravity = pinocchio.computeGeneralizedGravity(other, other_data, q)
        np.testing.assert_allclose(data.qfrc_bias, gravity, atol=1e-10)


@pytest.mark.parametrize("robot", TOTAL_MASS_KG)
def test_the_first_body_is_where_the_world_is(robot: str) -> None:
    """pinocchio 4.1 drops the pose of a first body without joint: one elsewhere would be compared wrongly."""
    model = mujoco.MjModel.from_xml_path(str(ROBOTS / f"{robot}.xml"))
    np.testing.assert_array_equal(model.body_pos[1], 0.0)
    np.testing.assert_array_equal(model.body_quat[1], (1.0, 0.0, 0.0, 0.0))


@pytest.mark.parametrize("robot", TOTAL_MASS_KG)
def test_mass_and_reach_are_those_of_the_sources(robot: str) -> None:
    model = mujoco.MjModel.from_xml_path(str(ROBOTS / f"{robot}.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert model.body_mass.sum() == pytest.approx(TOTAL_MASS_KG[robot])
    np.testing.assert_allclose(data.site("flange").xpos, REACH_AT_ZERO_M[robot], atol=1e-4)


@pytest.mark.parametrize("robot", TOTAL_MASS_KG)
def test_an_arm_has_one_actuator_a_joint_in_order_and_touches_nothing(robot: str) -> None:
    model = mujoco.MjModel.from_xml_path(str(ROBOTS / f"{robot}.xml"))
    assert model.nu == model.nv == model.njnt
    assert [int(j) for j in model.actuator_trnid[:, 0]] == list(range(model.njnt))
    assert not model.geom_contype.any()
    assert not model.geom_conaffinity.any()


@pytest.mark.parametrize("robot", TOTAL_MASS_KG)
def test_each_link_touches_the_one_that_it_turns_on(robot: str) -> None:
    """Pictures and collision checks show the shapes: a gap at a joint is neither seen on the real arm nor safe."""
    model = mujoco.MjModel.from_xml_path(str(ROBOTS / f"{robot}.xml"))
    data = mujoco.MjData(model)
    shapes = {body: np.flatnonzero(model.geom_bodyid == body) for body in range(1, model.nbody)}
    joined = [(body, int(model.body_parentid[body])) for body in shapes if model.body_jntnum[body]]
    assert len(joined) == model.nv
    for q in np.random.default_rng(4).uniform(*model.jnt_range.T, (20, model.nv)):
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        for body, above in joined:
            pairs = product(shapes[body], shapes[above])
            nearest = min(mujoco.mj_geomDistance(model, data, one, other, 1.0, None) for one, other in pairs)
            assert nearest < 0, f"{model.body(body).name} is {1000 * nearest:.0f} mm from {model.body(above).name}"


@pytest.mark.parametrize("gripper", sorted(each.stem for each in GRIPPERS.glob("*.xml")))
def test_the_sheets_of_hands_state_how_far_their_tool_centre_points_are_from_the_flange(gripper: str) -> None:
    model = mujoco.MjModel.from_xml_path(str(GRIPPERS / f"{gripper}.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    (stated,) = re.findall(r"skillc:handLength ([0-9.]+)", (GRIPPERS / f"{gripper}.ttl").read_text())
    assert data.site("tcp").xpos[2] == pytest.approx(float(stated))
