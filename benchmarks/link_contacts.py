"""How much slower the simulated loop is because links collide: with contacts of links and without, taken in turn."""

from __future__ import annotations

from statistics import median
from time import process_time

import mujoco
import numpy as np

from control import SCENES, moving, whole
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.contact_bits import LINK, SOLID
from skillc_runtime.backends.simulation.touch_recorder import TouchRecorder

BURST_S, REPEATS = 0.02, 300
TASK, PAIRS = ("wiping", "clean_table"), 3


class Switch:
    """Switches the contacts of links, hands and rigid parts of tools off and on in one model.

    Two models would lie differently in memory, which alone makes one of them a few percent slower.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._bits = model.geom_contype, model.geom_conaffinity, model.body_contype, model.body_conaffinity
        self._on = [bits.copy() for bits in self._bits]
        links = model.geom_contype & LINK > 0
        kinds, met = (np.where(links, bits & ~solid, bits) for bits, solid in zip(self._on, SOLID, strict=False))
        self._off = [kinds, met, bodies_of(model, kinds), bodies_of(model, met)]

    def set(self, on: bool) -> None:
        """Switch them."""
        for bits, values in zip(self._bits, self._on if on else self._off, strict=True):
            bits[:] = values


def bodies_of(model: mujoco.MjModel, bits: np.ndarray) -> np.ndarray:
    """Return, by body, the bits (nbody,) of all its geoms, whose bits are (ngeom,)."""
    merged = np.zeros(model.nbody, dtype=bits.dtype)
    np.bitwise_or.at(merged, model.geom_bodyid, bits)
    return merged


def seconds(cell: SimulatedCell) -> float:
    """Return the processor time of a burst in s: other programs do not count."""
    began = process_time()
    cell.advance(BURST_S)
    return process_time() - began


def print_scene(scene: str) -> None:
    """Print the ratio for one scene in which an arm is on its way."""
    cell = moving(scene)[0]
    switch, sample = Switch(cell.model), cell._touches.sample

    def burst(on: bool) -> float:
        switch.set(on)
        cell._touches.sample = sample if on else lambda now: None  # type: ignore[method-assign]
        cell.advance(cell.period_s)
        return seconds(cell)

    bursts = [(burst(True), burst(False), burst(False), burst(True)) for _ in range(REPEATS)]
    ratios = [(first + last) / (second + third) for first, second, third, last in bursts]
    print(f"{scene}: {median(ratios):.3f} x the time without contacts of links")


def print_task() -> None:
    """Print the ratio of whole tasks, with and without contacts of links in turn."""
    init, sample = SimulatedCell._prepare, TouchRecorder.sample

    def prepare_without(cell: SimulatedCell) -> None:
        Switch(cell.model).set(False)
        init(cell)

    def one_pair() -> float:
        SimulatedCell._prepare, TouchRecorder.sample = init, sample  # type: ignore[method-assign]
        speed, _ = whole(*TASK)
        SimulatedCell._prepare = prepare_without  # type: ignore[method-assign]
        TouchRecorder.sample = lambda self, now: None  # type: ignore[method-assign]
        free, _ = whole(*TASK)
        return free / speed

    ratios = [one_pair() for _ in range(PAIRS)]
    SimulatedCell._prepare, TouchRecorder.sample = init, sample  # type: ignore[method-assign]
    print(f"{TASK[1]}: {median(ratios):.3f} x the time without contacts of links")


if __name__ == "__main__":
    for scene in SCENES:
        print_scene(scene)
    print_task()
