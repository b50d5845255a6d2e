"""Running the tasks of the shipped library of contact skills."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.pose import Array
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.values import Value

LAB = "http://example.org/lab#"
CONTACT = "https://w3id.org/skillc/contact#"


@dataclass(frozen=True)
class Outcome:
    """How a task ended, in which cell."""

    execution: Execution
    cell: SimulatedCell

    @property
    def succeeded(self) -> bool:
        return self.execution.status == "succeeded"

    @property
    def why(self) -> str:
        return self.execution.failure.message if self.execution.failure else ""

    def value(self, individual: str, property_: str) -> Value | None:
        """What the world model says in the end."""
        return self.cell.world.snapshot().value(LAB + individual, CONTACT + property_)


@cache
def library() -> SkillLibrary:
    outcome = libraries.compile_library(find_library(SHIPPED / "contact"))
    assert outcome.diagnostics == ()
    return outcome.value


def run(
    name: str,
    seed: int = 0,
    change: Callable[[SimulatedCell], None] = lambda cell: None,
    watch: Callable[[SimulatedCell], None] = lambda cell: None,
    *,
    once: bool = False,
) -> Outcome:
    """Run a task in a cell that `change` has changed before; `watch` sees the cell after every tick.

    When its plan fails it is planned again, unless it shall be tried `once` only.
    """
    task = library().tasks[name]
    assert task.scene is not None
    assert task.goal is not None
    state = load_scene(catalogue.scene_path(task.scene), library().vocabulary)
    prepared = prepare_task(Assignment(name, state, AchieveGoal(task.goal)), library())
    assert isinstance(prepared, PreparedTask), prepared
    if once:
        prepared = prepare_task(Assignment(name, state, ExecuteBody(prepared.body)), library())
        assert isinstance(prepared, PreparedTask), prepared
    cell = SimulatedCell(WorldModel(state), seed)
    change(cell)
    return Outcome(execute_task(prepared, library(), cell, after_tick=lambda: watch(cell)), cell)


def at_rest(cell: SimulatedCell) -> bool:
    """Whether no arm moves or is asked to push, and each is stiff along every axis."""
    drivers = [cell.arm(arm.individual) for arm in cell.scene.arms]
    stiff = all(bool((one.compliance.commanded_stiffness > 0).all()) for one in drivers)
    pushing = any(bool((abs(one.compliance.commanded_wrench) > 0.1).any()) for one in drivers)
    return bool(drivers) and cell.is_at_rest() and stiff and not pushing


def vanish(cell: SimulatedCell, fixture: str) -> None:
    """Let everything pass through a fixture, as if it were not there."""
    prefix = cell.scene.names[LAB + fixture] + "/"
    geoms = [g for g in range(cell.model.ngeom) if cell.model.geom(g).name.startswith(prefix)]
    assert geoms
    cell.model.geom_contype[geoms] = cell.model.geom_conaffinity[geoms] = 0
    cell.refresh()


def displace(cell: SimulatedCell, body: str, by: tuple[float, float, float]) -> None:
    """Put something elsewhere that nothing moves, m along the axes of the world."""
    cell.model.body(body).pos += by
    cell.refresh()


def tell(cell: SimulatedCell, individual: str, property_: str, value: float) -> None:
    """Let the world model say something else."""
    cell.world.commit([SetProperty(LAB + individual, CONTACT + property_, value)], "the test")


def strongest(signal: Array, step_s: float) -> tuple[float, float]:
    """Return frequency in Hz and amplitude of the strongest oscillation above 1 Hz in a signal (n,)."""
    window = np.hanning(len(signal))
    spectrum = np.abs(np.fft.rfft((signal - signal.mean()) * window)) * 2 / window.sum()
    frequency = np.fft.rfftfreq(len(signal), step_s)
    spectrum[frequency < 1.0] = 0.0
    at = int(spectrum.argmax())
    return float(frequency[at]), float(spectrum[at])
