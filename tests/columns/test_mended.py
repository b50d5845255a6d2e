"""What random libraries have shown, written small."""

from __future__ import annotations

from columns.case import Case, vocabulary
from columns.columns import Ended, execute, run_goal
from columns.worlds import TERMS, Fact, World, from_state, to_state
from skillc_compiler.pipeline import compile as compile_sources
from skillc_dsl.source import Source
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import Solved, Unsolvable
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve

STAND_IN = 'run python "skillc.primitives:StandIn"'


def run(text: str, body: str, *facts: Fact) -> Ended:
    """Run a body in a world with a tray and a spot."""
    text = f'{TERMS}{text}\ntask go {{\n    scene "none.ttl"\n    do {body}\n}}\n'
    library = compile_sources([Source("columns.skill", text)], vocabulary(), {}, "columns", {}).value
    node = library.tasks["go"].body
    assert node is not None
    ended = execute(Case([], [], [], [World(("S1", "T1"), frozenset(facts))], text, library), node)
    assert ended is not None
    return ended


def test_what_is_known_of_an_outcome_need_not_be_sensed_again() -> None:
    toss = f"""
skill Toss {{
    in a: Tray
    outcome up:   a.open == true and not a lies _
    outcome down: a.open == false and not a lies _
}}
impl one of Toss {{ {STAND_IN} }}
"""
    ended = run(toss, "Toss(a: lab:T1)", ("at", "T1", "S1"))
    assert ended.ok and ended.world.value("T1", "open") is not None, ended.why


def test_looking_does_not_unlearn_a_number_that_is_known() -> None:
    look = f"""
skill Look {{
    in      a: Tray
    senses  a.level
    outcome full:  a.level == 3
    outcome empty: a.level == 0
}}
impl one of Look {{ {STAND_IN} }}
task known {{
    scene "none.ttl"
    goal  lab:T1 has level
}}
task full {{
    scene "none.ttl"
    goal  lab:T1.level == 3
}}
"""
    library = compile_sources([Source("columns.skill", TERMS + look)], vocabulary(), {}, "columns", {}).value
    goals = {name: each.goal for name, each in library.tasks.items() if each.goal is not None}
    unknown, empty = World(("S1", "T1"), frozenset()), World(("S1", "T1"), frozenset({("level", "T1", 0)}))
    found = solve(library, to_state(unknown, library.vocabulary), goals["known"], (AStar(),), CancelToken(20.0))
    assert isinstance(found, Solved) and {each.outcome for each in found.plan.branches} == {"full", "empty"}, found
    never = solve(library, to_state(empty, library.vocabulary), goals["full"], (AStar(),), CancelToken(20.0))
    assert isinstance(never, Unsolvable), never


def test_why_a_number_is_not_reached_is_said_in_the_words_of_the_language() -> None:
    fill = f"""
skill Fill {{
    in   a: Item
    pre  a.open == false
    post a.fill := 100 %
}}
impl one of Fill {{ {STAND_IN} }}
skill Close {{
    in    a: Item
    infer on: Tray
    pre   a lies on
    post  forall x: Item (x.open == false when forall y: Item (a.lies == y.lies))
}}
impl one of Close {{ {STAND_IN} }}
task full {{
    scene "none.ttl"
    goal  lab:I1.fill == 1
}}
"""
    library = compile_sources([Source("columns.skill", TERMS + fill)], vocabulary(), {}, "columns", {}).value
    (goal,) = [each.goal for each in library.tasks.values()]
    facts = {("open", "I1", True), ("lies", "I1", "T1"), ("fill", "I1", 0.0), ("fill", "T1", 0.5), ("open", "T1", True)}
    state = to_state(World(("I1", "T1"), frozenset(facts)), library.vocabulary)
    assert goal is not None
    answer = solve(library, state, goal, (AStar(),), CancelToken(20.0))
    assert isinstance(answer, Unsolvable) and "`lab:I1.fill == 1` cannot be reached: Fill" in answer.why
    assert "--" not in answer.why


def test_a_look_for_what_else_comes_of_it_is_taken_where_the_value_is_known() -> None:
    text = f"""
skill Look {{
    in      a: Tray
    senses  a.level
    outcome full:  a.level == 3
    outcome empty: a.level == 0 and a.grade == Bad
}}
impl one of Look {{ {STAND_IN} }}
skill Open {{
    in   a: Tray
    hold a.grade != Good
    post a.open == true
}}
impl one of Open {{ {STAND_IN} }}
task open {{
    scene "none.ttl"
    goal  lab:T1.open == true
}}
"""
    library = compile_sources([Source("columns.skill", TERMS + text)], vocabulary(), {}, "columns", {}).value
    state = to_state(World(("T1",), frozenset({("level", "T1", 0), ("grade", "T1", "Good")})), library.vocabulary)
    goal = library.tasks["open"].goal
    assert goal is not None
    ended = run_goal(goal, state, library)
    assert ended.status == "succeeded", ended.failure
    assert from_state(ended.backend.world.snapshot(), ("T1",)).value("T1", "grade") == "Bad"
