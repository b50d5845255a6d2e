"""A computed relation means the same to conditions, inference, planning, checks and proofs, and nobody states it."""

from __future__ import annotations

import pytest

from skillc.services.library import libraries
from skillc_compiler.pipeline import compile as compiled
from skillc_dsl.source import Source
from skillc_model.conditions import (
    Anything,
    Condition,
    Exists,
    Forall,
    Holds,
    Individual,
    Literal,
    Not,
    PropertyOf,
    Variable,
)
from skillc_model.conditions import Compare as Comparison
from skillc_model.read_write import EVERYTHING, FactPattern, facts_read, is_fixed
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.scene.load import load_scene, read_scene
from skillc_runtime.scene.shapes import format_shapes
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.deciding_facts import deciding_facts
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.join import solutions
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.terms import AT, BASE_FRAME_ID, FURNITURE, SIZE
from skillc_runtime.world.state.world_state import WorldState
from space.rooms import EMPTY, PART, at, lab, linked, skillc, thing, world

ON, INSIDE, CAN_REACH = skillc("restsOn"), skillc("isInside"), skillc("canReach")
X = Variable("x")
ROOM = world(
    thing("Table", at(0, 0, 0.7), size=(1, 1, 0.7), cls=FURNITURE),
    thing("Bench", at(3, 0, 0.4), size=(1, 1, 0.4), cls=FURNITURE),
    thing("Cup", at(0.2, 0, 0.75), size=(0.1, 0.1, 0.1)),
    thing("Pot", at(-0.2, 0, 0.8), size=(0.2, 0.2, 0.2)),
    thing("Lamp", at(0, 0, 2.0), size=(0.2, 0.2, 0.2)),
)


def i(name: str) -> Individual:
    return Individual(lab(name))


@pytest.mark.parametrize(
    ("condition", "true"),
    [
        (Holds(i("Cup"), ON, i("Table")), True),
        (Holds(i("Lamp"), ON, i("Table")), False),
        (Not(Holds(i("Lamp"), ON, Anything())), True),
        (Holds(Anything(), ON, i("Bench")), False),
        (Holds(Anything(), ON, Anything()), True),
        (Exists("x", PART, Holds(X, ON, i("Table"))), True),
        (Forall("x", PART, Holds(X, ON, i("Table"))), False),
        (Forall("x", FURNITURE, Not(Holds(i("Table"), ON, X))), True),
    ],
)
def test_conditions_read_it(condition: Condition, true: bool) -> None:
    assert evaluate(condition, ROOM, {}) is true


def test_moving_a_thing_changes_it_in_the_next_version_alone() -> None:
    there = Holds(i("Cup"), ON, i("Bench"))
    moved = ROOM.with_changes(placement_changes(lab("Cup"), at(3, 0, 0.45)))
    assert evaluate(there, moved, {}) and not evaluate(there, ROOM, {})


def test_inference_finds_what_it_links() -> None:
    found = list(solutions({"x": PART, "y": FURNITURE}, [Holds(X, ON, Variable("y"))], {}, ROOM))
    assert sorted((each["x"], each["y"]) for each in found) == [(lab("Cup"), lab("Table")), (lab("Pot"), lab("Table"))]


def test_why_it_does_not_hold_is_told_with_numbers_and_what_decided_is_told_as_a_fact() -> None:
    condition = Holds(i("Lamp"), ON, i("Table"))
    told = explain(condition, ROOM, {}, ROOM.vocabulary)
    assert told.endswith("restsOn " + lab("Table") + f"` does not hold: {lab('Lamp')} is 1.200 m above {lab('Table')}")
    decided = deciding_facts([condition], ROOM, {})
    assert tuple(map(format_fact, decided)) == (f"not {lab('Lamp')} restsOn {lab('Table')}",)
    lost = ROOM.with_changes(placement_changes(lab("Lamp"), at(0, 0, 0), "Lamp"))
    assert deciding_facts([condition], lost, {}) == ()
    with pytest.raises(EvaluationError, match="form a circle"):
        evaluate(condition, lost, {})


def test_nobody_states_it() -> None:
    with pytest.raises(WorldError, match="the relation is computed from other facts and cannot be stated"):
        WorldModel(ROOM).commit([linked("Lamp", ON, "Table")])
    assert "restsOn" not in format_shapes(ROOM.vocabulary)


