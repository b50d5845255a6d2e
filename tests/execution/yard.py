"""A depot with a loop, in which several runs carry crates."""

from __future__ import annotations

from collections.abc import Callable

from execution.loops import LatePlanner, Watched, submit
from plans.depot import Depot, contain, goal, iri, library, world
from skillc_runtime.execution.assignment import AchieveGoal, Assignment
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.changes import RemoveRelation
from skillc_runtime.world.state.model import WorldModel

CRATE_TO_B, BOX_TO_B = "lab:b contain lab:crate", "lab:b contain lab:box"


class Yard:
    """A depot with a loop."""

    def __init__(
        self,
        robots: dict[str, str],
        crates: dict[str, str],
        fails: Callable[[str, int], bool] = lambda step, number: False,
    ) -> None:
        self.depot = Depot(WorldModel(world(robots, crates)), fails=fails)
        self.planner = LatePlanner(library())
        self.loop = CellLoop(self.depot, library(), self.planner)  # type: ignore[arg-type]

    def submit(self, text: str, settings: RunSpec | None = None, looks: tuple[int, ...] = ()) -> Watched:
        self.planner.looks.extend(looks)
        state = self.depot.world.snapshot()
        return submit(self.loop, Assignment(text, state, AchieveGoal(goal(text, state))), settings)

    def tick(self, ticks: int) -> None:
        for _ in range(ticks):
            self.loop.tick()

    def move(self, crate: str, source: str, target: str) -> None:
        """Let somebody else move a crate."""
        changes = [RemoveRelation(iri(source), contain(source, crate).relation, iri(crate)), contain(target, crate)]
        self.depot.world.commit(changes, "somebody else")
