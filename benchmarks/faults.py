"""Falsifies the signals of arms in each phase of a task: what then presses on what, who notices it, and when.

`faults.py [ARM ...] [--kinds K,...] [--phases P,...]` prints a row for each fault, phase and arm: the greatest force of
any body of the arm, its hand and its tool on anything in N; after how many ms the arm stopped and for what reason; the
greatest speed of a joint half a second after that in rad/s, and the force that is left then in N.
"""

from __future__ import annotations

import argparse
from contextlib import closing
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from skillc.services import libraries
from skillc.services.library_files import SHIPPED, find_library
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.signal_faults import KINDS, WRENCH_KINDS, FaultKind, SignalFault
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask, prepare_task
from skillc_runtime.execution.execute import execute_task
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
PATIENCE_S: Final = 10.0
REST_S: Final = 0.5
"""Limit of the contact force; for how long a task goes on with a fault; when an arm that has stopped shall rest."""


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


def try_fault(task: str, kind: FaultKind, phase: str, seed: int = 0) -> str:
    """Return what happens, a row of the table."""
    library = libraries.compile_library(find_library(SHIPPED / ("contact" if task in INSERTS.values() else "wiping")))
    known = library.value
    goal, scene = known.tasks[task].goal, known.tasks[task].scene
    assert goal is not None
    assert scene is not None
    state = load_scene(catalogue.scene_path(scene), known.vocabulary)
    prepared = prepare_task(Assignment(task, state, AchieveGoal(goal)), known)
    assert isinstance(prepared, PreparedTask), prepared
    with closing(SimulatedCell(WorldModel(state), seed)) as cell:
        trial = Trial(cell, kind, phase)
        ended = execute_task(prepared, known, cell, [trial.listen], trial.look, lambda: trial.is_over)
        if trial.noticed_s is None and ended.failure is not None and cell.now > trial.starts_s:
            trial.noticed_s, trial.reason = cell.now, f"(task) {ended.failure}"
        until = (trial.noticed_s or cell.now) + REST_S
        if cell.now < until and cell.broken is None:
            cell.advance(until - cell.now)
        return describe(trial)


def describe(trial: Trial) -> str:
    """Return a row."""
    cell, truth = trial.cell, trial.cell.ground_truth
    if trial.starts_s == np.inf:
        return "the phase was not reached"
    tools = max((truth.peak_force_n(each.individual) for each in cell.scene.tools), default=0.0)
    touches = [each for each in truth.contacts() if each.end_s >= trial.starts_s]
    worst = max(touches, key=lambda each: each.peak_force_n or 0.0, default=None)
    links = 0.0 if worst is None else worst.peak_force_n or 0.0
    who = f"{worst.part} on {worst.other}" if worst is not None and links > tools else "tool"
    names = [each.gripper.individual for each in cell.scene.arms if each.gripper is not None]
    left = max(float(np.linalg.norm(truth.contact_force(each))) for each in names)
    speed = float(np.abs(cell.arms[trial.arm]._dq).max())
    noticed = "never" if trial.noticed_s is None else f"{1e3 * (trial.noticed_s - trial.starts_s):.0f} ms"
    ok = max(tools, links) <= 1.25 * LIMIT_N and speed < 0.03 and left < 5.0 and trial.noticed_s is not None
    mark = "ok " if ok else "BAD"
    return f"{mark} {max(tools, links):8.0f} N {who:40.40} {noticed:>8} {speed:7.3f} {left:6.1f} N  {trial.reason:.110}"


def main() -> None:
    """Print the rows that were asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("arms", nargs="*", default=[])
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--phases", default=",".join(PHASES))
    options = parser.parse_args()
    for arm in options.arms or WIPES:
        for phase in options.phases.split(","):
            task = INSERTS.get(arm) if phase == "insert" else WIPES[arm]
            for kind in options.kinds.split(",") if task else ():
                if kind not in WRENCH_KINDS or arm == "ur5e":
                    print(f"{arm:6} {phase:9} {kind:19} {try_fault(task, kind, phase)}", flush=True)


if __name__ == "__main__":
    main()
