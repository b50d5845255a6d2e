"""Inferred parameters: one answer, none and why, several."""

from skillc_model.conditions import Anything, Holds, Not, Variable
from skillc_runtime.world.eval.inference import Ambiguous, Inferred, NoneFound, infer
from world.lab import SCENE, fact, holds, individual, iri, parameter, requirement

MOUNTED = requirement("mounted", holds("arm", "hasA", "gripper"))
THERE = requirement("there", holds("from", "contain", "object"))
EMPTY = requirement("empty", Not(Holds(Variable("gripper"), iri("contain"), Anything())))
PICK = (MOUNTED, THERE, EMPTY)
WANTED = (parameter("gripper", "Gripper"), parameter("from", "Location"))
BINDINGS = {"arm": iri("arm"), "object": iri("eraser")}


def test_the_only_answer_is_found() -> None:
    assert infer(WANTED, PICK, BINDINGS, SCENE) == Inferred({"gripper": iri("gripper"), "from": iri("shelf")})


def test_no_parameters_need_no_answer() -> None:
    assert infer((), PICK, BINDINGS, SCENE) == Inferred({})


def test_the_requirement_that_left_none_is_named_with_what_holds_instead() -> None:
    state = SCENE.with_changes([fact("gripper", "contain", "box")])
    answer = infer(WANTED, PICK, BINDINGS, state)
    assert isinstance(answer, NoneFound)
    assert (answer.requirement, answer.reason) == (EMPTY, "t:gripper contain t:box; needed: nothing")
    answer = infer(WANTED, PICK, {**BINDINGS, "object": iri("robot")}, SCENE)
    assert isinstance(answer, NoneFound) and answer.requirement == THERE
    assert answer.reason.endswith("nothing has the relation contain to t:robot")


def test_an_answer_of_another_class_is_none() -> None:
    answer = infer(WANTED, PICK, BINDINGS, SCENE.with_changes([fact("robot", "contain", "eraser")]))
    assert isinstance(answer, NoneFound) and answer.requirement == THERE
    assert answer.reason == "t:robot contain t:eraser; needed: a t:Location contain t:eraser"


def test_what_is_of_another_is_named_as_the_nearest() -> None:
    changes = (individual("arm-2", "Arm"), individual("gripper-2", "Gripper"), fact("arm-2", "hasGripper", "gripper-2"))
    state = SCENE.with_changes([*changes, individual("arm-3", "Arm"), fact("gripper", "contain", "box")])
    answer = infer(WANTED, PICK, {**BINDINGS, "arm": iri("arm-3")}, state)
    assert isinstance(answer, NoneFound) and answer.requirement == MOUNTED
    (near,) = answer.nearest
    assert (near.requirement, near.about, near.bindings["gripper"]) == (MOUNTED, ("gripper",), iri("gripper-2"))
    assert near.reason == "t:arm-2 hasA t:gripper-2; needed: t:arm-3 hasA t:gripper-2"


def test_what_is_of_another_class_is_named_as_the_nearest() -> None:
    answer = infer(WANTED, PICK, BINDINGS, SCENE.with_changes([fact("robot", "contain", "eraser")]))
    assert isinstance(answer, NoneFound)
    other = [near.reason for near in answer.nearest if near.requirement is None]
    assert other == ["t:robot is a t:Robot; needed: t:Location"]


def test_what_many_would_do_for_is_near_to_none() -> None:
    crowd = SCENE.with_changes([individual(f"place-{n}", "Location") for n in range(9)])
    for state, count in ((SCENE, 2), (crowd, 0)):
        answer = infer(WANTED, PICK, {**BINDINGS, "object": iri("robot")}, state)
        assert isinstance(answer, NoneFound) and len(answer.nearest) == count


def test_a_class_without_individuals_is_named() -> None:
    answer = infer((parameter("arm", "CompliantArm"), parameter("tool", "Tool")), (), {}, SCENE)
    assert answer == NoneFound(None, "`tool`: there is no t:Tool in the world model")


def test_several_answers_are_all_listed_in_order() -> None:
    answer = infer((parameter("object", "Product"), parameter("from", "Location")), (THERE,), {}, SCENE)
    assert answer == Ambiguous(
        (
            {"object": iri("box"), "from": iri("table")},
            {"object": iri("eraser"), "from": iri("shelf")},
        )
    )


def test_any_takes_the_first_in_order_and_names_the_others() -> None:
    wanted = (parameter("object", "Product", any_=True), parameter("from", "Location", any_=True))
    answer = infer(wanted, (THERE,), {}, SCENE)
    assert answer == Inferred(
        {"object": iri("box"), "from": iri("table")}, ({"object": iri("eraser"), "from": iri("shelf")},)
    )
    one_fixed = (parameter("object", "Product", any_=True), parameter("from", "Location"))
    assert isinstance(infer(one_fixed, (THERE,), {}, SCENE), Ambiguous)


def test_the_join_agrees_with_trying_everything() -> None:
    state = SCENE.with_changes(
        [
            *(individual(f"box-{n}", "Product") for n in range(9)),
            *(individual(f"place-{n}", "Location") for n in range(3)),
            *(fact(f"place-{n % 3}", "contain", f"box-{n}") for n in range(9)),
            fact("place-0", "beside", "place-1"),
        ]
    )
    linked = requirement("linked", holds("from", "beside", "to"))
    wanted = (parameter("object", "Product"), parameter("from", "Location"), parameter("to", "Location"))
    answer = infer(wanted, (THERE, linked), {}, state)
    assert isinstance(answer, Ambiguous)
    places, products = sorted(state.instances(iri("Location"))), sorted(state.instances(iri("Product")))
    tried = [
        {"object": o, "from": f, "to": t}
        for o in products
        for f in places
        for t in places
        if state.holds(f, iri("contain"), o) and state.holds(f, iri("beside"), t)
    ]
    assert list(answer.candidates) == tried and len(tried) == 8
