"""Which implementation is taken, and what is said of the others."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from selection.library import EMPTY, MOUNTED, THERE, force, gripper, impl, library, requirement, scene
from skillc_model.conditions import Arithmetic, Compare, Given, Literal, Not, Or, PropertyOf, Variable
from skillc_runtime.execution.selection.python_targets import PrimitiveError, import_primitive
from skillc_runtime.execution.selection.select import (
    NoneSelected,
    SelectedImplementation,
    explain_none_selected,
    select_implementation,
)
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.values import Value
from world.lab import fact, individual, iri, parameter

GRIPPER = {"gripper": iri("gripper")}
CUP = {"gripper": iri("cup")}
PICK: dict[str, Value] = {"arm": iri("arm"), "object": iri("eraser")}


def refusals(result: SelectedImplementation | NoneSelected) -> list[tuple[str, str, str]]:
    """Return who was rejected, at which stage and why."""
    return [(each.implementation, each.stage, each.reason) for each in result.rejected]


def test_the_first_that_fits_is_taken() -> None:
    choice = select_implementation(library(), "Actuate", GRIPPER, scene())
    assert isinstance(choice, SelectedImplementation)
    assert choice.implementation.name == "wsg" and choice.rejected == () and choice.bindings == GRIPPER


def test_those_before_it_are_rejected_with_reasons() -> None:
    robotiq = scene(individual("other", "RobotiqGripper"))
    choice = select_implementation(library(), "Actuate", {"gripper": iri("other")}, robotiq)
    assert isinstance(choice, SelectedImplementation) and choice.implementation.name == "robotiq"
    assert refusals(choice) == [("wsg", "argument", "`gripper` needs WsgGripper, t:other is a t:RobotiqGripper")]


def test_none_fits() -> None:
    result = select_implementation(library(), "Actuate", CUP, scene())
    assert isinstance(result, NoneSelected)
    assert explain_none_selected("Actuate", result.rejected) == (
        "no implementation of Actuate fits: wsg: `gripper` needs WsgGripper, t:cup is a t:SuctionCup; "
        "robotiq: `gripper` needs RobotiqGripper, t:cup is a t:SuctionCup"
    )


def test_a_fixed_choice_leaves_no_other() -> None:
    result = select_implementation(library(), "Actuate", GRIPPER, scene(), fixed="robotiq")
    assert isinstance(result, NoneSelected) and [each.implementation for each in result.rejected] == ["robotiq"]


@pytest.mark.parametrize("force", [0.1 * 50, 80 * (0.1 + 0.2) / 0.3, 80 * (1 + 1e-12), 5 * (1 - 1e-12)])
def test_rounding_takes_no_value_out_of_its_range(force: float) -> None:
    result = select_implementation(library(), "Actuate", GRIPPER | {"force": force}, scene(), fixed="wsg")
    assert isinstance(result, SelectedImplementation)


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        ({"force": 4.0}, "`force` 4 N is below 5 N, the minimum"),
        ({"force": 90.0}, "`force` 90 N is above 80 N, the maximum"),
        ({"force": "much"}, '`force` needs Force, not "much"'),
        ({"force": float("nan")}, "`force` needs Force, not nan N"),
        ({"force": True}, "`force` needs Force, not true"),
        ({"gripper": iri("nowhere")}, "`gripper` needs WsgGripper, t:nowhere is not in the world model"),
        ({"colour": 1.0}, "Actuate has no parameter `colour`"),
    ],
)
def test_arguments_are_checked(arguments: dict[str, Value], reason: str) -> None:
    result = select_implementation(library(), "Actuate", GRIPPER | arguments, scene(), fixed="wsg")
    assert refusals(result) == [("wsg", "argument", reason)]


@pytest.mark.parametrize("value", [5.0, 80.0, 42])
def test_the_ends_of_a_range_belong_to_it(value: float) -> None:
    assert isinstance(
        select_implementation(library(), "Actuate", GRIPPER | {"force": value}, scene()), SelectedImplementation
    )


def test_what_must_be_passed() -> None:
    assert refusals(select_implementation(library(), "Pick", {"arm": iri("arm")}, scene())) == [
        ("from_above", "argument", "`object` was not passed")
    ]


def test_parameters_are_inferred() -> None:
    choice = select_implementation(library(), "Pick", PICK, scene())
    assert isinstance(choice, SelectedImplementation)
    assert choice.bindings == PICK | {"gripper": iri("gripper"), "from": iri("shelf")}


def test_a_passed_inferred_parameter_is_checked_like_any_other() -> None:
    result = select_implementation(library(), "Pick", PICK | {"from": iri("table")}, scene())
    assert refusals(result)[0][1] == "pre"
    assert "from contain object" in refusals(result)[0][2] and "from = t:table" in refusals(result)[0][2]


def test_an_empty_answer_names_the_condition_and_its_line() -> None:
    result = select_implementation(library(), "Pick", PICK, scene(fact("gripper", "contain", "box")))
    rejected = result.rejected[0]
    assert rejected.stage == "inference" and rejected.source == EMPTY.source
    assert "not gripper contain _" in rejected.reason and "t:gripper contain t:box" in rejected.reason


TWO = (individual("hand", "WsgGripper"), fact("arm", "hasA", "hand"))


def test_several_answers_are_listed() -> None:
    rejected = select_implementation(library(), "Pick", PICK, scene(*TWO)).rejected[0]
    assert rejected.stage == "inference"
    assert "`gripper` may be t:gripper, t:hand" in rejected.reason


def any_pick(*changes: Change) -> SelectedImplementation:
    """Choose an implementation that lets any gripper do."""
    arm, object_ = parameter("arm", "Arm", "in"), parameter("object", "Product", "in")
    anyone = parameter("gripper", "Gripper", any_=True)
    lenient = impl("Lenient", "any", arm, object_, anyone, parameter("from", "Location"), pre=(MOUNTED, THERE))
    choice = select_implementation(library(lenient), "Lenient", PICK, scene(*changes))
    assert isinstance(choice, SelectedImplementation)
    return choice


def test_any_takes_the_first() -> None:
    assert any_pick(*TWO).bindings["gripper"] == iri("gripper")
    assert any_pick(individual("a-hand", "WsgGripper"), fact("arm", "hasA", "a-hand")).bindings["gripper"] == iri(
        "a-hand"
    )


def test_defaults_may_read_what_was_inferred_and_passed() -> None:
    double = force(default=Arithmetic("*", Literal(2.0), PropertyOf(Variable("object"), iri("weight"))))
    heavy = impl("Lift", "strong", parameter("object", "Product"), double, pre=(WEIGHED,))
    choice = select_implementation(library(heavy), "Lift", {}, scene())
    assert isinstance(choice, SelectedImplementation)
    assert choice.bindings == {"object": iri("box"), "force": 6.0}


WEIGHED = requirement("object.weight > 1 kg", Compare(PropertyOf(Variable("object"), iri("weight")), ">", Literal(1.0)))


def test_a_default_out_of_range_is_rejected() -> None:
    weak = impl("Lift", "weak", parameter("object", "Product"), force(high=2.0, default=Literal(3.0)), pre=(WEIGHED,))
    result = select_implementation(library(weak), "Lift", {}, scene())
    assert refusals(result) == [("weak", "argument", "`force` 3 N is above 2 N, the maximum")]


def test_an_unset_optional_parameter_is_absent_and_guarded_by_given() -> None:
    strong = Compare(Variable("force"), ">", Literal(10.0))
    guarded = requirement("given force implies force > 10 N", Or((Not(Given("force")), strong)))
    careful = impl("Lift", "careful", gripper("Gripper"), force(), pre=(guarded,))
    assert isinstance(select_implementation(library(careful), "Lift", GRIPPER, scene()), SelectedImplementation)
    assert isinstance(
        select_implementation(library(careful), "Lift", GRIPPER | {"force": 11.0}, scene()), SelectedImplementation
    )
    assert isinstance(select_implementation(library(careful), "Lift", GRIPPER | {"force": 9.0}, scene()), NoneSelected)


@pytest.mark.parametrize(
    ("declared", "problem"),
    [
        ('activity = "juggle"', "`activity` of `MODULE:Own` is none of press, follow-path, search"),
        ('uses_devices = "none"', "`uses_devices` of `MODULE:Own` is not True or False"),
        ('highlights = (("later", "button", "pressed"),)', "`highlights` of `MODULE:Own` is not"),
        ('highlights = ("button", "pressed")', "`highlights` of `MODULE:Own` is not"),
        ("moves = ()", "`moves` of `MODULE:Own` is neither None nor {parameter: parameter of the place or None}"),
        ('moves = {"object": 1}', "`moves` of `MODULE:Own` is neither None nor"),
    ],
)
def test_what_a_primitive_declares_of_itself_is_checked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, declared: str, problem: str
) -> None:
    module = f"own_{sum(declared.encode())}"
    text = f"from skillc_runtime.primitives.primitive import Primitive\n\n\nclass Own(Primitive):\n    {declared}\n"
    (tmp_path / f"{module}.py").write_text(f"{text}\n    def tick(self): ...\n", "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    with pytest.raises(PrimitiveError, match=re.escape(problem.replace("MODULE", module))):
        import_primitive(f"{module}:Own")
