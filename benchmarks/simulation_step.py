"""What a simulated millisecond costs, part by part, for each shipped scene: microseconds, and ratios to the physics."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter

import mujoco

from skillc_compiler.vocabulary.load import load
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.world.model import WorldModel
from skillc_runtime.world.scene import load_scene

REPEATS, CALLS = 40, 50


def best_us(call: Callable[[], object]) -> float:
    """Return the least mean time of a call over many short bursts, so that other work hardly counts."""
    least = float("inf")
    for _ in range(REPEATS):
        began = perf_counter()
        for _ in range(CALLS):
            call()
        least = min(least, (perf_counter() - began) / CALLS)
    return 1e6 * least


def measure(scene: str) -> dict[str, float]:
    """Return the cost of each part in us; the first is the floor, physics alone. The arm holds its tool in space."""
    vocabulary = load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value
    cell = SimulatedCell(WorldModel(load_scene(catalogue.scene(scene), vocabulary)))
    (name, arm), *_ = cell.arms.items()
    driver, model, data = cell.arm(name), cell.model, cell.data
    driver.hold_position()
    cell.advance(0.2)

    def physics() -> None:
        mujoco.mj_step2(model, data)
        mujoco.mj_step1(model, data)

    return {
        "whole step": best_us(lambda: cell.advance(0.001)),
        "controller and references, with state": best_us(lambda: driver.step(data.time)),
        "state of the arm": best_us(arm.state),
        "physics": best_us(physics),
    }


if __name__ == "__main__":
    for scene in catalogue.scenes():
        parts = measure(scene)
        print(f"{scene}: {1000 / parts['whole step']:.1f} x real time")
        for part, cost in parts.items():
            print(f"  {part:40s} {cost:7.1f} us  {cost / parts['physics']:6.2f} x physics")
