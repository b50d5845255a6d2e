"""The examples of the language's definition compile without errors against the shipped vocabulary."""

import pytest
from shipped import shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.position import Position
from skillc_dsl.source import Source
from skillc_model.conditions import Holds, Not, Retract
from skillc_model.properties import Runs
from skillc_model.skills import Compound, SkillLibrary
from skillc_model.tree import Call, Parallel, Sequence, With

HEADER = """
use skiros, rparts, wiping, skillc
prefix lab: <http://example.org/lab#>
"""
TERMS = """
class    Gripper < Tool
class    Whiteboard < Surface
class    Eraser < Tool  disjoint Gripper
relation contain(Location, Product)
relation contain(GripperEffector, Product)
relation at(Thing, Location)      functional
property normalForce(Surface): Force
property isClean(Surface): Bool
function lanes(surface: Surface, width: Length, overlap: Number) -> [Pose] = python "skillc_runtime.motion.lanes:lanes"
"""
PICK = """
## Take `object` out of its location. The gripper, the location and the poses are looked up in the world model.
skill Pick {
    in       arm:      ArmDevice
    in       object:   Product
    infer    gripper:  GripperEffector
    infer    from:     Location
    infer    approach: ApproachPose
    infer    grasp:    GraspingPose
    opt      speed:    Speed = 0.25 m/s  range 0.01 m/s .. 0.5 m/s

    pre      mounted:  arm hasA gripper
    pre      there:    from contain object
    pre      object hasA approach
    pre      object hasA grasp
    pre      empty:    not gripper contain _
    hold     ready:    arm.deviceState != Fault
    post     held:     gripper contain object
    post     gone:     not from contain object
    duration 8 s
}
"""
WIPE = """
import "motion.skill"
import "compliance.skill"
import "overlay.skill"
import "inspection.skill"

function corner(surface: Surface, number: Int) -> Pose = python "skillc_runtime.motion.lanes:corner"
function lanes(surface: Surface, width: Length, overlap: Number) -> [Pose] = python "skillc_runtime.motion.lanes:lanes"

skill Wipe {
    in    arm:     ArmDevice
    in    surface: WipeableSurface
    infer gripper: GripperEffector
    infer tool:    Eraser
    opt   speed:   Speed     = 0.1 m/s
    opt   radius:  Length    = 15 mm
    opt   rate:    Frequency = 1 Hz
    pre   arm hasA gripper
    pre   gripper contain tool
    post  sensed clean: surface.isClean == true
}

## One implementation for every arm with a compliant controller: impedance on a torque-controlled arm,
## forward-dynamics compliance on a position-controlled one. The controller itself is knowledge about the arm.
impl wipe_lanes of Wipe {
    refine   arm:    CompliantArm
    let      normal = surface.normal
    let      above  = offset(corner(surface, 0), 5 cm * normal)

    do seq {
        MoveLinear(arm, target: above, speed)
        # undone in reverse order on success, failure and halt
        with Compliance(arm, along: normal, stiffness: 0 N/m) {
            with Push(arm, along: normal, force: surface.normalForce) {
                par lead {
                    FollowPath(arm, path: lanes(surface, tool.width, 0.2), speed, blend: 1 cm)
                    OverlayCircle(arm, plane: normal, radius, rate)
                }
            }
        }
        MoveLinear(arm, target: above, speed)
        Inspect(surface)
    }
    verify never Push outside Compliance
    verify Push before Inspect
    verify after Push eventually Inspect
    verify never surface.normalForce > 25 N
}

task clean_whiteboard {
    scene "scenes/ur5e_whiteboard.ttl"
    goal  lab:Whiteboard-1.isClean == true
}
task wipe_table {
    scene "scenes/iiwa_table.ttl"
    do    Wipe(arm: lab:Iiwa-1, surface: lab:Table-1)
}
"""
GRIPPER = """
skill ActuateGripper {
    in   gripper: GripperEffector
    opt  force:   Force = 20 N  range 1 N .. 100 N
    noplan
}

impl wsg of ActuateGripper {
    refine   gripper: WsgGripper
    refine   force:   Force  range 5 N .. 80 N
    run      python "skillc_runtime.primitives.gripper:ParallelGripper"
}
"""


def compiled(text: str) -> Outcome[SkillLibrary]:
    """Compile one file against the shipped vocabulary and shelf."""
    return compile([Source("example.skill", HEADER + text)], vocabulary(), shelf(), "example")


@pytest.mark.parametrize(
    "text", [TERMS, PICK, WIPE, GRIPPER, TERMS + PICK], ids=["terms", "pick", "wipe", "wsg", "both"]
)
def test_examples_compile(text: str) -> None:
    errors = [d for d in compiled(text).diagnostics if d.severity == "error"]
    assert errors == []


def test_a_description_keeps_what_is_written() -> None:
    pick = compiled(PICK).value.skills["Pick"]
    assert pick.doc.startswith("Take `object` out of its location.")
    assert [p.direction for p in pick.parameters] == ["in", "in", "infer", "infer", "infer", "infer", "opt"]
    assert [r.label for r in pick.pre] == ["mounted", "there", "pre3", "pre4", "empty"]
    assert (pick.parameters[-1].low, pick.parameters[-1].high) == (0.01, 0.5)
    assert isinstance(pick.post[1].condition, Not) and isinstance(pick.post[1].condition.body, Holds)
    assert isinstance(pick.post[1].effects[0], Retract)
    line = (HEADER + PICK).split("\n").index("    hold     ready:    arm.deviceState != Fault") + 1
    assert pick.hold[0].source == Position("example.skill", line, 5)


def test_a_body_becomes_a_tree() -> None:
    outcome = compiled(WIPE).value
    wipe = outcome.implementations["Wipe.wipe_lanes"]
    assert isinstance(wipe.body, Compound) and isinstance(wipe.body.node, Sequence)
    first, yielding, _, last = wipe.body.node.children
    assert (
        isinstance(first, Call)
        and first.skill == "MoveLinear"
        and sorted(first.arguments) == ["arm", "speed", "target"]
    )
    assert isinstance(yielding, With) and isinstance(yielding.child, With)
    assert isinstance(yielding.child.child, Parallel) and yielding.child.child.policy == "lead"
    assert isinstance(last, Call) and last.skill == "Inspect"
    assert wipe.verify[0].text == "verify never Push outside Compliance"
    assert [(each.pattern, each.first, each.second) for each in wipe.verify[:3]] == [
        ("outside", Runs("Push"), Runs("Compliance")),
        ("before", Runs("Push"), Runs("Inspect")),
        ("eventually", Runs("Push"), Runs("Inspect")),
    ]
    assert isinstance(outcome.tasks["wipe_table"].body, Call)


def test_terms_are_added_to_those_of_the_same_name() -> None:
    merged = compiled(TERMS).value.vocabulary
    contain = merged.relations[merged.expand("skiros:contain")]
    assert len(contain.signatures) == 3
    assert merged.properties[merged.expand("wiping:isClean")].domains[1:] == (merged.expand("skillc:Surface"),)
    gripper = "https://w3id.org/skillc/library/example#Gripper"
    assert merged.classes[gripper].parents == (merged.expand("skillc:Tool"),)
    assert merged.disjoint(merged.expand("wiping:Eraser"), gripper)
    assert merged.short(gripper) == "example:Gripper"
