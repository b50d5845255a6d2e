"""A plan that goes on after a failure keeps the postures with which it was looked at, and is not said to be checked."""

from __future__ import annotations

from msgspec.structs import replace

from plans.depot import Depot, goal, iri, library, world
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.conclusion import continue_plan
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.space_claim import ChosenPosture, SpaceClaim
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledPose
from skillc_runtime.world.state.model import WorldModel

POSTURE = ChosenPosture(
    1, LabelledIri(iri("carl"), "carl"), (0.1, 0.2), LabelledPose((0.4, 0.0, 0.8), (0.0, 1.0, 0.0, 0.0))
)


def test_the_rest_of_a_plan_has_its_postures() -> None:
    state = world({"carl": "a"}, {"crate-1": "a"})
    assignment = Assignment("carry", state, AchieveGoal(goal("lab:b contain lab:crate-1", state)))
    prepared = prepare_task(assignment, library())
    assert isinstance(prepared, PreparedTask) and prepared.planned is not None
    steps = len(prepared.planned.steps)
    prepared = replace(prepared, space=SpaceClaim(checked=steps, steps=steps, postures=(POSTURE,)))
    depot = Depot(WorldModel(state), fails=lambda step, number: step.startswith("carl crate-1"))
    ended = execute_task(prepared, library(), depot)  # type: ignore[arg-type]
    first = ended.attempts[0]
    assert first.steps_with_status("failure")
    rest = continue_plan(first, library(), depot.world.snapshot()).space
    assert rest is not None and rest.postures == (POSTURE,)
    assert rest.summary == "not checked in space: it goes on after a failure"
