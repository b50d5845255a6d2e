"""Arms behind topics of ROS 2, with and without messages lost and delayed, as bodies that carry out tasks."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import rclpy  # noqa: F401  the table leaves this body out without ROS 2

from robots.bodies import Opened, Task, TaskName, shipped_task
from robots.ros2 import scenes
from robots.ros2.running import LOOPBACK, robot
from robots.ros2.test_cell import opened_state
from robots.ros2.test_link import IN_ROS
from robots.truth import RemoteTruth
from simulation.cells import LAB
from skillc_model.conditions import Holds, Individual
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import CONTAIN, SKILLC

RIGID = SetProperty(SKILLC + "ur5e-sheet", SKILLC + "admittance", 0.002)
"""In m/(s N), of an arm that puts rigid things on rigid things by positions that arrive late."""
LOSSY = {"loss": 0.02, "jitter_s": 0.004, "seed": 1}


class Ros2Body:
    """A UR5e, that takes positions; implements `Body`. `options` are those of the robot."""

    def __init__(self, options: Mapping[str, Any]) -> None:
        self._options = options

    def task(self, name: TaskName, folder: Path) -> Task | None:
        """Return what it does: with a whiteboard, a part and a box, or a button."""
        match name:
            case "wipe":
                return replace(shipped_task("wiping", "clean_whiteboard"), scene=scenes.whiteboard(folder))
            case "pick and place":
                goal = Holds(Individual(LAB + "Box-A"), CONTAIN, Individual(LAB + "Part-A"))
                sorting = shipped_task("sorting", "sort_parts").library
                return Task(sorting, scenes.parts(folder), goal, (RIGID,))
            case "press":
                return replace(shipped_task("contact", "press_button"), scene=scenes.button(folder))

    @contextmanager
    def open(self, task: Task, folder: Path) -> Iterator[Opened]:
        """Start a robot, and open its cell."""
        panel = folder / "panel"
        os.environ.update(LOOPBACK)
        options = {**self._options, "library": task.library.name, "panel": str(panel)}
        with robot(task.scene, folder, **options), opened_state(task.state) as cell:
            truth = RemoteTruth(panel, lambda: cell.now)
            yield Opened(cell, truth, truth.violations)


class TableBody(Ros2Body):
    """An iiwa that wipes a table, whose scene `write` writes."""

    def __init__(self, options: Mapping[str, Any], write: Callable[[Path], Path]) -> None:
        super().__init__(options)
        self._write = write

    def task(self, name: TaskName, folder: Path) -> Task | None:
        """Return what it does: it wipes."""
        return replace(shipped_task("wiping", "clean_table"), scene=self._write(folder)) if name == "wipe" else None


POSITIONS = {"rate_hz": 125, "joint_names": IN_ROS}
BODY, WITHOUT_LOSS = Ros2Body({**POSITIONS, **LOSSY}), Ros2Body(POSITIONS)
TORQUES = TableBody({"control": "effort", "rate_hz": 500}, lambda folder: scenes.table(folder, 500.0))
OWN_LAW = TableBody({"control": "cartesian", "rate_hz": 250, **LOSSY}, scenes.cartesian_table)
