"""From goal to checked plan with every planner that is there, and the words for why there is none."""

import msgspec
import pytest

from planning.samples import CLEAN, CLEANED, DRIVE, LAB, PICK, WIPING, library, parameter
from skillc_model.conditions import And, Condition, Exists, Forall, Holds, Individual, Not, Or, PropertyOf, Variable
from skillc_rdf.vocabulary.types import ClassTerm
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import GaveUp, Plan, Planner, PlanResult, Solved, Step, StepWhile, Unsolvable
from skillc_runtime.planning.planners import list_planners
from skillc_runtime.planning.problem.pose import pose_problem
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import PlanError, validate
from skillc_runtime.world.state.changes import RemoveIndividual, RemoveRelation
from skillc_runtime.world.state.world_state import WorldState
from world.lab import assign, fact, individual, iri

X = Variable("x")


def i(name: str) -> Individual:
    """Return an individual of the test scene."""
    return Individual(iri(name))


def skills(result: PlanResult) -> list[str]:
    """Return the names of a plan's steps."""
    assert isinstance(result, Solved), result
    return [step.skill for step in result.plan.steps]


@pytest.mark.parametrize("planner", list_planners(), ids=lambda planner: planner.name)
def test_the_optimal_plan_fetches_the_eraser_first(planner: Planner) -> None:
    result = solve(WIPING, LAB, CLEANED, (planner,))
    assert skills(result) == ["Drive", "Pick", "Drive", "Clean"]
    assert isinstance(result, Solved) and result.optimal == "proven" and result.planner == planner.name
    assert result.plan.duration_s == 12 + 15 + 12 + 40
    assert result.plan.steps[0] == Step("Drive", {"robot": iri("robot"), "to": iri("shelf"), "from": iri("dock")})


GOALS: list[tuple[Condition, list[str]]] = [
    (Holds(i("robot"), iri("at"), i("wall")), ["Drive"]),
    (Not(Holds(i("robot"), iri("at"), i("dock"))), ["Drive"]),
    (Not(Holds(i("shelf"), iri("contain"), i("eraser"))), ["Drive", "Pick"]),
    (Holds(i("eraser"), iri("containedIn"), i("gripper")), ["Drive", "Pick"]),
    (Exists("x", iri("Gripper"), Holds(X, iri("contain"), i("eraser"))), ["Drive", "Pick"]),
    (Forall("x", iri("Location"), Not(Holds(X, iri("contain"), i("eraser")))), ["Drive", "Pick"]),
    (Or((CLEANED, Holds(i("robot"), iri("at"), i("wall")))), ["Drive"]),
    (And((CLEANED, Holds(i("robot"), iri("at"), i("dock")))), ["Drive", "Pick", "Drive", "Clean", "Drive"]),
    (Holds(i("robot"), iri("at"), i("dock")), []),
    (Holds(i("robot"), iri("hasA"), i("arm")), []),
]


@pytest.mark.slow
@pytest.mark.parametrize("planner", list_planners(), ids=lambda planner: planner.name)
@pytest.mark.parametrize(("goal", "expected"), GOALS)
def test_every_kind_of_goal_is_planned_for(goal: Condition, expected: list[str], planner: Planner) -> None:
    assert skills(solve(WIPING, LAB, goal, (planner,))) == expected


UNSOLVABLE = [
    ([RemoveIndividual(iri("eraser"))], CLEANED, "Clean needs a t:Eraser as `tool`, and there is none"),
    ([assign("eraser", "weight", 3.0)], CLEANED, "Pick needs light for t:eraser, which nothing fulfils"),
    (
        [RemoveRelation(iri("shelf"), iri("contain"), iri("eraser"))],
        CLEANED,
        "Pick needs `from` contain t:eraser, which nothing fulfils",
    ),
    (
        [],
        Holds(i("robot"), iri("hasA"), i("eraser")),
        "no skill can change this: t:robot hasA t:arm; needed",
    ),
    ([], Holds(i("robot"), iri("at"), i("robot")), "no skill can change this: t:robot at t:dock; needed: t:robot at"),
    (
        [],
        And((Holds(i("robot"), iri("at"), i("wall")), Holds(i("robot"), iri("at"), i("shelf")))),
        "`t:robot at t:wall` and `t:robot at t:shelf` cannot be reached together: once the first is, Drive undoes that",
    ),
]


