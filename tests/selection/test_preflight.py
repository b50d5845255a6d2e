"""What is refused before anything moves, and what is not because it may yet become possible."""

from __future__ import annotations

import msgspec
import pytest

from selection.library import MOUNTED, THERE, at, call, force, gripper, impl, library, scene
from skillc_model import tree
from skillc_model.conditions import (
    Arithmetic,
    Assign,
    Expression,
    HasProperty,
    Individual,
    Invoke,
    IsA,
    Literal,
    PropertyOf,
    Variable,
)
from skillc_model.skills import Compound, Implementation, Let, Post, Primitive
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.world.state.changes import Change, RemoveRelation
from world.lab import assign, fact, individual, iri, parameter

PICK = call("Pick", arm=Individual(iri("arm")), object=Individual(iri("eraser")))
CUPPED: tuple[Change, ...] = (
    RemoveRelation(iri("arm"), iri("hasGripper"), iri("gripper")),
    fact("arm", "hasA", "cup"),
)
ON_CUP = call("Actuate", gripper=Individual(iri("cup")))
ON_GRIPPER = call("Actuate", gripper=Individual(iri("gripper")))
UNKNOWN = call("Actuate", gripper=Variable("nobody"))


def refusals(body: tree.Node, *changes: Change, more: tuple[Implementation, ...] = ()) -> list[str]:
    """Return the refusals as text."""
    return [str(refusal) for refusal in preflight(body, library(*more), scene(*changes))]


def seq(*children: tree.Node) -> tree.Sequence:
    """Make a sequence."""
    return tree.Sequence(children=children, reactive=False, source=at(40))


def test_a_body_that_can_run_is_not_refused() -> None:
    assert refusals(seq(PICK, ON_GRIPPER)) == []


def test_a_gripper_nobody_can_move_is_found_in_the_depth() -> None:
    assert refusals(PICK, *CUPPED) == [
        "work.skill:20: no implementation of Actuate fits: wsg: `gripper` needs WsgGripper, t:cup is a t:SuctionCup; "
        "robotiq: `gripper` needs RobotiqGripper, t:cup is a t:SuctionCup (in Pick[from_above])"
    ]


def test_all_refusals_are_listed() -> None:
    assert len(refusals(seq(ON_CUP, ON_GRIPPER, ON_CUP))) == 2


def test_a_missing_part_is_named() -> None:
    bare = RemoveRelation(iri("arm"), iri("hasGripper"), iri("gripper"))
    (refusal,) = refusals(PICK, bare)
    assert "arm hasA gripper" in refusal and "t:arm" in refusal


def test_a_class_without_individuals_is_named() -> None:
    fetch = impl("Fetch", "any", parameter("what", "Board"), body=Compound(ON_GRIPPER))
    assert refusals(call("Fetch"), more=(fetch,)) == [
        "work.skill:20: Fetch: `what`: there is no t:Board in the world model"
    ]


def test_what_skills_change_does_not_count() -> None:
    """The eraser is nowhere and the gripper full: other skills may change both before."""
    assert refusals(PICK, RemoveRelation(iri("shelf"), iri("contain"), iri("eraser"))) == []
    assert refusals(PICK, fact("gripper", "contain", "box")) == []


def test_values_that_are_not_known_yet_fit() -> None:
    assert refusals(UNKNOWN) == []


def test_a_number_out_of_range_is_found() -> None:
    (refusal,) = refusals(call("Actuate", gripper=Individual(iri("gripper")), force=Literal(500.0)))
    assert "500 N is above 80 N" in refusal


@pytest.mark.parametrize(
    ("python", "reason"),
    [
        ("nothing.here:Class", "cannot be imported"),
        ("selection.library:Missing", "has no class Missing"),
        ("selection.library:scene", "is not a subclass of"),
        ("selection.library:Moves", "needs the parameter force"),
    ],
)
def test_python_classes_that_cannot_run(python: str, reason: str) -> None:
    broken = impl("Broken", "only", gripper("Gripper"), body=Primitive(python))
    (refusal,) = refusals(call("Broken", gripper=Individual(iri("gripper"))), more=(broken,))
    assert reason in refusal


def test_an_untaken_parameter_is_named() -> None:
    more = impl(
        "More", "only", gripper("Gripper"), parameter("arm", "Arm", "in"), body=Primitive("selection.library:Moves")
    )
    (refusal,) = refusals(call("More", gripper=Individual(iri("gripper")), arm=Individual(iri("arm"))), more=(more,))
    assert "takes no parameter arm" in refusal


