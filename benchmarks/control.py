"""How fast the simulated loop runs for both arms: the whole loop and the law against bare physics of the same model."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter

import mujoco
import numpy as np

from skillc_compiler.vocabulary.load import load
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_runtime.motion.path import path
from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.segments import MotionLimits
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.world.model import WorldModel
from skillc_runtime.world.scene import load_scene

SCENES = ("iiwa_table", "ur5e_whiteboard")
REPEATS, BURST = 2000, 2


def moving(scene: str) -> tuple[SimulatedCell, str]:
    """Return a cell whose arm is on its way along a line, very slowly, and that arm."""
    vocabulary = load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value
    cell = SimulatedCell(WorldModel(load_scene(catalogue.scene(scene), vocabulary)), seed=0)
    name = next(iter(cell.arms))
    start = cell.arm(name).anchor
    goal = Pose(start.position + np.array([0.0, 0.0, 0.1]), start.rotation)
    cell.arm(name).move_along(path([start, goal], MotionLimits(speed=0.001, acceleration=0.4)))
    cell.advance(1.0)
    return cell, name


def costs_us(calls: tuple[Callable[[], object], ...]) -> list[float]:
    """Return what each call costs when nothing else runs: the least of many short bursts, taken in turn."""
    least = [float("inf")] * len(calls)
    for _ in range(REPEATS):
        for i, call in enumerate(calls):
            began = perf_counter()
            for _ in range(BURST):
                call()
            least[i] = min(least[i], (perf_counter() - began) / BURST)
    return [1e6 * cost for cost in least]


def measure(scene: str) -> tuple[float, float, float]:
    """Return what a simulated millisecond costs in us: the whole loop, the arm's controller in it, the physics."""
    cell, name = moving(scene)
    driver, model, data = cell.arm(name), cell.model, cell.data

    def physics() -> None:
        mujoco.mj_step2(model, data)
        mujoco.mj_step1(model, data)

    whole, law, bare = costs_us((lambda: cell.advance(0.001), lambda: driver.step(data.time), physics))
    return whole, law, bare


if __name__ == "__main__":
    for scene in SCENES:
        whole, law, bare = measure(scene)
        print(f"{scene}: loop {whole / bare:.1f} x mj_step, law {law / bare:.1f} x, {1000 / whole:.1f} x real time")
