"""Pads touch in few points, which still carry what a whole face carries: pressure, tilt, and a hold at edges."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest

from skillc_ontology import catalogue

HALF = {"eraser": (0.05, 0.025), "polisher": (0.04, 0.03)}
STEP_M, PRESSED_M = 0.0005, 0.0005
STIFFNESS, DAMPING = 8000.0, 60.0


def pressed(tool: str) -> Any:
    """Return a model of a tool whose block is led by slides and hinges, over a block with its middle at an edge."""
    spec = mujoco.MjSpec.from_file(str(catalogue.model_path(f"tools/{tool}.xml")))
    spec.option.gravity, spec.option.integrator = [0.0, 0.0, 0.0], mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone, spec.option.timestep = mujoco.mjtCone.mjCONE_ELLIPTIC, 0.001
    table = spec.worldbody.add_geom(name="table", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.2, 0.2, 0.02])
    table.pos, table.contype, table.conaffinity, table.friction = [0.0, 0.0, -0.02], 1, 2, [0.5, 0.005, 0.0001]
    table.solmix = 0.0
    block, (x, y) = spec.body("block"), HALF[tool]
    levers = {"press": 1.0, "tilt_x": y * y / 3, "tilt_y": x * x / 3, "shear_x": 1.0, "shear_y": 1.0}
    for joint, lever in levers.items():
        spec.joint(joint).stiffness[0], spec.joint(joint).damping[0] = STIFFNESS * lever, DAMPING * lever
    for number, axis in enumerate(np.eye(3).tolist()):
        slide = block.add_joint(name=f"slide_{number}", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
        slide.damping[0], slide.armature = 300.0, 5.0
    for number, axis in enumerate(np.eye(2, 3).tolist()):
        hinge = block.add_joint(name=f"turn_{number}", axis=axis, pos=[0.0, 0.0, -0.015])
        hinge.damping[0], hinge.armature = 3.0, 0.05
    return spec.compile()


@pytest.mark.parametrize("tool", HALF)
@pytest.mark.parametrize("along", [0, 1])
def test_points_move_with_the_edge_under_a_pad_and_do_not_jump(tool: str, along: int) -> None:
    model = pressed(tool)
    data, points = mujoco.MjData(model), []
    for over in np.arange(0.0, 0.8 * HALF[tool][along], STEP_M):
        data.joint("slide_2").qpos = 0.015 - PRESSED_M
        data.joint(f"slide_{along}").qpos = 0.2 - HALF[tool][along] + over
        mujoco.mj_forward(model, data)
        assert data.ncon == 4
        at = data.contact.pos[:4, :2] - [data.joint("slide_0").qpos[0], data.joint("slide_1").qpos[0]]
        points.append(sorted(at.tolist(), key=lambda each: (each[along] > 0.0, each[1 - along])))
    moved = np.linalg.norm(np.diff(np.array(points), axis=0), axis=2)
    assert 0.0 < moved.max() < 4.0 * STEP_M


@pytest.mark.parametrize("tool", HALF)
def test_a_pad_yields_as_its_springs_and_tilts_as_an_elastic_foundation(tool: str) -> None:
    model, force, moment = pressed(tool), 18.0, 0.1
    data = mujoco.MjData(model)
    data.joint("slide_2").qpos = 0.015
    data.joint("slide_2").qfrc_applied, data.joint("turn_0").qfrc_applied = -force, moment
    mujoco.mj_step(model, data, 4000)
    yielded = 0.015 - float(data.joint("slide_2").qpos[0])
    assert force / STIFFNESS < yielded < force / STIFFNESS + 0.002
    springs = STIFFNESS * HALF[tool][1] ** 2 / 3
    assert float(data.joint("turn_0").qpos[0]) == pytest.approx(moment / springs, rel=0.25)
