"""The toy robot as one of the bodies that carry out tasks."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from control_process.toy_link import MUCH_PATIENCE, toy_cell
from robots.bodies import Opened, Task, TaskName, shipped_task
from robots.truth import RemoteTruth

TASKS = {
    "wipe": ("wiping", "clean_table"),
    "pick and place": ("contact", "insert_peg_iiwa"),
    "press": ("contact", "press_button"),
}


class ToyBody:
    """Implements `Body`."""

    def task(self, name: TaskName, folder: Path) -> Task:
        return shipped_task(*TASKS[name])

    @contextmanager
    def open(self, task: Task, folder: Path) -> Iterator[Opened]:
        truth = folder / "truth"
        with toy_cell(task.scene.stem, state=task.state, patience=MUCH_PATIENCE, truth=truth) as (toy, cell):
            yield Opened(cell, RemoteTruth(truth, lambda: cell.now), lambda: toy.ask("report")["violations"])


BODY = ToyBody()
