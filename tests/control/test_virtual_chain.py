"""The virtual arm as numbers moves as MuJoCo computes it, with turning and sliding joints and any tool."""

from __future__ import annotations

import numpy as np
import pytest
from rig import ROBOTS, moved_by

from skillc_runtime.control.laws.virtual_arm import VirtualArm, load_virtual_model
from skillc_runtime.control.laws.virtual_chain import compute_virtual

SLIDING = """<mujoco><worldbody><body pos=".1 .2 .3" quat=".9 .1 .3 0">
  <joint type="slide" axis="1 0 1"/><body pos="0 .1 .2"><joint axis="0 1 1" pos=".02 0 .1" ref=".3"/>
    <body quat=".7 .7 0 0"><body pos=".1 0 0"><joint axis="1 0 0"/><joint type="slide" axis="0 1 0" pos="0 .3 0"/>
      <site name="flange" pos="0 .1 .1" quat=".5 .5 .1 .5"/></body></body></body></body></worldbody></mujoco>"""


@pytest.mark.parametrize("arm", ["iiwa14", "ur5e", "panda", "sliding"])
def test_it_moves_as_the_physics_computes(arm: str, tmp_path) -> None:
    path = ROBOTS / f"{arm}.xml"
    if arm == "sliding":
        path = tmp_path / "sliding.xml"
        path.write_text(
            SLIDING.replace("<joint ", '<joint armature="0" ').replace(
                "</body></body></body></body>", '<geom size=".01"/></body></body></body></body>'
            )
        )
    virtual, chance = VirtualArm(load_virtual_model(path)), np.random.default_rng(3)
    count = virtual.joints
    for _ in range(20):
        q, dq = chance.uniform(-2, 2, (2, count))
        virtual.update_kinematics(q)
        virtual.mount_tool(q, moved_by(virtual.tool, *chance.uniform(-0.2, 0.2, 3), turn=chance.uniform(-1, 1, 3)))
        q = chance.uniform(-2, 2, count)
        virtual.update_kinematics(q)
        virtual.update_dynamics(dq)
        position, rotation, J = np.zeros(3), np.zeros((3, 3)), np.zeros((6, count))
        inertia, bias = np.zeros((count, count)), np.zeros(count)
        compute_virtual(virtual.chain, q, dq, position, rotation, J, inertia, bias)
        for found, known in (
            (position, virtual.tool.position),
            (rotation, virtual.tool.rotation),
            (J, virtual.jacobian),
            (inertia, virtual.inertia),
            (bias, virtual.bias),
        ):
            np.testing.assert_allclose(found, known, atol=1e-12)
