"""What `skillc why` says about picking in the depot: choices, bindings, what found no value, what failed."""

from __future__ import annotations

import pytest
from msgspec import structs

from selection.library import call, library, scene
from skillc.services.recording.story_text import format_answer, format_overview
from skillc_model.conditions import Individual
from skillc_runtime.recording.history.history import RunHistory
from skillc_runtime.recording.history.question import QuestionError, select_calls
from skillc_runtime.world.state.changes import Change, RemoveRelation
from why.stories import in_world
from world.lab import fact, individual, iri

PICKING = library()
PICK_SKILL = structs.replace(PICKING.skills["Pick"], parameters=PICKING.implementations["Pick.from_above"].parameters)
LIBRARY = structs.replace(PICKING, skills={**PICKING.skills, "Pick": PICK_SKILL})
PICK = call("Pick", arm=Individual(iri("arm")), object=Individual(iri("eraser")))


def picked(*changes: Change) -> RunHistory:
    """Return the story of picking the eraser in the changed depot."""
    return in_world(PICK, LIBRARY, scene(*changes))


def told(story: RunHistory, question: str) -> str:
    """Return the answer to a question."""
    return format_answer(select_calls(story, question))


def test_the_overview_numbers_the_steps_and_says_what_led_to_the_failure() -> None:
    lines = format_overview(picked(), "out").splitlines()
    assert lines[0].startswith("play: failed after 0.0 s")
    assert lines[1].split()[:3] == ["1", "Pick[from_above]", "failure"]
    assert lines[2].strip() == "arm: t:arm, object: t:eraser, gripper: t:gripper, from: t:shelf"
    why = lines.index(next(line for line in lines if line.startswith("why: ")))
    assert "gripper contain object" in lines[why]
    assert lines[why + 1] == "  in call Pick[from_above] (work.skill:20)"
    assert lines[-1].endswith("`skillc why out 1`")


def test_a_choice_is_told_with_what_was_rejected_and_what_was_not_tried() -> None:
    assert told(picked(), "1.1").splitlines()[1:] == [
        "  chosen: wsg (work.skill:5), the first in rank that fits",
        "  not tried, because they rank lower (less specific, less preferred, or declared later):",
        "    robotiq (work.skill:5): would not fit, `gripper` needs RobotiqGripper, t:gripper is a t:WsgGripper",
        "  parameters:",
        "    gripper = t:gripper  (passed by the caller: `gripper`, work.skill:20)",
    ]
    other = picked(
        RemoveRelation(iri("arm"), iri("hasGripper"), iri("gripper")),
        individual("grip", "RobotiqGripper"),
        fact("arm", "hasGripper", "grip"),
    )
    lines = told(other, "robotiq").splitlines()
    assert lines[1] == "  chosen: robotiq (work.skill:5), the first in rank that fits"
    assert lines[2:4] == [
        "  rejected:",
        "    wsg: `gripper` needs WsgGripper, t:grip is a t:RobotiqGripper (test.skill:1)",
    ]


def test_a_binding_is_told_with_the_conditions_and_facts_that_decided_it() -> None:
    assert told(picked(), "pick.GRIPPER").splitlines()[1:] == [
        "    gripper = t:gripper  (found in the world)",
        "      `arm hasA gripper` (work.skill:31)",
        "      `not gripper contain _` (work.skill:33)",
        "      t:arm hasA t:gripper",
        "      not t:gripper contain _",
    ]
    assert told(picked(), "1.arm").splitlines()[1:] == [
        "    arm = t:arm  (passed by the caller: `t:arm`, work.skill:20)"
    ]


def test_what_found_no_value_is_told_with_what_comes_nearest() -> None:
    changes = (
        RemoveRelation(iri("arm"), iri("hasGripper"), iri("gripper")),
        individual("arm-2", "Arm"),
        fact("arm-2", "hasGripper", "gripper"),
    )
    story = picked(*changes)
    lines = told(story, "gripper").splitlines()
    assert lines[1] == "    gripper has no value:"
    assert "no answer for `arm hasA gripper`: `t:arm hasA a t:Gripper` does not hold" in lines[2]
    assert "or gripper = t:gripper, but t:arm-2 hasA t:gripper; needed: t:arm hasA t:gripper" in lines[2]
    whole = told(story, "Pick")
    assert "  failed: no implementation is left" in whole.splitlines()
    assert whole.count("nearest") == 1


def test_ambiguous_candidates_are_all_listed() -> None:
    lines = told(picked(individual("g-2", "Gripper"), fact("arm", "hasA", "g-2")), "gripper").splitlines()
    assert "`gripper` may be t:g-2, t:gripper: pass it, or accept any with `infer any gripper`" in lines[2]


def test_a_failure_is_told_with_the_facts_at_that_moment() -> None:
    lines = told(picked(fact("gripper", "contain", "box")), "1").splitlines()
    place = lines.index("  facts at that moment:")
    assert "    t:gripper contain t:box" in lines[place:]
    assert "    t:arm hasA t:gripper" in lines[place:]


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("3", "there is no step 3; the steps are 1 to 1"),
        ("1.9", "there is no step 1.9; those in 1 are 1.1 to 1.2"),
        ("4.2", "there is no step 4; the steps are 1 to 1"),
        ("1.1.1", "no skill was called in step 1.1"),
        ("1.griper", "1 has no parameter `griper`; it has arm, object, gripper, from"),
        ("griper", "nothing in this run is called `griper`; did you mean `gripper`? "),
        ("", "nothing in this run is called ``; there are the skills Pick, Actuate, Hold"),
    ],
)
def test_a_question_about_nothing_is_told_what_there_is(question: str, answer: str) -> None:
    with pytest.raises(QuestionError) as raised:
        select_calls(picked(), question)
    assert str(raised.value).startswith(answer)
