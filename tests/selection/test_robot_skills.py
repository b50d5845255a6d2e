"""Which robots can do which skills by their hardware, and why others cannot."""

from __future__ import annotations

from functools import cache

import pytest

from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.selection.robot_skills import match_robots
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change
from skillc_runtime.world.state.world_state import WorldState

SKILLS = """
use skiros, rparts, cora, skillc

skill Squeeze { in gripper: GripperEffector  noplan }
impl three of Squeeze { refine gripper: ThreeFingerGripper  do seq { wait 1 s } }

skill Crush {
    in    arm:     ArmDevice
    in    thing:   Product
    infer gripper: GripperEffector
    pre   mounted: arm hasA gripper
    noplan
}
impl squeezed of Crush { do seq { Squeeze(gripper) } }

skill Lift { in left: ArmDevice  in right: ArmDevice  pre not left == right  noplan }
impl both of Lift { do seq { wait 1 s } }

skill Release { in arm: ArmDevice  in gripper: GripperEffector  noplan }
impl opened of Release { do seq { wait 1 s } }

skill Look { in camera: Camera  noplan }
impl still of Look { do seq { wait 1 s } }

skill Drive { in robot: MobileRobot  noplan }
impl straight of Drive { do seq { wait 1 s } }

skill Ask { in text: Text  noplan }
impl aloud of Ask { do seq { wait 1 s } }
"""
NS, SKILLC = "http://example.org/t#", "https://w3id.org/skillc/core#"
FINGERS = ("A FixedRobot", "A-arm Iiwa14", "A-hand RobotiqGripper", "A hasArm A-arm", "A-arm hasGripper A-hand")
PLAIN = ("B MobileRobot", "B-arm Ur5e", "B-hand WsgGripper", "B hasArm B-arm", "B-arm hasGripper B-hand")
BARE = ("C MobileRobot", "C-left Panda", "C-right Panda", "C hasArm C-left", "C hasArm C-right")
CAMERA = ("Eye Camera",)


@cache
def library() -> SkillLibrary:
    """Compile the skills."""
    outcome = compile([Source("own.skill", SKILLS)], load_vocabulary(), {}, "own")
    assert outcome.ok, [each for each in outcome.diagnostics if each.severity == "error"]
    return outcome.value


def matched(*facts: str) -> dict[str, str]:
    """Return why robots do not fit implementations, empty for those that do, by `ROBOT SKILL`."""
    state = WorldState.empty(library().vocabulary).with_changes([change(each) for each in facts])
    found = match_robots(library(), state)
    return {f"{each.robot.removeprefix(NS)} {each.implementation.skill}": each.why_not for each in found}


def change(fact: str) -> Change:
    """Return the change that states `INDIVIDUAL CLASS` or `INDIVIDUAL RELATION INDIVIDUAL`."""
    match fact.split():
        case [one, cls]:
            return AddIndividual(NS + one, (SKILLC + cls,))
        case [one, relation, other]:
            return AddRelation(NS + one, SKILLC + relation, NS + other)
    raise ValueError(fact)


@pytest.mark.parametrize(
    ("facts", "able"),
    [
        (FINGERS, {"A Squeeze", "A Crush", "A Release", "A Ask"}),
        (PLAIN, {"B Drive", "B Release", "B Ask"}),
        (BARE, {"C Drive", "C Lift", "C Ask"}),
        (
            FINGERS + PLAIN,
            {"A Squeeze", "A Crush", "A Release", "A Ask", "A Lift", "B Lift", "B Drive", "B Release", "B Ask"},
        ),
        (PLAIN + BARE, {"B Lift", "B Drive", "B Release", "B Ask", "C Drive", "C Lift", "C Ask"}),
        (FINGERS + CAMERA, {"A Squeeze", "A Crush", "A Release", "A Ask", "A Look"}),
    ],
)
def test_a_robot_can_do_what_its_devices_fit(facts: tuple[str, ...], able: set[str]) -> None:
    assert {each for each, why_not in matched(*facts).items() if not why_not} == able


def test_why_it_cannot_is_what_a_call_would_be_refused_for() -> None:
    why = {each: text.replace(NS, "") for each, text in matched(*PLAIN).items()}
    refused = "`gripper` needs ThreeFingerGripper, B-hand is a skillc:WsgGripper"
    assert why["B Squeeze"] == refused
    assert why["B Crush"] == f"Squeeze: {refused}"
    assert why["B Look"] == "`camera` needs a skillc:Camera, and B neither is nor has one"
    assert "not left == right" in why["B Lift"]