@pytest.mark.parametrize("planner", list_planners(), ids=lambda planner: planner.name)
@pytest.mark.parametrize(("changes", "goal", "words"), UNSOLVABLE)
def test_no_plan_is_proved_and_explained(changes: list, goal: Condition, words: str, planner: Planner) -> None:  # type: ignore[type-arg]
    result = solve(WIPING, LAB.with_changes(changes), goal, (planner,))
    assert isinstance(result, Unsolvable), result
    assert words in result.why


@pytest.mark.parametrize("planner", list_planners(), ids=lambda planner: planner.name)
def test_many_steps_that_may_not_be_used_do_not_multiply(planner: Planner) -> None:
    places = [f"place-{number}" for number in range(12)]
    state = LAB.with_changes([individual(name, "Location") for name in places])
    ways = [("shelf", "dock"), *((place, "dock") for place in places), *(("shelf", place) for place in places[1:])]
    without = [Step("Drive", {"robot": iri("robot"), "to": iri(to), "from": iri(start)}) for to, start in ways]
    goal = Holds(i("robot"), iri("at"), i("shelf"))
    found = solve(WIPING, state, goal, (planner,), without=without)
    assert isinstance(found, Solved), found
    assert [each.arguments["to"] for each in found.plan.steps] == [iri("wall"), iri("shelf")]
    every = [*without, Step("Drive", {"robot": iri("robot"), "to": iri("wall"), "from": iri("dock")})]
    answer = solve(WIPING, state, goal, (planner,), without=every)
    assert isinstance(answer, GaveUp), "it is not proved, since steps were left out"
    assert "Drive needs not tried before with" in answer.why


@pytest.mark.parametrize("planner", list_planners(), ids=lambda planner: planner.name)
def test_a_step_that_does_not_go_while_something_stands_there_comes_after_it_is_moved(planner: Planner) -> None:
    lies_there = And((Holds(i("shelf"), iri("contain"), i("eraser")),))
    never = And((Holds(i("shelf"), iri("contain"), i("eraser")), Holds(i("wall"), iri("contain"), i("eraser"))))
    goal = Holds(i("robot"), iri("at"), i("wall"))

    def drive(start: str) -> Step:
        return Step("Drive", {"robot": iri("robot"), "to": iri("wall"), "from": iri(start)})

    blocked = [StepWhile(drive(start), lies_there, "it is in the way") for start in ("dock", "shelf")]
    found = solve(WIPING, LAB, goal, (planner,), without=blocked)
    assert skills(found) == ["Drive", "Pick", "Drive"]
    assert isinstance(found, Solved) and found.optimal == "optimal for the filtered problem"
    assert [each.why for each in found.left_out if each.kind == "steps"] == ["it is in the way"] * 2
    twice = [*blocked, *(StepWhile(drive(start), never, "twice") for start in ("dock", "shelf"))]
    assert skills(solve(WIPING, LAB, goal, (planner,), without=twice)) == ["Drive", "Pick", "Drive"]
    free = [StepWhile(drive("dock"), never, "never so")]
    assert skills(solve(WIPING, LAB, goal, (planner,), without=free)) == ["Drive"]
    for_good = [*blocked, drive("dock"), drive("shelf")]
    assert isinstance(solve(WIPING, LAB, goal, (planner,), without=for_good), GaveUp)


def test_a_skill_left_out_of_planning_is_named_when_the_goal_needs_it() -> None:
    number = msgspec.structs.replace(
        parameter("how_often", "Board", "in"), type=WIPING.vocabulary.properties[iri("weight")].type
    )
    strange = msgspec.structs.replace(CLEAN, parameters=(*CLEAN.parameters, number))
    result = solve(library(DRIVE, PICK, strange), LAB, CLEANED)
    assert isinstance(result, GaveUp), "without one of the skills nothing is proved"
    assert "Clean is left out of planning: its parameter `how_often` is no thing" in result.why


@pytest.mark.parametrize(
    ("goal", "words"),
    [
        (Holds(i("ghost"), iri("at"), i("dock")), "the goal names t:ghost, which is not in the world model"),
        (Holds(i("robot"), iri("near"), i("eraser")), "the goal reads `t:near`"),
    ],
)
def test_for_a_goal_that_cannot_be_planned_for_nothing_is_searched(goal: Condition, words: str) -> None:
    answer = solve(WIPING, LAB, goal)
    assert isinstance(answer, GaveUp) and not answer.searched
    assert answer.message.startswith(f"no plan was searched for: {words}")


