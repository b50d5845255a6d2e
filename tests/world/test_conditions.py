"""The truth tables of conditions: each situation with the truth of the condition and the words for what holds."""

import pytest

from skillc_model.conditions import (
    And,
    Anything,
    Arithmetic,
    Compare,
    Condition,
    Exists,
    Forall,
    Given,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Variable,
)
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.python_calls import EvaluationError
from world.lab import SCENE, VOCABULARY, assign, fact, holds, individual, iri

STATE = SCENE.with_changes([fact("gripper", "contain", "eraser"), individual("shelf-2", "Location")])


def i(name: str) -> Individual:
    """Return an individual of the test scene."""
    return Individual(iri(name))


def compare(name: str, property_: str, operator: str, value: object) -> Compare:
    """Compare a property with a constant."""
    return Compare(PropertyOf(i(name), iri(property_)), operator, Literal(value))  # type: ignore[arg-type]


def relation(subject: str, name: str, object_: str) -> Holds:
    """Make a relation between individuals; `_` is anything."""
    return Holds(_term(subject), iri(name), _term(object_))


def _term(name: str) -> Individual | Anything:
    return Anything() if name == "_" else i(name)


def some(cls: str, body: Condition) -> Exists:
    """Quantify `x` existentially."""
    return Exists("x", iri(cls), body)


def every(cls: str, body: Condition) -> Forall:
    """Quantify `x` universally."""
    return Forall("x", iri(cls), body)


X = Variable("x")
TABLE = [
    ("asserted", relation("arm", "hasGripper", "gripper"), True),
    ("follows by a sub-relation", relation("arm", "hasA", "gripper"), True),
    ("absent", relation("arm", "hasA", "box"), False),
    ("follows by the inverse", relation("eraser", "containedIn", "gripper"), True),
    ("follows by symmetry", relation("table", "beside", "shelf"), True),
    ("follows by transitivity", relation("robot", "within-it", "eraser"), True),
    ("follows from a transitive sub-relation", relation("robot", "near", "eraser"), True),
    ("the former holder of an inverse functional relation", relation("shelf", "contain", "eraser"), False),
    ("something in the gripper", relation("gripper", "contain", "_"), True),
    ("nothing on the shelf", relation("shelf", "contain", "_"), False),
    ("something holds the box", relation("_", "contain", "box"), True),
    ("nothing holds the robot", relation("_", "contain", "robot"), False),
    ("anything contains anything", relation("_", "contain", "_"), True),
    ("exists, exactly the class", some("Location", Holds(i("robot"), iri("at"), X)), True),
    ("exists, of a subclass", some("Arm", Holds(i("robot"), iri("hasA"), X)), True),
    ("exists, none related", some("Gripper", Holds(i("robot"), iri("hasA"), X)), False),
    ("exists, related but of another class", some("Robot", Holds(i("robot"), iri("at"), X)), False),
    ("equal by value", compare("box", "weight", "==", 3.0), True),
    ("not equal", compare("box", "weight", "==", 4), False),
    ("equal, missing", compare("eraser", "weight", "==", 3), False),
    ("unequal is not the negation of equal when missing", compare("eraser", "weight", "!=", 3), False),
    ("unequal", compare("box", "weight", "!=", 4), True),
    ("less", compare("box", "weight", "<", 4), True),
    ("less, missing", compare("eraser", "weight", "<", 4), False),
    ("at least", compare("box", "weight", ">=", 3), True),
    ("text exactly", compare("arm", "state", "==", "idle"), False),
    ("one of several values", compare("box", "label", "==", "heavy"), True),
    ("none of several values", compare("box", "label", "==", "blue"), False),
    ("computed", compare("table", "load", "==", 1), True),
    ("has a value", HasProperty(i("box"), iri("weight")), True),
    ("has none", HasProperty(i("eraser"), iri("weight")), False),
    ("is of the class", IsA(i("box"), iri("Product")), True),
    ("is of a subclass", IsA(i("eraser"), iri("Product")), True),
    ("is of a superclass only", IsA(i("box"), iri("Eraser")), False),
    ("is a thing", IsA(i("box"), iri("Thing")), True),
    ("the same", Same(Variable("arm"), i("arm")), True),
    ("not the same", Same(Variable("arm"), i("box")), False),
    ("given", Given("arm"), True),
    ("not given", Given("speed"), False),
    ("unset but guarded", And((Given("speed"), Compare(Variable("speed"), "<", Literal(1.0)))), False),
    ("empty and", And(()), True),
    ("empty or", Or(()), False),
    ("or", Or((relation("arm", "hasA", "box"), relation("arm", "hasA", "gripper"))), True),
    ("for every, one breaks it", every("Product", Holds(i("table"), iri("contain"), X)), False),
    ("for every, all fit", every("Location", Not(Holds(X, iri("contain"), i("eraser")))), True),
    ("for every, none there", every("Eraser", Holds(i("gripper"), iri("contain"), X)), True),
    (
        "for every, implied",
        every("Product", Or((Not(Holds(i("gripper"), iri("contain"), X)), IsA(X, iri("Eraser"))))),
        True,
    ),
    (
        "arithmetic over a property",
        Compare(Arithmetic("*", PropertyOf(i("box"), iri("weight")), Literal(2)), "==", Literal(6.0)),
        True,
    ),
    (
        "a function of a missing value",
        Compare(Invoke("heavier", (PropertyOf(i("eraser"), iri("weight")),)), ">", Literal(0.0)),
        False,
    ),
]


