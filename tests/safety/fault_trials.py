"""Tasks during which the signals of an arm become wrong: what then presses on what, who notices it, and when."""

from __future__ import annotations

from contextlib import closing
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.arms.signal_faults import FaultKind, SignalFault
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.events import Event, NodeStarted
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

WIPES: Final = {"iiwa": "clean_table", "ur5e": "clean_whiteboard", "panda": "clean_desk"}
"""The task of each arm in which all phases but the last are."""

INSERTS: Final = {"iiwa": "insert_peg_iiwa", "panda": "insert_peg"}
"""The task of each arm in which something is inserted."""

PHASES: Final = {
    "free": ("MoveJoints", 1, 1.0),
    "grasp": ("Gripper", 2, 0.1),
    "carry": ("MoveLinear", 2, 0.5),
    "approach": ("Push", 1, 0.6),
    "press": ("Align", 1, 0.5),
    "wipe": ("FollowPath", 1, 3.0),
    "insert": ("Seat", 1, 0.5),
}
"""When signals become wrong: so many s after a primitive has been started for the n-th time; ends of names count."""

LIMIT_N: Final = 80.0
TOUCH_N: Final = 1.0
PATIENCE_S: Final = 10.0
REST_S: Final = 0.5
"""Limit of the contact force; the least of a touch; for how long a task goes on with a fault; when an arm that has
stopped shall rest."""


@dataclass(slots=True)
class Trial:
    """What happens to one arm with one fault; times in s."""

    cell: SimulatedCell
    kind: FaultKind
    phase: str
    began: dict[str, int] = field(default_factory=dict)
    starts_s: float = np.inf
    noticed_s: float | None = None
    reason: str = "nothing"

    @property
    def arm(self) -> str:
        """The arm of the cell."""
        return next(iter(self.cell.arms))

    def listen(self, event: Event) -> None:
        """Set the fault when its phase begins."""
        primitive, count, delay = PHASES[self.phase]
        if isinstance(event, NodeStarted) and event.kind == "primitive" and event.name.endswith(primitive):
            self.began[primitive] = self.began.get(primitive, 0) + 1
            if self.began[primitive] == count:
                self.starts_s = self.cell.now + delay
                self.cell.arms[self.arm].set_fault(SignalFault(self.kind, self.starts_s))

    def look(self) -> None:
        """Note why the arm stopped by itself; called after each tick."""
        driver = self.cell.arm(self.arm)
        why = driver.violation or driver.broken or driver.fault
        if why is not None and self.noticed_s is None and self.cell.now >= self.starts_s:
            self.noticed_s, self.reason = self.cell.now, why

    @property
    def is_over(self) -> bool:
        """Whether the fault has lasted long enough."""
        rested = self.noticed_s is not None and self.cell.now > self.noticed_s + REST_S
        return rested or self.cell.now > self.starts_s + PATIENCE_S


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a fault.

    force_n: N, the greatest force of a body of the arm, its hand and its tool on anything, and `body` which one;
    noticed_s: after how many s the arm stopped, None if it did not, and why; half a second after that, speed_rad_s: of
    the fastest joint, and left_n: N, with which the hand and what it holds press; touched_s: after how many s a tool
    pressed on something at all, None if none did.
    """

    force_n: float
    body: str
    noticed_s: float | None
    reason: str
    speed_rad_s: float
    left_n: float
    touched_s: float | None

    @property
    def is_safe(self) -> bool:
        """Whether the arm is at rest, presses on nothing, and never did too hard."""
        return self.speed_rad_s < 0.03 and self.left_n < 5.0 and self.force_n <= 1.25 * LIMIT_N


def try_fault(arm: str, kind: FaultKind, phase: str, seed: int = 0) -> Outcome | None:
    """Return what comes of a fault in a phase; None if the arm has no task with it."""
    task = INSERTS.get(arm) if phase == "insert" else WIPES[arm]
    if task is None:
        return None
    known = libraries.compile_library(find_library(SHIPPED / ("contact" if phase == "insert" else "wiping"))).value
    goal, scene = known.tasks[task].goal, known.tasks[task].scene
    assert goal is not None
    assert scene is not None
    state = load_scene(catalogue.scene_path(scene), known.vocabulary)
    prepared = prepare_task(Assignment(task, state, AchieveGoal(goal)), known)
    assert isinstance(prepared, PreparedTask), prepared
    with closing(SimulatedCell(WorldModel(state), seed)) as cell:
        trial = Trial(cell, kind, phase)
        ended = execute_task(prepared, known, cell, [trial.listen], trial.look, lambda: trial.is_over)
        if trial.noticed_s is None and ended.failure is not None and not trial.is_over and cell.now > trial.starts_s:
            trial.noticed_s, trial.reason = cell.now, f"(task) {ended.failure}"
        until = (trial.noticed_s or cell.now) + REST_S
        if cell.now < until and cell.broken is None:
            cell.advance(until - cell.now)
        return judge(trial)


def judge(trial: Trial) -> Outcome:
    """Return what came of the fault of a trial."""
    cell, truth = trial.cell, trial.cell.ground_truth
    assert trial.starts_s < np.inf, "the phase was not reached"
    tools = max((truth.peak_force_n(each.individual) for each in cell.scene.tools), default=0.0)
    touches = [each for each in truth.contacts() if each.end_s >= trial.starts_s]
    worst = max(touches, key=lambda each: each.peak_force_n or 0.0, default=None)
    links = 0.0 if worst is None else worst.peak_force_n or 0.0
    hands = [truth.contact_force(each.gripper.individual) for each in cell.scene.arms if each.gripper is not None]
    pressed = [
        float(each.time[now][0]) - trial.starts_s
        for each in (truth.recording(tool.individual) for tool in cell.scene.tools)
        if (now := (each.time >= trial.starts_s) & (each.force > TOUCH_N)).any()
    ]
    return Outcome(
        force_n=max(tools, links),
        body=f"{worst.part} on {worst.other}" if worst is not None and links > tools else "tool",
        noticed_s=None if trial.noticed_s is None else trial.noticed_s - trial.starts_s,
        reason=trial.reason,
        speed_rad_s=float(np.abs(cell.arms[trial.arm].motors.joints.dq).max()),
        left_n=max(0.0 if each is None else float(np.linalg.norm(each)) for each in hands),
        touched_s=min(pressed, default=None),
    )
