"""What a task may claim: what a device told is verified, what nothing looked at is not, what a device denies fails."""

import pytest

from claims.bench import Bench, Hand, iri, run, world
from skillc_runtime.motion.pose import Pose
from skillc_runtime.recording.events import Event, TaskEnded, WorldChanged
from skillc_runtime.recording.known_facts import KnownFact
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN, IS_CLEAN


def bench(clean: bool = False) -> Bench:
    return Bench(WorldModel(world(clean)))


def how(facts: tuple[KnownFact, ...]) -> dict[str, str]:
    return {format_fact(fact.fact): f"{fact.known} by {fact.by}".removesuffix(" by ") for fact in facts}


@pytest.mark.parametrize(
    ("aim", "verified", "facts"),
    [
        ("goal lab:box contain lab:part", False, {"lab:box contain lab:part": "assumed by Put"}),
        ("goal not lab:tray contain lab:part", True, {"not lab:tray contain lab:part": "sensed by Take"}),
        ("goal lab:gripper contain lab:part", True, {"lab:gripper contain lab:part": "sensed by Take"}),
        ("goal lab:tray contain lab:part", True, {"lab:tray contain lab:part": "given"}),
        (
            "Put(part: lab:part, to: lab:box)",
            False,
            {"lab:box contain lab:part": "assumed by Put", "not lab:tray contain lab:part": "assumed by Put"},
        ),
        (
            "PutAndLook(part: lab:part, to: lab:box)",
            True,
            {"lab:box contain lab:part": "sensed by Look"},
        ),
        ("Measure(surface: lab:table)", True, {"lab:table.isClean == true": "sensed by Measure"}),
        (
            "Both(part: lab:part, to: lab:box, surface: lab:table)",
            False,
            {
                "lab:box contain lab:part": "assumed by Both: apply put",
                "lab:table.isClean == true": "sensed by Measure",
            },
        ),
        ("Wave(robot: lab:robot)", True, {}),
    ],
)
def test_a_task_is_verified_when_nothing_it_rests_on_is_only_assumed(
    aim: str, verified: bool, facts: dict[str, str]
) -> None:
    execution = run(aim, bench())
    assert execution.status == "succeeded", execution.failure
    assert how(execution.facts) == facts
    assert execution.verified is verified


def test_the_events_say_how_each_fact_is_known() -> None:
    events: list[Event] = []
    run("PutAndLook(part: lab:part, to: lab:box)", bench(), events)
    told = [(event.known, format_fact(event.changes[-1])) for event in events if isinstance(event, WorldChanged)]
    assert told == [("assumed", "lab:box contain lab:part"), ("sensed", "lab:box contain lab:part")]
    (ended,) = [event for event in events if isinstance(event, TaskEnded)]
    assert ended.verified is True and how(ended.facts) == {"lab:box contain lab:part": "sensed by Look"}


@pytest.mark.parametrize(
    ("call", "clean", "words"),
    [
        (
            "Pretend[blind](surface: lab:table)",
            True,
            "nothing has sensed it since the skill started: `lab:table",
        ),
        (
            "Pretend[written](surface: lab:table)",
            False,
            "must be sensed, but `lab:table.isClean == true` was assumed",
        ),
        ("LookOnce(surface: lab:table)", True, "`lab:table.isClean == true` was so before"),
    ],
)
def test_a_sensed_post_that_nothing_sensed_fails(call: str, clean: bool, words: str) -> None:
    there = bench(clean)
    execution = run(call, there)
    assert execution.status == "failed"
    assert execution.failure is not None and execution.failure.kind == "post"
    assert words in execution.failure.message


@pytest.mark.parametrize(
    ("call", "words"),
    [
        ("Find[blind](surface: lab:table)", "Find succeeded, and none of its outcomes came true, where one has to"),
        ("Find[written](surface: lab:table)", "`surface.located == true` must be sensed, but"),
    ],
)
def test_an_outcome_that_nothing_sensed_fails(call: str, words: str) -> None:
    execution = run(call, bench())
    assert execution.status == "failed" and execution.failure is not None and execution.failure.kind == "post"
    assert words in execution.failure.message


