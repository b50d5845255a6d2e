"""Work in contact, whole: done in cells that differ from what is believed, and told clearly where it cannot be done."""

from __future__ import annotations

import pytest
from contact_runs import at_rest, run, vanish

from skillc_runtime.simulation.cell import SimulatedCell

pytestmark = pytest.mark.sim


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_button_is_pressed_with_the_force_it_wants(seed: int) -> None:
    forces: list[float] = []
    done = run(
        "press_button", seed, watch=lambda cell: forces.append(float(cell.data.sensor("lab:Button-1/force").data[0]))
    )
    assert done.succeeded, done.why
    assert done.value("Button-1", "isOn") is True
    assert 9.0 < max(forces) < 12.5
    measured = done.value("Button-1", "pressedWith")
    assert isinstance(measured, float)
    assert 8.5 < measured < 11.5
    assert at_rest(done.cell)


def test_a_button_that_jams_is_told_with_the_force_it_was_pressed_with() -> None:
    def jam(cell: SimulatedCell) -> None:
        cell.model.jnt_range[cell.model.joint("lab:Button-1/cap").id] = (0.0, 0.001)

    done = run("press_button", change=jam)
    assert not done.succeeded
    assert done.why.startswith("lab:Button-1 has not switched within 2 s, pressed with ")
    assert done.value("Button-1", "isOn") is False
    assert at_rest(done.cell)


def test_a_button_that_is_not_there_is_told() -> None:
    done = run("press_button", change=lambda cell: vanish(cell, "Button-1"))
    assert not done.succeeded
    assert "nothing to push against within 10 cm" in done.why
    assert at_rest(done.cell)
