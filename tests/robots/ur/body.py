"""An arm behind an emulated controller as one of the bodies that carry out tasks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from robots.bodies import Opened, Task, TaskName, shipped_task
from robots.truth import RemoteTruth
from robots.ur.peer import running_peer
from robots.ur.tasks import HERE, LAB, PATIENT, compiled, opened, with_peer
from skillc.services.library.files import SHIPPED
from skillc_model.conditions import Holds, Individual
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import CONTAIN, SKILLC

RIGID = SetProperty(SKILLC + "ur5e-sheet", SKILLC + "admittance", 0.002)
"""In m/(s N), of an arm that puts rigid things on rigid things, through servos that are some 25 ms late: with the 0.008
of the sheet they met with 76 to 84 N, four times as hard as in simulation."""


class UrBody:
    """Implements `Body`."""

    def task(self, name: TaskName, folder: Path) -> Task:
        """Return what it does: with a whiteboard, a part and a box, or a button."""
        match name:
            case "wipe":
                return replace(shipped_task("wiping", "clean_whiteboard"), scene=HERE / "whiteboard.ttl")
            case "pick and place":
                goal = Holds(Individual(LAB + "Box-A"), CONTAIN, Individual(LAB + "Part-A"))
                return Task(compiled(SHIPPED / "sorting"), HERE / "parts.ttl", goal, (RIGID,))
            case "press":
                return shipped_task("contact", "press_button")

    @contextmanager
    def open(self, task: Task, folder: Path) -> Iterator[Opened]:
        """Start a controller, and open the cell of its arm."""
        truth = folder / "truth"
        options = (*PATIENT, "--library", task.library.name, "--truth", str(truth))
        with running_peer(*options, scene=task.scene) as peer, opened(peer, with_peer(peer, task.state)) as cell:

            def find_violations() -> Sequence[str]:
                told = peer.tell()
                found: list[str] = told["violations"] + ([] if told["safety"] == "NORMAL" else [told["why"]])
                return found

            yield Opened(cell, RemoteTruth(truth, lambda: cell.now), find_violations)


BODY = UrBody()