@pytest.mark.parametrize(
    ("call", "facts"),
    [
        ("Find[camera](surface: lab:table)", {"lab:table.located == true": "sensed by Find"}),
        ("Find[told](surface: lab:table)", {"lab:table.located == false": "sensed by Find"}),
        ("Question(surface: lab:table)", {"lab:table.located == true": "reported by Question"}),
    ],
)
def test_an_outcome_that_was_sensed_or_told_is_claimed(call: str, facts: dict[str, str]) -> None:
    execution = run(call, bench())
    assert execution.status == "succeeded", execution.failure
    assert execution.verified is True and how(execution.facts) == facts


def test_a_default_that_is_no_outcome_is_refused() -> None:
    execution = run('Question(surface: lab:table, default: "perhaps")', bench())
    assert execution.failure is not None and '"perhaps" is none of there, gone' in execution.failure.message


def test_who_looks_when_it_must_is_believed() -> None:
    assert run("LookOnce(surface: lab:table)", bench(clean=False)).verified is True


def test_what_was_sensed_for_a_scope_is_taken_back_with_it() -> None:
    there = bench()
    assert run("Scoped(surface: lab:table, robot: lab:robot)", there).status == "succeeded"
    assert there.world.snapshot().value(iri("table"), IS_CLEAN) is False


def loses(there: Bench) -> None:
    there.hand.holding = None


def test_a_gripper_that_loses_what_it_holds_fails_the_run_and_the_fact_is_withdrawn() -> None:
    there = bench()
    there.meanwhile[0.8] = loses
    execution = run("Take(gripper: lab:gripper, part: lab:part)", there)
    assert execution.status == "failed", "although the call had succeeded: it is looked at the end again"
    assert execution.failure is not None and execution.failure.kind == "contradiction"
    assert execution.failure.message == (
        "lab:gripper reports that it holds nothing, but the world model said "
        "`lab:gripper contain lab:part` (sensed by Take)"
    )
    assert not there.world.snapshot().holds(iri("gripper"), CONTAIN, iri("part"))


def test_a_plan_ends_where_a_device_contradicts_it() -> None:
    there = bench()
    there.meanwhile[0.6] = loses
    execution = run("goal lab:gripper contain lab:part and lab:robot at lab:shelf", there)
    assert execution.status == "failed" and execution.verified is None
    assert execution.failure is not None and "reports that it holds nothing" in execution.failure.message


def test_who_only_believes_to_hold_something_is_contradicted_by_the_hand() -> None:
    execution = run("Believe(gripper: lab:gripper, part: lab:part)", bench())
    assert execution.status == "failed" and execution.failure is not None
    assert "(assumed by Believe)" in execution.failure.message


def test_a_scene_that_the_hand_contradicts_fails_at_once() -> None:
    given = world().with_changes([AddRelation(iri("gripper"), CONTAIN, iri("part"))])
    there = Bench(WorldModel(given), hand=Hand())
    execution = run("Wave(robot: lab:robot)", there)
    assert execution.failure is not None and execution.failure.kind == "contradiction"
    assert "(given)" in execution.failure.message


@pytest.mark.parametrize(("x", "status"), [(2.05, "succeeded"), (1.5, "failed")])
def test_a_base_that_stands_elsewhere_contradicts_that_it_arrived(x: float, status: str) -> None:
    there = bench()
    there.wheels.pose = Pose.of((x, 0.0, 0.0))
    execution = run("Go(robot: lab:robot, to: lab:shelf)", there)
    assert execution.status == status
    if execution.failure is not None:
        assert execution.failure.message == (
            "lab:robot reports that it stands 0.50 m away from lab:shelf, but the world model said "
            "`lab:robot at lab:shelf` (assumed by Go)"
        )
