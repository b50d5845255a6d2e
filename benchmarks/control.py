"""How fast the simulated loop runs: loop and law against bare physics of the same model, by part; whole tasks.

Without arguments the scenes at rest and all tasks; `control.py NAME ...` runs these scenes and tasks only.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from copy import copy
from time import perf_counter

import mujoco
import numpy as np

from skillc.services import libraries
from skillc.services.library_files import SHIPPED, find_library
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask, prepare_task
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.motion.path import path_through
from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.segments import MotionLimits
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

SCENES = ("iiwa_table", "ur5e_whiteboard")
TASKS = {
    **dict.fromkeys(("clean_whiteboard", "clean_table", "clean_desk"), "wiping"),
    **dict.fromkeys(("press_button", "polish_sheet", "insert_peg", "teach_pose"), "contact"),
}
"""All tasks of one robot, and the library of each."""

REPEATS, BURST = 200, 20


def moving(scene: str) -> tuple[SimulatedCell, str]:
    """Return a cell whose arm is on its way along a line, very slowly, and that arm."""
    vocabulary = load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value
    cell = SimulatedCell(WorldModel(load_scene(catalogue.scene_path(scene), vocabulary)), seed=0)
    name = next(iter(cell.arms))
    start = cell.arm(name).motion.stopping_pose()
    goal = Pose(start.position + np.array([0.0, 0.0, 0.1]), start.rotation)
    cell.arm(name).motion.move_along(path_through([start, goal], MotionLimits(speed=0.001, acceleration=0.4)))
    cell.advance(1.0)
    return cell, name


def costs_us(calls: tuple[Callable[[], object], ...]) -> list[float]:
    """Return what each call costs when nothing else runs: the least of many bursts, taken in turn.

    A burst is long enough to hold what is done every tenth time only.
    """
    least = [float("inf")] * len(calls)
    for _ in range(REPEATS):
        for i, call in enumerate(calls):
            began = perf_counter()
            for _ in range(BURST):
                call()
            least[i] = min(least[i], (perf_counter() - began) / BURST)
    return [1e6 * cost for cost in least]


def measure(scene: str) -> dict[str, float]:
    """Return what a simulated millisecond costs in us: the whole loop, the arm's controller, its parts, the physics."""
    cell, name = moving(scene)
    driver, arm, model, data = cell.arm(name), cell.arms[name], cell.model, cell.data
    task = driver._task
    law, generator, compliance = task.controllers.tool, task.tool.reference_generator, task.tool.compliance.applied
    state, reference = arm.state(), task.tool.reference

    def physics() -> None:
        mujoco.mj_step2(model, data)
        mujoco.mj_step1(model, data)

    parts: dict[str, Callable[[], object]] = {
        "loop": lambda: cell.advance(0.001),
        "controller": lambda: driver.step(data.time),
        "measuring": arm.state,
        "reference": lambda: generator.sample(task.now),
        "law": lambda: law.command(state, reference, compliance, 0.001),
        "safety": lambda: driver._safety.violation(state, 0.001),
        "mj_step": physics,
    }
    return dict(zip(parts, costs_us(tuple(parts.values())), strict=True))


class TimedCell(SimulatedCell):
    """A cell that, beside every tenth of its ticks, times bare physics from the same state on."""

    ticks, steps, physics_s, comparing_s = 0, 0, 0.0, 0.0

    def advance(self, seconds: float) -> None:
        """Let time pass."""
        super().advance(seconds)
        if self.ticks % 10 == 0:
            self.compare(10)
        self.ticks += 1

    def compare(self, steps: int) -> None:
        """Time some steps of a twin; everything about it counts, so that it can be taken off the whole."""
        began = perf_counter()
        twin = copy(self.data)
        first = perf_counter()
        for _ in range(steps):
            mujoco.mj_step2(self.model, twin)
            mujoco.mj_step1(self.model, twin)
        done = perf_counter()
        self.physics_s, self.steps = self.physics_s + done - first, self.steps + steps
        self.comparing_s = self.comparing_s + done - began


def whole(library_name: str, task: str) -> tuple[float, float]:
    """Return how many simulated seconds a task takes per second, and its time in that of its bare physics.

    The tree, records and the world model are included; planning and preparing are not.
    """
    library = libraries.compile_library(find_library(SHIPPED / library_name)).value
    goal, scene = library.tasks[task].goal, library.tasks[task].scene
    assert goal is not None
    assert scene is not None
    state = load_scene(catalogue.scene_path(scene), library.vocabulary)
    prepared = prepare_task(Assignment(task, state, AchieveGoal(goal)), library)
    assert isinstance(prepared, PreparedTask), prepared
    cell = TimedCell(WorldModel(state), seed=0)
    began = perf_counter()
    execute_task(prepared, library, cell)
    per_step = (perf_counter() - began - cell.comparing_s) / (cell.now / cell.period_s)
    return cell.period_s / per_step, per_step / (cell.physics_s / cell.steps)


def print_scene(scene: str) -> None:
    """Print the parts of the loop of one scene."""
    costs = measure(scene)
    ratios = ", ".join(f"{part} {cost / costs['mj_step']:.2f}" for part, cost in costs.items() if part != "mj_step")
    print(f"{scene}: {ratios} x mj_step; {1000 / costs['loop']:.1f} x real time")


def print_task(library: str, task: str) -> None:
    """Print how fast one task is."""
    real_time, ratio = whole(library, task)
    print(f"{task}: {ratio:.2f} x mj_step; {real_time:.1f} x real time")


if __name__ == "__main__":
    asked = sys.argv[1:]
    for scene in SCENES:
        if not asked or scene in asked:
            print_scene(scene)
    for task, library in TASKS.items():
        if not asked or task in asked:
            print_task(library, task)
