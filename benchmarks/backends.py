"""How many simulated seconds a second the kinematic cell runs, relative to MuJoCo's: scenes in motion, whole tasks."""

from __future__ import annotations

from collections.abc import Callable
from statistics import median
from time import perf_counter
from typing import TypeAlias

import numpy as np

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

SCENES = ("iiwa_table", "ur5e_whiteboard", "two_robots")
TASKS = {"press_button": "contact", "insert_peg": "contact", "clean_table": "wiping"}
BURST_S, REPEATS = 0.1, 40

Maker: TypeAlias = Callable[[WorldModel], SimulatedCell | KinematicCell]


def moving(scene: str, library: SkillLibrary, make: Maker) -> Callable[[], None]:
    """Return what advances a cell by a burst, in which an arm is on its way along a line, very slowly."""
    cell = make(WorldModel(load_scene(catalogue.scene_path(scene), library.vocabulary)))
    motion = cell.arm(next(iter(cell.arms))).motion
    start = motion.stopping_pose()
    goal = Pose(start.position + np.array([0.0, 0.0, 0.1]), start.rotation)
    motion.move_along(path_through([start, goal], MotionLimits(speed=0.001, acceleration=0.4)))
    cell.advance(1.0)
    return lambda: cell.advance(BURST_S)


def seconds(call: Callable[[], object]) -> float:
    """Return how long a call takes in s."""
    began = perf_counter()
    call()
    return perf_counter() - began


def print_scene(scene: str, library: SkillLibrary) -> None:
    """Print the ratio for one scene at the default step and at MuJoCo's; bursts are taken in turn."""
    makers: tuple[Maker, ...] = (SimulatedCell, KinematicCell, lambda world: KinematicCell(world, 0.001))
    cells = [moving(scene, library, make) for make in makers]
    costs = [[seconds(cell) for cell in cells] for _ in range(REPEATS)]
    default, same_step = (median(row[0] / row[each] for row in costs) for each in (1, 2))
    print(f"{scene}: kinematic {default:.2f} x mujoco; {same_step:.2f} x with steps of 1 ms as in mujoco")


def run(task: str, library: SkillLibrary, make: Maker) -> float:
    """Return how many simulated seconds a task takes per second, with the tree, without planning."""
    goal, scene = library.tasks[task].goal, library.tasks[task].scene
    assert goal is not None
    assert scene is not None
    state = load_scene(catalogue.scene_path(scene), library.vocabulary)
    prepared = prepare_task(Assignment(task, state, AchieveGoal(goal)), library)
    assert isinstance(prepared, PreparedTask), prepared
    cell = make(WorldModel(state))
    began = perf_counter()
    execution = execute_task(prepared, library, cell)
    assert execution.status == "succeeded", execution.failure
    return cell.now / (perf_counter() - began)


def print_task(task: str, library: SkillLibrary) -> None:
    """Print the ratio for a whole task, each backend twice in turn."""
    ratios = [run(task, library, KinematicCell) / run(task, library, SimulatedCell) for _ in range(2)]
    print(f"{task}: kinematic {median(ratios):.2f} x mujoco")


if __name__ == "__main__":
    compiled = {name: libraries.compile_library(find_library(SHIPPED / name)).value for name in ("contact", "wiping")}
    for scene in SCENES:
        print_scene(scene, compiled["wiping"])
    for task, name in TASKS.items():
        print_task(task, compiled[name])
