"""A cell in which a post really stands that nobody knows of, and runs of a task in it."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from pathlib import Path

from msgspec.structs import replace

from refinement.two_arms import PREFIXES
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import load_task
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import Assignment, PreparedTask
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.execute import drive
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.preparation import Ready
from skillc_runtime.execution.refinement.run_planning import SpaceLook, measure_postures
from skillc_runtime.execution.task_planning import replan_task
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.events import Event
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.changes import RemoveIndividual
from skillc_runtime.world.state.model import WorldModel

POST, ARM = "http://example.org/lab#Post", "http://example.org/lab#Arm-1"
GOAL = RunSpec(library="std", goal="lab:Box-A contain lab:Part-A")
CELL = (
    PREFIXES
    + """
lab:Scene-1 a skiros:Scene ; skiros:contain lab:Cell .
lab:Cell a skillc:Workstation ; skillc:on lab:Scene-1 ;
    skiros:contain lab:Pedestal, lab:Table, lab:Box-A, lab:Part-A, lab:Post .
lab:Pedestal a skillc:Furniture ; skiros:SizeX 0.3 ; skiros:SizeY 0.3 ; skiros:SizeZ 0.6 ; skillc:on lab:Cell .
lab:Table a skillc:Furniture ; skiros:SizeX 0.6 ; skiros:SizeY 1.2 ; skiros:SizeZ 0.6 ;
    skillc:on lab:Cell ; skillc:atX 0.5 .
lab:Robot-1 a skillc:FixedRobot ; skiros:at lab:Cell ; skillc:hasArm lab:Arm-1 .
lab:Arm-1 a skillc:Panda ; skillc:hasSheet skillc:panda-sheet ; skiros:CompliantController "impedance" ;
    skillc:on lab:Pedestal ; skillc:deviceState "Idle" ; skillc:hasGripper lab:Hand-1 .
lab:Hand-1 a skillc:PandaHand ; skillc:hasSheet skillc:panda-hand-sheet ; skillc:deviceState "Idle" .
lab:Part-A a skiros:Product ; skiros:SizeX 0.04 ; skiros:SizeY 0.04 ; skiros:SizeZ 0.06 ; skiros:Weight 0.15 ;
    skillc:on lab:Table ; skillc:atX -0.05 ; skillc:atY -0.35 .
lab:Box-A a skiros:Container ; skiros:SizeX 0.16 ; skiros:SizeY 0.16 ; skiros:SizeZ 0.06 ;
    skillc:on lab:Table ; skillc:atX -0.05 ; skillc:atY 0.15 .
"""
)


@dataclass(frozen=True)
class RunWithPost:
    """A run that has ended, its events, the world after it, and how each of its plans was looked at."""

    run: TaskRun
    events: list[Event]
    world: WorldModel
    claims: list[str]


def run_with_post(
    folder: Path, height_m: float, x: float, y: float, physics: bool, bears_n: float = inf
) -> RunWithPost:
    """Put the part into the box; a post 6 cm thick stands on the table at x and y, in m from its middle.

    `bears_n`: the force on the tool beyond which the arm stops by itself, if it is less than that of its data sheet;
    somebody acknowledges such a stop, and it is tried again.
    """
    post = f"skiros:SizeX 0.06 ; skiros:SizeY 0.06 ; skiros:SizeZ {height_m} ; skillc:on lab:Table"
    (folder / "cell.ttl").write_text(
        f"{CELL}lab:Post a skillc:Furniture ; {post} ; skillc:atX {x} ; skillc:atY {y} .\n"
    )
    spec = RunSpec(library=GOAL.library, goal=GOAL.goal, scene=str(folder / "cell.ttl"))
    events, claims = list[Event](), list[str]()
    with load_task(spec, SilentReporter()) as task:
        world = WorldModel(task.assignment.state)
        cell = SimulatedCell(world) if physics else KinematicCell(world)
        world.commit([RemoveIndividual(POST)], "test", None)
        if isinstance(cell, SimulatedCell):
            safety = cell.arm(ARM)._safety
            safety.limits = replace(safety.limits, contact_force_n=min(bears_n, safety.limits.contact_force_n))

        def plan(assignment: Assignment, failures: FailedSteps) -> Ready:
            look = SpaceLook(measure_postures(cell) if claims else None)
            answer = replan_task(assignment, task.library, failures, look=look)
            known = isinstance(answer, PreparedTask) and answer.space is not None
            claims.append(answer.space.summary if known else "none")  # type: ignore[union-attr]
            return Ready(answer)

        loop = CellLoop(cell, task.library, plan)
        for _ in range(4):
            assignment = Assignment("put", world.snapshot(), task.assignment.objective)
            run = loop.submit(assignment, (events.append,), RunSpec())
            drive(loop, run)
            if cell.stops.report is None:
                break
            cell.stops.clear()
    return RunWithPost(run, events, world, claims)