def test_every_object_stands_once_with_its_most_specific_type_and_irrelevant_ones_are_left_out() -> None:
    problem = pose_problem(WIPING, LAB, CLEANED).problem
    names = {individual: name for name, individual in problem.names.items()}
    types = {each.name: problem.domain.names[each.type] for each in problem.objects}
    assert len(types) == len(problem.objects) == len(LAB.individuals)
    assert types[names[iri("eraser")]] == iri("Eraser") and types[names[iri("arm")]] == iri("CompliantArm")
    driving = pose_problem(library(DRIVE), LAB, Holds(i("robot"), iri("at"), i("wall"))).problem
    assert set(driving.names.values()) == set(map(iri, ("robot", "dock", "shelf", "wall")))


def test_classes_of_the_scene_itself_take_part() -> None:
    own = ClassTerm(iri=iri("Sponge"), parents=(iri("Eraser"),))
    vocabulary = msgspec.structs.replace(
        LAB.vocabulary, classes={**LAB.vocabulary.classes, own.iri: own}, prefixes=LAB.vocabulary.prefixes
    )
    state = WorldState.empty(vocabulary).with_changes(
        [
            *(individual(name, "Location") for name in ("shelf", "wall")),
            individual("robot", "Robot"),
            individual("arm", "Arm"),
            individual("gripper", "Gripper"),
            individual("board", "Board"),
            individual("eraser", "Sponge"),
            fact("robot", "at", "shelf"),
            fact("robot", "hasA", "arm"),
            fact("arm", "hasGripper", "gripper"),
            fact("shelf", "contain", "eraser"),
            fact("wall", "contain", "board"),
            assign("eraser", "weight", 1.0),
        ]
    )
    assert skills(solve(WIPING, state, CLEANED, (AStar(),))) == ["Pick", "Drive", "Clean"]


def test_a_plan_that_does_not_work_is_refused() -> None:
    result = solve(WIPING, LAB, CLEANED, (AStar(),))
    assert isinstance(result, Solved)
    steps = result.plan.steps
    validate(result.plan, WIPING, LAB, CLEANED)
    broken = {
        "step 1, Pick: `here` does not hold: t:robot at t:dock; needed: t:robot at t:shelf": steps[1:],
        "step 3, Clean: `here` does not hold": (*steps[:2], steps[3]),
        "the goal does not hold after the plan: t:board has no t:isClean": steps[:3],
        "step 1, Fly: there is no such skill": (Step("Fly", {}), *steps),
        "step 1, Drive: `to` is t:arm, which is not a t:Location": (
            Step("Drive", {**steps[0].arguments, "to": iri("arm")}),
            *steps[1:],
        ),
        "step 1, Drive: `from` is not bound": (Step("Drive", {"robot": iri("robot"), "to": iri("wall")}),),
    }
    for words, wrong in broken.items():
        with pytest.raises(PlanError) as caught:
            validate(Plan(tuple(wrong), 1.0), WIPING, LAB, CLEANED)
        assert words in str(caught.value)


class Liar:
    """A planner whose plans do not work."""

    name = "liar"

    def plan(self, problem: object, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        """Return a wrong plan."""
        return Solved(Plan((), 0.0), "proven", self.name)


def test_a_planner_is_never_trusted_and_the_next_one_is_asked() -> None:
    result = solve(WIPING, LAB, CLEANED, (Liar(),))
    assert isinstance(result, GaveUp) and "liar returned a plan that does not work" in result.why
    assert skills(solve(WIPING, LAB, CLEANED, (Liar(), AStar())))[-1] == "Clean"


def test_the_built_in_planner_gives_up_in_time() -> None:
    crowd = LAB.with_changes([individual(f"place-{n}", "Location") for n in range(40)])
    assert isinstance(solve(WIPING, crowd, CLEANED, (AStar(),), CancelToken(0.0)), GaveUp)


def test_durations_that_depend_on_things_are_minimised() -> None:
    heavy = PropertyOf(Variable("object"), iri("weight"))
    slow = msgspec.structs.replace(PICK, duration=heavy)
    state = LAB.with_changes(
        [
            individual("light", "Eraser"),
            assign("light", "weight", 0.5),
            assign("eraser", "weight", 1.5),
            fact("shelf", "contain", "light"),
        ]
    )
    for planner in list_planners():
        result = solve(library(DRIVE, slow, CLEAN), state, CLEANED, (planner,))
        assert isinstance(result, Solved)
        assert result.plan.steps[1].arguments["object"] == iri("light")
        assert result.plan.duration_s == 12 + 0.5 + 12 + 40
