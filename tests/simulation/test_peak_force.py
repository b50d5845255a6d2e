"""The greatest force on a tool is the sum of all its contacts."""

import numpy as np
import pytest
from cells import world

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.truth.observer import PeakForce
from skillc_runtime.world.state.model import WorldModel


@pytest.mark.parametrize("scene", ["iiwa_table", "ur5e_whiteboard"])
def test_a_tool_that_lies_somewhere_feels_its_weight_and_what_pushes_it(scene: str) -> None:
    there = SimulatedCell(WorldModel(world(scene)))
    tool = there.scene.tools[0]
    name = there.scene.names[tool.individual]
    there.advance(1.0)
    felt = PeakForce(name, there.model, there.data)
    felt.sample()
    weight_n = tool.mass_kg * 9.81
    assert felt.newton == pytest.approx(weight_n, rel=0.01)
    there.data.xfrc_applied[there.model.body(f"{name}/block").id, :3] = np.array([0.1, 0.0, -1.0]) * weight_n
    there.advance(0.2)
    felt.sample()
    assert felt.newton == pytest.approx(np.hypot(2.0, 0.1) * weight_n, rel=0.01)
    there.data.xfrc_applied[:] = 0.0
    there.advance(0.2)
    before = felt.newton
    felt.sample()
    assert felt.newton == before
