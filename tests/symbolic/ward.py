"""A library of pure logistics, whose scene states no pose, no size and no data sheet."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from skillc.services.library import libraries
from skillc.services.library.files import find_library
from skillc_model.declared import act_as_declared
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.symbolic.cell import SymbolicCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.events import Listener
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

TERMS = """use skiros, skillc

class Ward < Location
class Cart < MobileRobot
class Tray < Product
property isWarm(Tray): Bool
property fill(Tray): Number

## Take `tray` to `to`.
skill Carry {
    in    cart: Cart
    in    tray: Tray
    in    to:   Ward
    infer from: Ward
    pre   there: from contain tray
    pre   here:  cart at from
    pre   away:  not from == to
    hold  ready: cart.deviceState != Fault
    post  to contain tray
    post  not from contain tray
    post  cart at to
    post  not cart at from
    duration 20 s
    uses cart
}

impl by_itself of Carry { run python "skillc.primitives:StandIn" }

## Drive to `to`.
skill Go {
    in    cart: Cart
    in    to:   Ward
    infer from: Ward
    pre   here: cart at from
    pre   away: not from == to
    post  cart at to
    post  not cart at from
    duration 10 s
    uses cart
}

## Feel how warm and how full a tray is.
skill Feel {
    in   tray:  Tray
    out  found: Ward
    post sensed warm: tray.isWarm == true
    post sensed full: tray has fill
    post sensed at:   found contain tray
    duration 1 s
    noplan
}

skill Hum {
    in cart: Cart
    endless
    noplan
}
"""

SCENE = """@prefix lab:    <http://example.org/lab#> .
@prefix ward:   <https://w3id.org/skillc/library/ward#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

lab:Scene-1 a skiros:Scene ; skiros:contain lab:Ward-1, lab:Ward-2, lab:Kitchen .
lab:Ward-1 a ward:Ward ; skiros:contain lab:Tray-1 .
lab:Ward-2 a ward:Ward ; skiros:contain lab:Tray-2 .
lab:Kitchen a ward:Ward .
lab:Tray-1 a ward:Tray .
lab:Tray-2 a ward:Tray .
lab:Cart-1 a ward:Cart ; skiros:at lab:Ward-1 ; skillc:deviceState "Idle" .
"""

TASKS = """use skiros
import "terms.skill"
prefix lab: <http://example.org/lab#>

task deliver {
    scene "ward.ttl"
    goal  lab:Kitchen contain lab:Tray-1 and lab:Kitchen contain lab:Tray-2
}
"""


def write_ward(folder: Path, more: str = "") -> Path:
    """Write the library into the folder `ward` there, with `more` after its tasks; return its folder."""
    ward = folder / "ward"
    ward.mkdir(parents=True, exist_ok=True)
    for name, text in (("terms.skill", TERMS), ("ward.ttl", SCENE), ("tasks.skill", TASKS + more)):
        (ward / name).write_text(text, encoding="utf-8")
    return ward


def compile_ward(folder: Path, more: str = "") -> SkillLibrary:
    """Return the compiled library as symbolic cells run it."""
    outcome = libraries.compile_library(find_library(write_ward(folder, more)))
    assert outcome.ok, outcome.diagnostics
    return act_as_declared(outcome.value)


def run_body(
    folder: Path,
    body: str,
    listeners: Sequence[Listener] = (),
    after_tick: Callable[[SymbolicCell], None] = lambda cell: None,
) -> Execution[SymbolicCell]:
    """Run the body of a task in a symbolic cell; `after_tick` is called with the cell whenever time has passed."""
    library = compile_ward(folder, f'\ntask here {{\n    scene "ward.ttl"\n    do {body}\n}}\n')
    return run_in_cell(library, "here", folder / "ward" / "ward.ttl", listeners, after_tick)


def run_in_cell(
    library: SkillLibrary,
    task: str,
    scene: Path,
    listeners: Sequence[Listener] = (),
    after_tick: Callable[[SymbolicCell], None] = lambda cell: None,
) -> Execution[SymbolicCell]:
    """Run a task of a library in a symbolic cell."""
    found, state = library.tasks[task], load_scene(scene, library.vocabulary)
    if found.goal is not None:
        objective: AchieveGoal | ExecuteBody = AchieveGoal(found.goal)
    else:
        assert found.body is not None
        objective = ExecuteBody(found.body)
    prepared = prepare_task(Assignment(task, state, objective), library)
    assert isinstance(prepared, PreparedTask), prepared
    cell = SymbolicCell(WorldModel(state))
    return execute_task(prepared, library, cell, listeners, lambda: after_tick(cell))
