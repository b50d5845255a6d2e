"""The shipped arm models have the kinematics and inertia that pinocchio reads from the same files."""

from pathlib import Path

import mujoco
import numpy as np
import pinocchio
import pytest

import skillc_ontology

ROBOTS = Path(skillc_ontology.__file__).parent / "robots"
TOTAL_MASS_KG = {"ur5e": 21.7, "iiwa14": 30.61, "panda": 16.691901}
REACH_AT_ZERO_M = {"ur5e": (0.8172, 0.2329, 0.0628), "iiwa14": (0.0, 0.0, 1.306), "panda": (0.088, 0.0, 0.926)}


@pytest.mark.parametrize("robot", TOTAL_MASS_KG)
def test_flange_mass_matrix_and_gravity_agree_with_pinocchio(robot: str) -> None:
    path = str(ROBOTS / f"{robot}.xml")
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    other = pinocchio.buildModelFromMJCF(path)
    other_data = other.createData()
    flange = other.getFrameId("flange")
    for q in np.random.default_rng(1).uniform(-2.0, 2.0, (20, model.nv)):
        data.qpos[:] = q
        mujoco.mj_forward(model, data)
        pinocchio.framesForwardKinematics(other, other_data, q)
        mass = np.triu(pinocchio.crba(other, other_data, q))
        expected = mass + np.triu(mass, 1).T
        ours = np.empty((model.nv, model.nv))
        mujoco.mj_fullM(model, data, ours)
        np.testing.assert_allclose(data.site("flange").xpos, other_data.oMf[flange].translation, atol=1e-12)
        np.testing.assert_allclose(data.site("flange").xmat.reshape(3, 3), other_data.oMf[flange].rotation, atol=1e-12)
        np.testing.assert_allclose(ours, expected, atol=1e-12)
        gravity = pinocchio.computeGeneralizedGravity(other, other_data, q)
        np.testing.assert_allclose(data.qfrc_bias, gravity, atol=1e-10)


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
