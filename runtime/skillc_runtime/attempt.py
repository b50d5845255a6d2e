"""One run of a body in a cell, from its first tick until everything rests."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.assignment import Assignment, Planned, Prepared, Reach
from skillc_runtime.planning.plan import describe_quality
from skillc_runtime.plans.failures import Failures
from skillc_runtime.plans.progress import doubt, progress
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.trace.events import Listener, Note, PlanMade, PlanStep
from skillc_runtime.trace.failure import Failure
from skillc_runtime.trace.listeners import Listeners
from skillc_runtime.trace.outcome import Outcome
from skillc_runtime.tree.run import Run
from skillc_runtime.verifying import Claim
from skillc_runtime.world.state.world_state import WorldState

TICK_S = 0.01
"""The tree ticks at 100 Hz of the cell's time, between ten control periods each."""

SETTLE_S = 5.0
"""After the end everything that moves gets this long to come to rest and to let go of what it pushed."""


@dataclass(frozen=True, slots=True)
class Setting:
    """Where bodies run and who looks on.

    `watch` is called after every tick; when `interrupted` becomes true everything is halted. `failures` collects the
    steps of plans that fail.
    """

    library: SkillLibrary
    cell: SimulatedCell
    listeners: Sequence[Listener]
    watch: Callable[[], None]
    interrupted: Callable[[], bool]
    failures: Failures


@dataclass(frozen=True, slots=True)
class Attempt:
    """One run of a body: how it ended, its tree and the number of its last node.

    `doubt` says why it was halted for a new plan. `claims` are the posts of its outermost calls that succeeded.
    """

    prepared: Prepared
    status: Status
    failure: Failure | None
    tree: Outcome
    last_node: int
    doubt: str | None
    claims: tuple[Claim, ...] = ()

    @property
    def why(self) -> str:
        """Why another plan may be wanted, in words."""
        if self.doubt is not None:
            return f"the plan no longer leads to the goal: {self.doubt}"
        return self.failure.message if self.failure else "the goal does not hold after the plan"


def attempt(prepared: Prepared, setting: Setting, nodes_before: int) -> Attempt:
    """Run a body to its end, or until the world makes its plan pointless; then let everything come to rest."""
    cell = setting.cell
    _tell_plan(prepared, setting)
    failures = None if prepared.planned is None else setting.failures
    run = Run(prepared.body, setting.library, cell, setting.listeners, None, nodes_before, failures)
    try:
        why = _until_over(run, prepared, setting)
    finally:
        run.halt("the program ends")
        _tell_left(cell.secure(), setting)
    _settle(cell, run)
    run.look_again()
    return Attempt(prepared, run.status, run.failure, run.outcome, run.last_node, why, run.claims)


def _until_over(run: Run, prepared: Prepared, setting: Setting) -> str | None:
    """Tick until the run has ended; return why its plan was given up, if it was."""
    cell, why = setting.cell, None
    seen = cell.world.snapshot()
    while run.tick() is Status.RUNNING:
        if cell.world.snapshot() is not seen:
            seen = cell.world.snapshot()
            why = _doubt(run, prepared, setting.library, seen)
        if setting.interrupted():
            run.halt("interrupted")
        elif why is not None:
            run.halt(f"the plan no longer leads to the goal: {why}")
        else:
            _advance(cell, TICK_S, run)
            setting.watch()
    return why


def _tell_left(left: Sequence[str], setting: Setting) -> None:
    """Tell what the end of the run had to put right."""
    tell = Listeners(setting.listeners)
    for message in left:
        tell(Note(time=setting.cell.now, message=message))


def _tell_plan(prepared: Prepared, setting: Setting) -> None:
    if prepared.planned is None:
        return
    solved, skills = prepared.planned.solved, setting.library.skills
    steps = tuple(
        PlanStep(skill=step.skill, arguments=step.arguments, source=skills[step.skill].source)
        for step in solved.plan.steps
    )
    now, cost = setting.cell.now, solved.plan.duration_s
    short = setting.library.vocabulary.short
    names = {iri: short(iri) for step in steps for iri in step.arguments.values()}
    made = PlanMade(
        time=now,
        planner=solved.planner,
        optimal=solved.optimal,
        cost=cost,
        steps=steps,
        names=names,
        quality=describe_quality(solved.optimal, solved.left_out, solved.at_least_s),
    )
    Listeners(setting.listeners)(made)


def _doubt(run: Run, prepared: Prepared, library: SkillLibrary, state: WorldState) -> str | None:
    match prepared:
        case Prepared(Assignment(aim=Reach(goal)), planned=Planned(steps=steps)):
            return doubt(progress(steps, run.outcome), goal, library, state)
        case _:
            return None


def _settle(cell: SimulatedCell, run: Run) -> None:
    for _ in range(round(SETTLE_S / TICK_S)):
        if cell.at_rest:
            return
        _advance(cell, TICK_S, run)


def _advance(cell: SimulatedCell, seconds: float, run: Run) -> None:
    """Let time pass; whatever breaks in the cell fails the run, which halts everything that runs."""
    try:
        cell.advance(seconds)
    except Exception as error:  # noqa: BLE001  the task's boundary: it reports, halts and ends
        run.abort(error)
