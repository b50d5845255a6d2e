"""How much slower the simulated loop is because links collide: with contacts of links and without, taken in turn."""

from __future__ import annotations

from statistics import median
from time import process_time

import mujoco

from control import SCENES, moving, whole
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.contact_bits import LINK, SOLID
from skillc_runtime.backends.simulation.touch_recorder import TouchRecorder

BURST_S, REPEATS = 0.05, 300
TASK, PAIRS = ("wiping", "clean_table"), 3


def without_links(cell: SimulatedCell) -> SimulatedCell:
    """Return a cell after its links, hands and rigid parts of tools have lost their contact bits."""
    model = cell.model
    links = model.geom_contype & LINK > 0
    model.geom_contype[links] &= ~SOLID[0]
    model.geom_conaffinity[links] &= ~SOLID[1]
    return cell


def seconds(cell: SimulatedCell) -> float:
    """Return the processor time of a burst in s: other programs do not count."""
    began = process_time()
    cell.advance(BURST_S)
    return process_time() - began


def print_scene(scene: str) -> None:
    """Print the ratio for one scene in which an arm is on its way."""
    colliding, free = moving(scene)[0], without_links(moving(scene)[0])
    mujoco.mj_forward(free.model, free.data)
    free._touches.sample = lambda now: None  # type: ignore[method-assign]
    pairs = [(seconds(colliding), seconds(free), seconds(free), seconds(colliding)) for _ in range(REPEATS)]
    ratios = [(first + last) / (second + third) for first, second, third, last in pairs]
    print(f"{scene}: {median(ratios):.3f} x the time without contacts of links")


def print_task() -> None:
    """Print the ratio of whole tasks, with and without contacts of links in turn."""
    init, sample = SimulatedCell._prepare, TouchRecorder.sample

    def prepare_without(cell: SimulatedCell) -> None:
        init(without_links(cell))

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