@pytest.mark.parametrize(("condition", "truth"), [row[1:] for row in TABLE], ids=[row[0] for row in TABLE])
def test_truth_and_its_negation(condition: Condition, truth: bool) -> None:
    bindings = {"arm": iri("arm"), "speed": None}
    assert evaluate(condition, STATE, bindings) is truth
    assert evaluate(Not(condition), STATE, bindings) is not truth
    false = Not(condition) if truth else condition
    assert explain(false, STATE, bindings, VOCABULARY)


WORDS = [
    (Not(relation("gripper", "contain", "_")), "t:gripper contain t:eraser; needed: nothing"),
    (relation("shelf", "contain", "eraser"), "t:gripper contain t:eraser; needed: t:shelf contain t:eraser"),
    (relation("gripper", "contain", "box"), "t:gripper contain t:eraser; needed: t:gripper contain t:box"),
    (
        relation("_", "contain", "robot"),
        "`_ contain t:robot` does not hold: nothing has the relation contain to t:robot",
    ),
    (compare("arm", "state", "==", "Fault"), 't:arm.state is "Idle"; needed: "Fault"'),
    (compare("box", "weight", "<", 2.5), "t:box.weight is 3 kg; needed: < 2.5 kg"),
    (compare("eraser", "weight", "<", 2.5), "t:eraser has no t:weight"),
    (IsA(i("box"), iri("Eraser")), "t:box is a t:Product; needed: t:Eraser"),
    (some("Board", HasProperty(X, iri("isClean"))), "t:board has no t:isClean"),
]


@pytest.mark.parametrize(("condition", "words"), WORDS)
def test_what_holds_instead_is_said_in_words(condition: Condition, words: str) -> None:
    assert explain(condition, STATE, {}, VOCABULARY) == words


UNDECIDED = [
    (Compare(Variable("speed"), "<", Literal(1.0)), "`speed` has no value"),
    (holds("arm", "hasA", "speed"), "`speed` has no value"),
    (holds("arm", "hasA", "number"), "`number` is 3.0, which is not an individual"),
    (Compare(Literal("red"), "<", Literal(1.0)), "cannot be compared"),
    (Compare(Arithmetic("/", Literal(1.0), Literal(0.0)), "<", Literal(1.0)), "by zero"),
    (Compare(Invoke("broken", ()), "<", Literal(1.0)), "broken() failed: RuntimeError: sensor unplugged"),
    (Compare(Invoke("unheard", ()), "<", Literal(1.0)), "no function unheard"),
]


@pytest.mark.parametrize(("condition", "words"), UNDECIDED)
def test_what_cannot_be_decided_is_an_error_and_neither_true_nor_false(condition: Condition, words: str) -> None:
    for each in (condition, Not(condition)):
        with pytest.raises(EvaluationError) as caught:
            evaluate(each, STATE, {"arm": iri("arm"), "speed": None, "number": 3.0})
        assert words in str(caught.value)


def test_a_value_that_is_missing_is_named() -> None:
    with pytest.raises(EvaluationError, match="t:eraser has no t:weight in the world model"):
        value_of(Arithmetic("+", Literal(1.0), PropertyOf(i("eraser"), iri("weight"))), STATE, {})
    state = STATE.with_changes([assign("eraser", "weight", 0.1)])
    assert value_of(Invoke("heavier", (PropertyOf(i("eraser"), iri("weight")),)), state, {}) == 1.1
