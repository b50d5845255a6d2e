"""What a control period of a simulated cell costs beside its physics, by what the arm does; whole recorded tasks.

Without arguments all tasks; `control.py TASK ...` runs these only. Each task is run twice: once to take its parts
apart, once recorded and otherwise undisturbed. Costs are medians over bursts of ten periods, in calibration steps (see
`_calibration`) and beside bare physics of the same model from the same states; nothing is measured hot in a loop.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from contextlib import closing
from copy import copy
from dataclasses import dataclass, field
from time import thread_time
from typing import Literal, TypeAlias

import mujoco
import numpy as np
from _calibration import calibration_step_us
from _whole_task import run_recorded

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose
from skillc_runtime.recording.mcap.signal_tap import SignalTap
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

SCENES = ("iiwa_table", "ur5e_whiteboard")
TASKS = {
    **dict.fromkeys(("clean_whiteboard", "clean_table", "clean_desk"), "wiping"),
    **dict.fromkeys(("press_button", "polish_sheet", "insert_peg", "teach_pose"), "contact"),
}
"""All tasks of one robot, and the library of each."""

Situation: TypeAlias = Literal["joints move", "at rest", "free", "push", "sliding", "overlay", "paused"]

PAUSE_AT, PAUSE_S = 300, 1.5
"""After how many bursts with an overlay the motion is paused, once, and for how long in simulated s."""

LEAST_BURSTS = 10
"""Of fewer bursts no median is printed."""


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


@dataclass
class Costs:
    """What bursts have cost, in s a control period; ticks in s each."""

    physics: list[float] = field(default_factory=list)
    loop: list[float] = field(default_factory=list)
    tick: list[float] = field(default_factory=list)


class TimedCell(SimulatedCell):
    """A recorded cell that times each advance, the control periods in it, and at times bare physics from there on."""

    def __init__(self, world: WorldModel) -> None:
        super().__init__(world, seed=0)
        self.costs = defaultdict[Situation, Costs](Costs)
        self._advances, self._left = 0, thread_time()
        self._paused_until: float | None = None
        SignalTap(self.live).add(lambda block: None)

    def advance(self, seconds: float) -> None:
        """Let time pass."""
        now, began = self.now, thread_time()
        super().advance(seconds)
        ended, periods = thread_time(), (self.now - now) / self.period_s
        costs = self.costs[self._situation()]
        costs.tick.append(began - self._left)
        costs.loop.append((ended - began) / periods)
        if self._advances % 5 == 0:
            costs.physics.append(self._time_physics(10))
        self._advances += 1
        self._pause_once()
        self._left = thread_time()

    def _time_physics(self, steps: int) -> float:
        model, twin = self.contacts.model, copy(self.contacts.data)  # what is stepped now
        began = thread_time()
        for _ in range(steps):
            mujoco.mj_step2(model, twin)
            mujoco.mj_step1(model, twin)
        return (thread_time() - began) / steps

    def _situation(self) -> Situation:
        driver = self.arm(next(iter(self.arms)))
        if np.isnan(np.frombuffer(driver.motion.copy_tool_reference())).any():
            return "at rest" if driver.motion.done else "joints move"
        reference, path = driver.motion.live_rows
        overlaid = bool((reference != path).any())
        pressing = any(push.pressed_s is not None for push in driver.compliance.active_pushes)
        if self._paused_until is not None and self.now < self._paused_until:
            return "paused"
        if driver.compliance.active_pushes and not overlaid and driver.motion.done:
            return "push"
        if pressing:
            return "overlay" if overlaid else "sliding"
        return "at rest" if driver.motion.done else "free"

    def _pause_once(self) -> None:
        motion = self.arm(next(iter(self.arms))).motion
        if self._paused_until is None and len(self.costs["overlay"].loop) >= PAUSE_AT:
            motion.pause()
            self._paused_until = self.now + PAUSE_S
        elif self._paused_until is not None and -np.inf < self._paused_until <= self.now:
            motion.resume()
            self._paused_until = -np.inf


def take_apart(library_name: str, task: str) -> dict[Situation, Costs]:
    """Return the costs of one run of a task by situation."""
    library = libraries.compile_library(find_library(SHIPPED / library_name)).value
    goal, scene = library.tasks[task].goal, library.tasks[task].scene
    assert goal is not None
    assert scene is not None
    state = load_scene(catalogue.scene_path(scene), library.vocabulary)
    prepared = prepare_task(Assignment(task, state, AchieveGoal(goal)), library)
    assert isinstance(prepared, PreparedTask), prepared
    with closing(TimedCell(WorldModel(state))) as cell:
        execute_task(prepared, library, cell)
        return cell.costs


def whole(library: str, task: str) -> tuple[float, float]:
    """Return how many simulated seconds a recorded task takes per second of CPU, and a simulated ms in us of CPU."""
    cell, cpu_s = run_recorded(library, task)
    return cell.now / cpu_s, 1e3 * cpu_s / cell.now


def print_task(library: str, task: str) -> None:
    """Print a row for each situation of a task, then one for the whole."""
    calibration = calibration_step_us()
    for situation, costs in take_apart(library, task).items():
        if len(costs.loop) >= LEAST_BURSTS and costs.physics:
            physics, loop, tick = (
                1e6 * float(np.median(each)) / calibration for each in (costs.physics, costs.loop, costs.tick)
            )
            print(
                f"{task:18} {situation:12} {physics:8.2f} {loop:7.2f} {loop - physics:8.2f} {tick:7.1f} "
                f"{loop / physics:8.2f}"
            )
    real_time, cost_us = whole(library, task)
    print(f"{task:18} whole, recorded: {cost_us / calibration:.2f} per simulated ms, {real_time:.1f} x real time")


if __name__ == "__main__":
    asked = sys.argv[1:]
    print(f"calibration step: {calibration_step_us():.2f} us; costs are in calibration steps")
    print(f"{'task':18} {'arm':12} {'mj_step':>8} {'loop':>7} {'beside':>8} {'tick':>7} {'loop /':>8}")
    for task, library in TASKS.items():
        if not asked or task in asked:
            print_task(library, task)