def test_a_scene_that_states_it_is_told_where(tmp_path: object) -> None:
    text = catalogue.scene_path("iiwa_table.ttl").read_text("utf-8")
    path = tmp_path / "scene.ttl"  # type: ignore[operator]
    path.write_text(text + "lab:Eraser-1 skillc:restsOn lab:SideTable .\n", "utf-8")
    (problem,) = read_scene(path, ROOM.vocabulary).problems
    assert (problem.name, problem.span.line) == ("computed-property", text.count("\n") + 1)


def test_it_is_never_fixed_and_is_read_from_what_decides_it() -> None:
    condition = Holds(X, CAN_REACH, i("Table"))
    assert not is_fixed(condition, frozenset(), ROOM.vocabulary)
    read = set(facts_read(condition, {}, ROOM.vocabulary))
    assert FactPattern(SIZE[0]) not in read and FactPattern(AT) not in read and EVERYTHING not in read
    assert FactPattern(BASE_FRAME_ID) in read
    assert FactPattern(AT) in set(facts_read(Holds(X, ON, i("Table")), {}, ROOM.vocabulary))


HEAD = "use skiros, rparts, cora, skillc, wiping\n"
STAND_IN = 'run python "skillc.primitives:StandIn"'
CARE = f"""{HEAD}
skill Polish {{
    in    surface: WipeableSurface
    infer arm:     ArmDevice
    pre   near:    arm canReach surface
    post  surface.isClean == true
}}
impl polish of Polish {{ {STAND_IN} }}
skill Drive {{
    in    robot: MobileRobot
    in    to:    Workstation
    post  robot at to
}}
impl drive of Drive {{ {STAND_IN} }}
skill Tidy {{
    in    what: Manipulatable
    infer where: Furniture
    pre   what isInside where
    post  where skiros:hasA what
}}
impl tidy of Tidy {{ {STAND_IN} }}
"""


def library(text: str) -> SkillLibrary:
    outcome = compiled([Source("care.skill", text)], libraries.load_vocabulary(), {}, "care", {})
    assert not [each for each in outcome.diagnostics if each.severity == "error"], outcome.diagnostics
    return outcome.value


BOARD = load_scene(catalogue.scene_path("ur5e_whiteboard.ttl"), EMPTY.vocabulary)
CLEAN = Comparison(PropertyOf(i("Whiteboard-1"), "https://w3id.org/skillc/wiping#isClean"), "==", Literal(True))


def planned(state: WorldState, goal: Condition) -> PlanResult:
    return solve(library(CARE), state, goal, (AStar(),))


def test_plans_read_what_no_skill_changes_and_say_by_how_much_it_fails() -> None:
    result = planned(BOARD, CLEAN)
    assert isinstance(result, Solved) and [step.skill for step in result.plan.steps] == ["Polish"]
    assert result.plan.steps[0].arguments["arm"] == lab("Ur5e-1")
    far = BOARD.with_changes(placement_changes(lab("Whiteboard-1"), at(5, 5, 1)))
    result = planned(far, CLEAN)
    assert isinstance(result, Unsolvable)
    assert "Polish needs arm canReach surface" in result.why and "lab:Ur5e-1 reaches 1.00 m" in result.why


def test_what_reads_a_relation_that_skills_move_is_left_out_of_planning_with_the_reason() -> None:
    tidied = planned(BOARD, Holds(i("StoreTable"), "http://rvmi.aau.dk/ontologies/skiros.owl#hasA", i("Eraser-1")))
    assert isinstance(tidied, GaveUp), "Tidy might help: nothing is proved"
    assert "Tidy is left out of planning: its precondition `what isInside where` reads `skillc:isInside`" in tidied.why
    assert "which is computed from `skiros:at`, and skills change it" in tidied.why
    on_table = Holds(i("Eraser-1"), ON, i("StoreTable"))
    rests = planned(BOARD, on_table)
    assert isinstance(rests, Solved) and not rests.plan.steps, "it rests there already"
    refused = planned(BOARD, Holds(i("Eraser-1"), INSIDE, i("StoreTable")))
    assert isinstance(refused, GaveUp) and not refused.searched
    assert "the goal reads `skillc:isInside`, which is computed from `skiros:at`" in refused.why


def found(text: str) -> list[str]:
    outcome = compiled([Source("care.skill", HEAD + text)], libraries.load_vocabulary(), {}, "care", {})
    return sorted(each.name for each in outcome.diagnostics if each.name != "unused-use")


