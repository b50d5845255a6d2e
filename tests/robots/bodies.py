"""The same tasks in different bodies, each beside a simulation of the same arm in the same scene, as a table.

    PYTHONPATH=tests python -m robots.bodies [BODY ...] [--task TASK ...]

A body is a back end with an emulator behind it, listed in `BODIES`. What is measured is true
behind the protocol, and measured as in the report of a simulation.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any, Final, Literal, Protocol, TypeAlias, get_args

from robots.figures import Figures, measure
from robots.truth import RemoteTruth
from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState

TaskName: TypeAlias = Literal["wipe", "pick and place", "press"]

BODIES: Final = {
    "toy": "control_process.body:BODY",
    "franka": "robots.franka.body:BODY",
    "ur": "robots.ur.body:BODY",
    "ros2": "robots.ros2.body:BODY",
    "ros2 without loss": "robots.ros2.body:WITHOUT_LOSS",
    "ros2 torques": "robots.ros2.body:TORQUES",
    "ros2 own law": "robots.ros2.body:OWN_LAW",
}
"""Bodies besides simulation, each in a module; those whose packages are missing are left out."""

COMPARE_EVERY = 25
"""After so many ticks the time behind the protocol is compared with that of the cell."""


@dataclass(frozen=True, slots=True)
class Task:
    """What is done, in all bodies: a goal, by the skills of a library, in a scene with some facts changed."""

    library: SkillLibrary
    scene: Path
    goal: Condition
    changes: tuple[Change, ...] = ()

    @property
    def state(self) -> WorldState:
        """The world at the beginning."""
        return load_scene(self.scene, self.library.vocabulary).with_changes(self.changes)


@dataclass(frozen=True, slots=True)
class Opened:
    """An open cell; what is true behind its protocol; and which commands were beyond the limits of the maker."""

    cell: DeviceCell
    truth: RemoteTruth
    violations: Callable[[], Sequence[str]]


class Body(Protocol):
    """A back end with an emulator behind it."""

    def task(self, name: TaskName, folder: Path) -> Task | None:
        """Return what it does for a task, None if it cannot; files of it may be written to `folder`.

        The scene is one that a simulation can be made of as well: it states the arm that is emulated.
        """
        ...

    def open(self, task: Task, folder: Path) -> AbstractContextManager[Opened]:
        """Start the emulator with the things of the task around it and open a cell, with the facts that it needs."""
        ...


def shipped_task(library: str, name: str, changes: tuple[Change, ...] = ()) -> Task:
    """Return a shipped task that has a goal."""
    outcome = libraries.compile_library(find_library(SHIPPED / library))
    assert outcome.ok, outcome.diagnostics
    found = outcome.value.tasks[name]
    assert found.goal is not None
    assert found.scene is not None
    return Task(outcome.value, find_scene(library, found.scene), found.goal, changes)


def find_scene(library: str, name: str) -> Path:
    """Return the file of a scene of a shipped library, or of those that all share."""
    own = SHIPPED / library / name
    return own if own.exists() else catalogue.scene_path(name)


def run(body: Body, task: Task, folder: Path) -> Figures:
    """Carry out a task in a body."""
    with body.open(task, folder) as opened:
        processes = [arm.process for arm in opened.cell._arms.values() if isinstance(arm, RemoteArmDriver)]
        before = [each.read().number("lost") for each in processes]
        began, ticks = opened.cell.now, iter(range(10**9))

        def compare() -> None:
            if next(ticks) % COMPARE_EVERY == 0:
                opened.truth.compare_times()

        opened.truth.compare_times()
        execution, history = _carry_out(task, opened.cell, compare)
        opened.truth.compare_times()
        lost = sum(each.read().number("lost") for each in processes) - sum(before)
        cycles = sum((opened.cell.now - began) / each.connected.period_s for each in processes)
        figures = measure(execution, history, opened.truth.asked)
        return figures.with_cycles(round(lost), round(cycles), len(opened.violations()))


def simulate(task: Task) -> Figures:
    """Carry out a task in a simulation of the same arm in the same scene."""
    cell = SimulatedCell(WorldModel(task.state))
    return measure(*_carry_out(task, cell), cell.capabilities.truth)


def move_kinematically(task: Task) -> Figures:
    """Carry out a task without physics: only its outcome means something."""
    return measure(*_carry_out(task, KinematicCell(WorldModel(task.state))), None)


def find_bodies(names: Sequence[str] = ()) -> Iterator[tuple[str, Body]]:
    """Yield the bodies that there are, by name."""
    for name, place in BODIES.items():
        if not names or name in names:
            module, _, body = place.partition(":")
            try:
                yield name, getattr(import_module(module), body)
            except ModuleNotFoundError as error:
                print(f"{name} is left out: {error}")


def _carry_out(task: Task, cell: Any, after_tick: Callable[[], None] = lambda: None) -> tuple[Any, Any]:
    """Plan for the goal and carry that out; return execution and history."""
    prepared = prepare_task(Assignment("task", cell.world.snapshot(), AchieveGoal(task.goal)), task.library)
    assert isinstance(prepared, PreparedTask), prepared
    told = HistoryBuilder()
    execution = execute_task(prepared, task.library, cell, [told], after_tick)
    return execution, told.history


def _print_row(task: TaskName, who: str, make: Callable[[], Figures]) -> None:
    """Print the figures; of a body that cannot carry out a task at all, why, so that the others are printed too."""
    try:
        row = make().as_row(task, who)
    except Exception as error:  # noqa: BLE001  the boundary between bodies
        row = Figures.row(task, who, f"{type(error).__name__}: {error}")
    print(row, flush=True)


def main() -> None:
    """Print the table."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("bodies", nargs="*", metavar="BODY")
    options.add_argument("--task", action="append", choices=get_args(TaskName))
    given = options.parse_args()
    print(Figures.HEAD)
    for name, body in find_bodies(given.bodies):
        for task_name in given.task or get_args(TaskName):
            with tempfile.TemporaryDirectory() as place:
                folder = Path(place)
                if (task := body.task(task_name, folder)) is None:
                    continue
                rows = {
                    name: partial(run, body, task, folder),
                    "simulation": partial(simulate, task),
                    "kinematic": partial(move_kinematically, task),
                }
                for who, made in rows.items():
                    _print_row(task_name, who, made)


if __name__ == "__main__":
    main()
