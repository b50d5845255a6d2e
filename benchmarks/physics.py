"""What a step of the physics costs, in calibration steps: a weld holds the tool, or it is a part of the hand.

Both start from the same instants of one task: on the way, and sliding in contact. Beside the steps of a cell, which
show their state in its data, stand bare steps of the model with which they are computed, and of one that is less than
a wipe needs: without sensors, and with no contacts but those of working faces.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from time import process_time
from typing import Any

import mujoco
import numpy as np
from _calibration import calibration_step_us
from _whole_task import run_recorded

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.model.contact_bits import CARRIES, WORKS

TASKS = {"clean_table": (10.0, 30.0), "clean_whiteboard": (28.0, 50.0)}
"""When the tool is on its way and when it slides, in s."""

BURSTS, STEPS = 60, 10
STATE = mujoco.mjtState.mjSTATE_INTEGRATION


class MeasuredCell(SimulatedCell):
    """A cell whose physics is timed at some instants; nothing is left of it."""

    tightens: bool
    times: list[float]
    costs: list[tuple[float, float, float]]

    def _prepare(self) -> None:
        self.physics.tightens = self.tightens
        super()._prepare()

    def advance(self, seconds: float) -> None:
        """Advance, and measure when it is time."""
        super().advance(seconds)
        if self.times and self.now >= self.times[0]:
            self.times.pop(0)
            self.costs.append(self._measure())

    def _measure(self) -> tuple[float, float, float]:
        """Return what a step of the cell costs, a bare one, and one of a lesser model, in us: medians of bursts."""
        model, data = self.physics.contacts.model, self.physics.contacts.data
        least = _reduce(model)
        states = [(each, other, _read(each, other)) for each, other in ((self.model, self.data), (model, data))]

        def bare() -> None:
            mujoco.mj_step2(model, data)
            mujoco.mj_step1(model, data)

        def reduced() -> None:
            mujoco.mj_step2(least, data)
            mujoco.mj_step1(least, data)

        def whole() -> None:
            self.physics.move()
            self.physics.compute_places()

        def back() -> None:
            for each, other, state in states:
                mujoco.mj_setState(each, other, state, STATE)
            self.physics.renew()

        found = _cost_us(whole, back), _cost_us(bare, back), _cost_us(reduced, back)
        back()
        return found


def _reduce(model: Any) -> Any:
    """Return a model without sensors, in which only working faces and what they work on collide."""
    least = copy(model)
    least.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_SENSOR
    others = ~np.isin(least.geom_contype, (CARRIES, WORKS))
    for bits in (least.geom_contype, least.geom_conaffinity):
        bits[others] = 0
    for bits, of_geoms in ((least.body_contype, least.geom_contype), (least.body_conaffinity, least.geom_conaffinity)):
        bits[:] = 0
        np.bitwise_or.at(bits, least.geom_bodyid, of_geoms)
    return least


def _read(model: Any, data: Any) -> Any:
    state = np.zeros(mujoco.mj_stateSize(model, STATE))
    mujoco.mj_getState(model, data, state, STATE)
    return state


def _cost_us(step: Callable[[], None], back: Callable[[], None]) -> float:
    bursts = []
    for _ in range(BURSTS):
        back()
        began = process_time()
        for _ in range(STEPS):
            step()
        bursts.append((process_time() - began) / STEPS)
    return 1e6 * float(np.median(bursts))


def measure(task: str, tightens: bool) -> list[tuple[float, float, float]]:
    """Return the costs at the instants of a task."""
    kind = type("Measured", (MeasuredCell,), {"tightens": tightens, "times": [*TASKS[task]], "costs": []})
    run_recorded("wiping", task, kind)
    found: list[tuple[float, float, float]] = kind.costs  # type: ignore[attr-defined]
    return found


if __name__ == "__main__":
    for task in TASKS:
        unit = calibration_step_us()
        pairs = zip(("on the way", "sliding"), measure(task, False), measure(task, True), strict=True)
        for phase, *costs in pairs:
            (weld, bare_weld, _), (part, bare_part, least) = ([each / unit for each in steps] for steps in costs)
            hand = f"part of the hand {part:.2f} (bare {bare_part:.2f}, of less than a wipe needs {least:.2f})"
            print(f"{task}, {phase}: weld {weld:.2f} (bare {bare_weld:.2f}), {hand} calibration steps")