@pytest.mark.parametrize(
    ("post", "names"),
    [
        ("post gone isInside here", ["computed-property"]),
        ("post not gone isInside here", ["computed-property"]),
        ("post sensed gone isInside here", []),
        ("post gone restsOn here", []),
    ],
)
def test_a_post_may_establish_it_by_measuring_alone_but_for_what_planners_foresee(post: str, names: list[str]) -> None:
    parts = ("in gone: Part", "in here: Furniture", post, "noplan")
    text = "\n".join(("skill Put {", *parts, "}", f"impl put of Put {{ {STAND_IN} }}", ""))
    assert found(text) == names


PROOF = """
skill Look {{
    in   arm:     ArmDevice
    in   surface: Surface
    pre  arm {relation} surface
    noplan
}}
impl look of Look {{ do wait 1 s }}
skill Change {{
    in   robot: MobileRobot
    in   to:    Workstation
    post robot at to
}}
impl change of Change {{ {stand_in} }}
skill Both {{
    in   arm:     ArmDevice
    in   surface: Surface
    in   robot:   MobileRobot
    in   to:      Workstation
    pre  arm {relation} surface
    noplan
}}
impl both of Both {{ do seq {{
    Look(arm, surface)
    Change(robot, to)
    Look(arm, surface)
}} }}
"""


@pytest.mark.parametrize(("relation", "kept"), [("canReach", True), ("reaches", False)])
def test_a_proof_keeps_it_until_something_is_written_that_decides_it(relation: str, kept: bool) -> None:
    names = found(PROOF.format(relation=relation, stand_in=STAND_IN))
    assert ("child-precondition" in " ".join(names)) is not kept, names


VOCABULARY = """
@prefix lab: <http://example.org/lab#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
lab:Cup a owl:Class .
lab:size a owl:ObjectProperty .
lab:beside a owl:ObjectProperty{axiom} ; skillc:computedBy "{python}" ; skillc:computedFrom lab:size .
{more}
"""


@pytest.mark.parametrize(
    ("axiom", "more", "message"),
    [
        ("", "", None),
        (", owl:SymmetricProperty", "", "so it cannot be symmetric"),
        (", owl:TransitiveProperty", "", "so it cannot be transitive"),
        (" ; rdfs:subPropertyOf lab:size", "", "so it cannot be a kind of `"),
        (" ; owl:inverseOf lab:size", "", "so it cannot be the inverse of `"),
        ("", "lab:by a owl:ObjectProperty ; rdfs:subPropertyOf lab:beside .", "so it cannot be what `"),
        ("", "lab:beside skillc:computedFrom lab:Cup .", "is computed from `"),
    ],
)
def test_what_is_computed_has_no_axioms(axiom: str, more: str, message: str | None) -> None:
    text = VOCABULARY.format(axiom=axiom, python="lab:Beside", more=more)
    told = load([Source("lab.ttl", text)]).diagnostics
    assert [each.name for each in told] == ([] if message is None else ["computed-relation"])
    assert message is None or message in told[0].message


class Shorter:
    """A reasoner of a user's: things are beside each other in the order of their names."""

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        return None if subject < object_ else f"{subject} comes later"


@pytest.mark.parametrize(
    ("python", "answer"),
    [
        ("space.test_computed:Shorter", True),
        ("space.test_computed:Missing", "space.test_computed:Missing cannot be loaded"),
        ("no.such.module:Shorter", "no.such.module:Shorter cannot be loaded"),
    ],
)
def test_a_vocabulary_may_bring_a_reasoner_of_its_own(python: str, answer: bool | str) -> None:
    terms = load([Source("lab.ttl", VOCABULARY.format(axiom="", python=python, more=""))]).value
    state = WorldModel(WorldState.empty(terms)).snapshot().with_changes([*(thing("a", cls=lab("Cup"))[:1])])
    state = state.with_changes(thing("b", cls=lab("Cup"))[:1])
    condition = Holds(i("a"), lab("beside"), i("b"))
    if answer is True:
        assert evaluate(condition, state, {}) and not evaluate(Holds(i("b"), lab("beside"), i("a")), state, {})
        return
    with pytest.raises(EvaluationError, match=str(answer)):
        evaluate(condition, state, {})
