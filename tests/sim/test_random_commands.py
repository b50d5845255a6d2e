"""Random requests at random ticks through wiping with both arms; some of the runs are repeated from their events.

SKILLC_WIPINGS sets how many runs there are.
"""

from __future__ import annotations

import os
from collections import Counter
from functools import cache
from random import Random

import pytest

from execution.loops import LatePlanner
from execution.random_runs import OTHERS, STEPS, Ran, check_end, drive
from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.repeat import repeat_run
from skillc_runtime.execution.tree.gate import AtSkill, Gate
from skillc_runtime.recording import commands
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.events import NodeEnded, NodeStarted, Paused
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import AT
from skillc_runtime.world.state.world_state import WorldState

pytestmark = pytest.mark.sim

LAB = "http://example.org/lab#"
RUNS = int(os.environ.get("SKILLC_WIPINGS", "4"))
TASKS = ("clean_table", "clean_whiteboard")
MOST_TICKS = 2500
START_OF_WIPING = 1050
"""The tick at which the fixed arm has fetched its tool."""


@cache
def library() -> SkillLibrary:
    outcome = libraries.compile_library(find_library(SHIPPED / "wiping"))
    assert outcome.ok
    return outcome.value


@cache
def at_its_tool(task: str) -> WorldState:
    """Return the scene of a task; the mobile robot is where its tool is, and need not drive there."""
    found = library().tasks[task].scene
    assert found is not None
    state = load_scene(catalogue.scene_path(found), library().vocabulary)
    moved = [AddRelation(LAB + "Heron-1", AT, LAB + "Store")] if task == "clean_whiteboard" else []
    return state.with_changes(moved)


PAUSED = frozenset({0, 1, 2, 6})
"""The numbers below eight of the runs that are paused while they wipe."""


def count_pauses_while_wiping(ran: Ran) -> int:
    """Return how often a run was paused while it wiped."""
    wiping, found = False, 0
    for event in ran.watched.events:
        match event:
            case NodeStarted(name="Wipe", kind="call"):
                wiping = True
            case NodeEnded() if event.name.startswith("Wipe"):
                wiping = False
            case Paused():
                found += wiping
    return found


def draw_requests(random: Random) -> list[tuple[int, Command]]:
    """Return pauses of random lengths, and other requests in between."""
    found: list[tuple[int, Command]] = []
    tick = random.choice((0, START_OF_WIPING))
    for _ in range(random.randint(1, 5)):
        tick += random.randint(1, 600)
        found.append((tick, commands.PauseRun()))
        tick += random.choice((1, 20, 100, 350))
        found.append((tick, random.choice((commands.Resume(), commands.Resume(), *STEPS, commands.Replan()))))
        if random.random() < 0.3:
            found.append((tick + random.randint(0, 50), random.choice(OTHERS)))
    return sorted(found, key=lambda one: one[0])


def run(number: int) -> Ran:
    random, task = Random(number), TASKS[number % 2]
    goal = library().tasks[task].goal
    assert goal is not None
    cell = SimulatedCell(WorldModel(at_its_tool(task)), number)
    ran = Ran(None, cell, [], Counter())  # type: ignore[arg-type]
    loop = CellLoop(cell, library(), LatePlanner(library(), [random.randint(0, 3)]))
    settings = RunSpec(ask_after_failure=random.random() < 0.5, deadline_s=random.choice((None, None, 15.0)))
    gate = Gate([AtSkill("Wipe")] if random.random() < 0.3 else [])
    assignment = Assignment(task, cell.world.snapshot(), AchieveGoal(goal))
    drive(ran, loop, assignment, settings, gate, draw_requests(random), MOST_TICKS)
    return ran


@pytest.mark.parametrize("number", range(RUNS))
def test_whatever_is_requested_while_an_arm_wipes_ends_in_order(number: int) -> None:
    ran = run(number)
    check_end(ran)
    assert number not in PAUSED or count_pauses_while_wiping(ran) > 0
    if number % 10 < 2:
        again = SimulatedCell(WorldModel(at_its_tool(TASKS[number % 2])), number)
        repetition = repeat_run(ran.watched.events, library(), again)
        assert repetition.difference is None, str(repetition.difference)
