"""Plans are followed while they lead to the goal, side by side where they can be, and replaced when they do not."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec import structs

from plans.depot import CONTAIN, LAB, Depot, carried_out, contain, iri, library, world
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import Event, NodeEnded, Replanned
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.failure_text import describe_failure, list_details
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import Change, RemoveIndividual, RemoveRelation, SetProperty
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import POSITION, SIZE

HERE = Pose(np.array([0.5, 0.0, 0.0]), np.eye(3))
SLIPPED = Failure(kind="body", message="it slipped")
MOVED = "lab:b contain lab:crate"


def one_robot() -> tuple[WorldModel, object]:
    state = world({"carl": "c"}, {"crate": "a"})
    return WorldModel(state), state


def test_robots_that_do_not_need_each_other_work_at_the_same_time() -> None:
    state = world({"carl": "c", "dora": "d"}, {"crate": "c", "box": "d"})
    depot = Depot(WorldModel(state))
    execution = carried_out("lab:a contain lab:crate and lab:b contain lab:box", state, depot)
    assert execution.status == "succeeded", execution.failure
    assert [step for step in depot.log if "carl" in step] == ["carl crate c", "carl c a", "carl crate a"]
    assert [step for step in depot.log if "dora" in step] == ["dora box d", "dora d b", "dora box b"]
    assert depot.now < 9.2, "two ways of 9 s each, side by side"


def test_a_thing_that_is_moved_away_meanwhile_is_looked_for_where_it_is_now() -> None:
    model, state = one_robot()
    depot = Depot(model, {2.0: lambda world: world.commit([contain("d", "crate")], "somebody")})
    events: list[Event] = []
    execution = carried_out(MOVED, state, depot, events)
    assert execution.status == "succeeded"
    assert len(execution.attempts) == 2 and execution.attempts[0].status is Status.HALTED
    (replanned,) = [event for event in events if isinstance(event, Replanned)]
    assert "Load is no longer possible" in replanned.reason and "contain" in replanned.reason
    assert depot.now < 2.0 + 5.0 + 2.0 + 5.0 + 2.0 + 0.2, "it does not drive on to the old place first"


def test_what_somebody_else_has_done_already_is_not_done_again() -> None:
    state = world({"carl": "c"}, {"crate": "a", "box": "a"})
    depot = Depot(WorldModel(state), {1.0: lambda world: world.commit([contain("b", "box")], "somebody")})
    execution = carried_out("lab:b contain lab:crate and lab:b contain lab:box", state, depot)
    assert execution.status == "succeeded"
    assert not any("box" in step for step in depot.log)


def test_a_goal_that_becomes_true_by_itself_ends_the_task() -> None:
    model, state = one_robot()
    depot = Depot(model, {1.0: lambda world: world.commit([contain("b", "crate")], "somebody")})
    execution = carried_out(MOVED, state, depot)
    assert execution.status == "succeeded" and execution.failure is None
    assert depot.now < 5.2 and not any("crate" in step for step in depot.log)


def test_a_step_that_failed_is_left_to_somebody_else() -> None:
    state = world({"carl": "a", "dora": "d"}, {"crate": "a"})
    depot = Depot(WorldModel(state), fails=lambda step, number: step.startswith("carl crate a"))
    execution = carried_out(MOVED, state, depot)
    assert execution.status == "succeeded"
    assert depot.log[0] == "carl crate a" and "dora crate a" in depot.log


def test_a_step_that_failed_is_done_in_another_way_where_there_is_one() -> None:
    model, state = one_robot()
    depot = Depot(model, fails=lambda step, number: "crate b" in step and number == 1)
    execution = carried_out(MOVED, state, depot)
    assert execution.status == "succeeded" and len(execution.attempts) == 2
    calls = [node.name for each in execution.attempts for node in each.tree.nodes() if node.kind == "call"]
    assert [name for name in calls if "Unload" in name] == ["Unload[lower]", "Unload[tilt]"]
    (call,) = (node for node in execution.last.tree.nodes() if node.name == "Unload[tilt]")
    assert [each.reason for each in call.rejected] == [
        "it has failed, and nothing that it depends on has changed since: carl crate b failed"
    ]


@pytest.mark.parametrize(("evidence", "status"), [("assumed", "failed"), ("sensed", "succeeded"), (None, "succeeded")])
def test_what_a_failed_step_assumed_on_the_way_does_not_reach_the_goal(evidence: Evidence | None, status: str) -> None:
    state = world({"carl": "c"}, {"crate": "c", "box": "a"})
    written = {8.0: lambda world: world.commit([contain("b", "crate")], "Release", evidence)}
    depot = Depot(WorldModel(state), written, fails=lambda step, number: step == "carl crate b")
    execution = carried_out(MOVED, state, depot)
    assert depot.log[-1] == "carl crate b" and len(execution.attempts) == 2
    assert execution.status == status
    if status == "failed":
        assert execution.failure is not None
        assert describe_failure(execution.failure) == (
            f"carl crate b failed; that `{iri('b')} contain {iri('crate')}` is only assumed: Unload has failed since"
        )


def test_what_is_written_after_a_step_has_failed_counts_again() -> None:
    state = world({"carl": "c"}, {"crate": "c", "box": "a"})
    written = {8.0: "Release", 12.0: "Push"}
    depot = Depot(
        WorldModel(state),
        {time: lambda world, by=by: world.commit([contain("b", "crate")], by) for time, by in written.items()},
        fails=lambda step, number: step == "carl crate b",
    )
    execution = carried_out("lab:b contain lab:crate and lab:b contain lab:box", state, depot)
    assert execution.status == "succeeded", execution.failure
    assert execution.verified is False


def test_a_step_that_succeeded_in_another_way_has_not_failed() -> None:
    failures, arguments = FailedSteps(library()), {"robot": iri("carl"), "crate": iri("crate"), "to": iri("b")}
    state = world({"carl": "c"}, {"crate": "a"})
    failures.add("Unload", arguments, "lower", state, SLIPPED, 0)
    assert [step.skill for step in failures.steps] == ["Unload"]
    failures.forget_call("Unload", {**arguments, "crate": iri("box")})
    assert [step.skill for step in failures.steps] == ["Unload"]
    failures.forget_call("Unload", arguments)
    assert failures.steps == ()


def test_a_step_that_can_only_fail_again_is_not_repeated() -> None:
    model, state = one_robot()
    depot = Depot(model, fails=lambda step, number: "crate a" in step)
    execution = carried_out(MOVED, state, depot)
    assert execution.status == "failed" and len(execution.attempts) == 1
    assert depot.log == ["carl c a", "carl crate a"]
    assert execution.failure is not None and execution.failure.kind == "plan"
    assert describe_failure(execution.failure) == "carl crate a failed; no other plan was found"
    details = list(list_details(execution.failure))
    assert details[-1] == "  all remaining alternatives have failed, and nothing that they depend on has changed"


def test_when_all_ways_have_failed_for_one_reason_it_is_said_once_and_each_way_is_a_detail() -> None:
    model, state = one_robot()
    depot = Depot(model, fails=lambda step, number: "crate b" in step)
    execution = carried_out(MOVED, state, depot)
    assert execution.status == "failed" and len(execution.attempts) == 2
    assert execution.failure is not None
    assert describe_failure(execution.failure) == "carl crate b failed; no other plan was found"
    details = "\n".join(list_details(execution.failure))
    assert all(f"Unload[{each}]: carl crate b failed (" in details for each in ("lower", "tilt"))


def test_a_step_that_failed_is_tried_again_after_a_change_of_what_it_depends_on() -> None:
    model, state = one_robot()
    away = {7.5: lambda world: world.commit([contain("d", "crate")], "somebody")}
    depot = Depot(model, away, fails=lambda step, number: "crate a" in step)
    execution = carried_out(MOVED, state, depot)
    assert execution.status == "failed" and depot.log == ["carl c a", "carl crate a"]
    away = {6.5: lambda world: world.commit([contain("d", "crate")], "somebody")}
    depot = Depot(WorldModel(state), away, fails=lambda step, number: "crate a" in step)
    execution = carried_out(MOVED, state, depot)
    assert execution.status == "succeeded" and "carl crate d" in depot.log


@pytest.mark.parametrize(("moved_m", "again"), [(1e-6, False), (1e-3, True)])
def test_a_measurement_that_is_repeated_is_no_reason_to_try_again(moved_m: float, again: bool) -> None:
    failures, arguments = FailedSteps(library()), {"robot": iri("carl"), "crate": iri("crate"), "to": iri("b")}
    state = world({"carl": "c"}, {"crate": "a"}).with_changes([SetProperty(iri("crate"), POSITION[0], 0.5)])
    failures.add("Unload", arguments, "lower", state, SLIPPED, 0)
    after = state.with_changes([SetProperty(iri("crate"), POSITION[0], 0.5 + moved_m)])
    assert (failures.find_repeated("Unload", arguments, "lower", after) is None) is again


@pytest.mark.parametrize(
    ("change", "again"),
    [
        (SetProperty(iri("crate"), POSITION[0], 0.502), False),
        (SetProperty(iri("crate"), POSITION[0], 0.52), True),
        (SetProperty(iri("crate"), SIZE[0], 0.7), False),
        (SetProperty(iri("box"), POSITION[1], 0.3), True),
        (contain("b", "box"), True),
    ],
)
def test_where_space_was_lacking_only_what_stands_elsewhere_is_a_reason_to_try_again(
    change: Change, again: bool
) -> None:
    failures, arguments = FailedSteps(library()), {"robot": iri("carl"), "crate": iri("crate"), "to": iri("b")}
    state = world({"carl": "c"}, {"crate": "a", "box": "d"}).with_changes(
        [
            *placement_changes(iri("crate"), Pose(np.array([0.5, 0.0, 0.0]), np.eye(3))),
            *placement_changes(iri("box"), HERE),
        ]
    )
    tried = Failure(kind="body", message="nothing goes", causes=(structs.replace(SLIPPED, kind="space"),) * 2)
    failures.add("Unload", arguments, "lower", state, tried, 0)
    assert failures.find_repeated("Unload", arguments, "lower", state) == tried
    assert (failures.find_repeated("Unload", arguments, "lower", state.with_changes([change])) is None) is again


def test_a_change_elsewhere_is_no_reason_to_try_again() -> None:
    state = world({"carl": "c"}, {"crate": "a", "box": "d"})
    elsewhere = {6.0: lambda world: world.commit([contain("b", "box")], "somebody")}
    depot = Depot(WorldModel(state), elsewhere, fails=lambda step, number: "crate a" in step)
    execution = carried_out(MOVED, state, depot)
    assert execution.status == "failed" and depot.log == ["carl c a", "carl crate a"]


def test_a_cell_that_breaks_ends_the_task_at_once() -> None:
    model, state = one_robot()

    def breaks(world: WorldModel) -> None:
        raise OSError("the line is dead")

    execution = carried_out(MOVED, state, Depot(model, {1.0: breaks}))
    assert execution.status == "failed" and len(execution.attempts) == 1
    assert execution.failure is not None and "the line is dead" in execution.failure.message


def test_a_goal_that_has_become_unreachable_is_told_with_the_reason() -> None:
    model, state = one_robot()
    depot = Depot(model, {1.0: lambda world: world.commit([RemoveIndividual(iri("crate"))], "somebody")})
    execution = carried_out(MOVED, state, depot)
    assert execution.status == "failed"
    assert execution.failure is not None and "lab:crate" in execution.failure.message.replace(LAB, "lab:")


def test_a_goal_that_holds_already_needs_no_step() -> None:
    state = world({"carl": "c"}, {"crate": "b"})
    depot = Depot(WorldModel(state))
    assert carried_out(MOVED, state, depot).status == "succeeded"
    assert depot.log == []


TURNED = "lab:crate.turned == true and lab:b contain lab:crate"


def test_what_a_running_step_undoes_for_a_moment_is_no_reason_for_another_plan() -> None:
    model, state = one_robot()
    execution = carried_out("lab:crate.turned == true and lab:carl contain lab:crate", state, Depot(model))
    assert execution.status == "succeeded", execution.failure
    assert len(execution.attempts) == 1


@pytest.mark.parametrize(
    ("who", "evidence", "where", "at_s"),
    [("meanwhile", "assumed", "d", 3.0), ("sensed", "sensed", "d", 3.0), ("sensed", "sensed", "a", 6.0)],
)
def test_what_comes_from_elsewhere_meanwhile_is_a_reason(who: str, evidence: Evidence, where: str, at_s: float) -> None:
    """While the crate stands for a moment, another one is not where it was; what is sensed where the step works waits.

    The step that works at the place `a` may yet undo what it has sensed there.
    """
    state = world({"carl": "a"}, {"crate": "a", "box": "a"})
    moved = contain("d", "box") if where == "d" else RemoveRelation(iri("a"), CONTAIN, iri("box"))
    depot = Depot(WorldModel(state), **{who: {3.0: lambda world: world.commit([moved], "somebody", evidence)}})
    events: list[Event] = []
    execution = carried_out(f"{TURNED} and lab:b contain lab:box", state, depot, events)
    assert execution.status == ("succeeded" if where == "d" else "failed"), execution.failure
    reason = execution.attempts[0].reason
    assert "Load is no longer possible" in reason and "box" in reason
    assert execution.attempts[0].status is Status.HALTED
    ends = [event.time for event in events if isinstance(event, NodeEnded) and event.status == "halted"]
    assert ends[0] == pytest.approx(at_s, abs=0.05)