def test_alternatives_are_refused_when_all_are() -> None:
    either = tree.Selector(children=(ON_CUP, ON_GRIPPER), reactive=False, source=at(41))
    neither = tree.Selector(children=(ON_CUP, ON_CUP), reactive=False, source=at(42))
    assert refusals(either) == [] and len(refusals(neither)) == 2
    assert refusals(tree.Try(child=ON_CUP, source=at(43))) == []


def test_a_branch_that_is_never_taken_is_not_looked_at() -> None:
    body = tree.If(
        condition=IsA(Variable("gripper"), iri("SuctionCup")),
        text="gripper is SuctionCup",
        then=call("Hold", gripper=Variable("gripper")),
        orelse=call("Actuate", gripper=Variable("gripper")),
        source=at(44),
    )
    grip = impl("Grip", "either", gripper("Gripper"), body=Compound(body))
    assert refusals(call("Grip", gripper=Individual(iri("cup"))), more=(grip,)) == []
    assert refusals(call("Grip", gripper=Individual(iri("gripper"))), more=(grip,)) == []


def test_a_skill_that_calls_itself_ends() -> None:
    again = impl("Again", "and_again", gripper("Gripper"), body=Compound(call("Again", gripper=Variable("gripper"))))
    assert refusals(call("Again", gripper=Individual(iri("cup"))), more=(again,)) == []


def test_ambiguous_parts_are_left_to_the_start() -> None:
    two = (individual("hand", "RobotiqGripper"), fact("arm", "hasA", "hand"))
    assert refusals(PICK, *two) == []


def test_a_condition_nothing_can_change_is_checked() -> None:
    arm, body = parameter("arm", "Arm", "in"), Compound(seq())
    need = impl("Need", "both", arm, gripper("Gripper"), pre=(MOUNTED, THERE), body=body)
    fits = call("Need", arm=Individual(iri("arm")), gripper=Individual(iri("gripper")))
    never = call("Need", arm=Individual(iri("arm")), gripper=Individual(iri("cup")))
    assert refusals(fits, more=(need,)) == []
    assert "arm hasA gripper" in refusals(never, more=(need,))[0]


WEIGHT = PropertyOf(Individual(iri("eraser")), iri("weight"))
NO_WEIGHT = "t:eraser has no t:weight in the world model, and no skill supplies it"
WEIGHED = Post(
    label="weighed",
    condition=HasProperty(Individual(iri("eraser")), iri("weight")),
    effects=(Assign(Individual(iri("eraser")), iri("weight"), Literal(1.0)),),
    sensed=False,
    text="eraser has weight",
    source=at(50),
)


@pytest.mark.parametrize(
    "force",
    [
        WEIGHT,
        Arithmetic("*", Literal(2.0), WEIGHT),
        Invoke("heavier", (WEIGHT,)),
        Invoke("heavier", (Arithmetic("+", Variable("unknown"), WEIGHT),)),
    ],
)
def test_a_fact_that_no_skill_supplies_is_missed_before_anything_moves(force: Expression) -> None:
    body = call("Actuate", gripper=Individual(iri("gripper")), force=force)
    assert refusals(body) == [f"work.skill:20: Actuate: `force` has no value: {NO_WEIGHT}"]
    assert refusals(body, assign("eraser", "weight", 9.0)) == []
    weigh = impl("Weigh", "only", post=(WEIGHED,), body=Compound(seq()))
    assert refusals(body, more=(weigh,)) == []


def test_what_fails_for_good_is_missed() -> None:
    nothing = Arithmetic("/", Literal(1.0), WEIGHT)
    (refusal,) = refusals(
        call("Actuate", gripper=Individual(iri("gripper")), force=nothing), assign("eraser", "weight", 0.0)
    )
    assert "Actuate: `force` has no value: division of 1.0 by zero" in refusal


def test_a_let_and_the_items_of_a_loop_are_missed() -> None:
    loop = tree.ForEach(variable="each", items=WEIGHT, child=seq(), source=at(46))
    lets = (Let(name="heavy", value=WEIGHT),)
    again = msgspec.structs.replace(impl("Again", "only", body=Compound(loop)), lets=lets)
    assert refusals(call("Again"), more=(again,)) == [
        f"work.skill:5: Again: `heavy` has no value: {NO_WEIGHT} (in Again[only])",
        f"work.skill:46: for: `each` has no value: {NO_WEIGHT} (in Again[only])",
    ]


def test_a_default_is_missed_where_it_is_needed() -> None:
    lift = impl("Lift", "strong", gripper("Gripper"), force(default=WEIGHT))
    assert refusals(call("Lift", gripper=Individual(iri("gripper"))), more=(lift,)) == [
        f"work.skill:20: Lift: `force` has no value: {NO_WEIGHT}"
    ]
    assert refusals(call("Lift", gripper=Individual(iri("gripper")), force=Literal(1.0)), more=(lift,)) == []
