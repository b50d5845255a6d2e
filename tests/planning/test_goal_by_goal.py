"""Large scenes with large goals: a first plan, goal by goal, in the part of the scene that is near each part of it."""

from __future__ import annotations

import random

import pytest

from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.pipeline import compile as compile_sources
from skillc_dsl.source import Source
from skillc_model.conditions import And, Condition, Holds, Individual
from skillc_model.pddl.problem import Problem
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved
from skillc_runtime.planning.problem.neighbourhood import NARROWEST
from skillc_runtime.planning.problem.shortest_paths import Links, ShortestPaths
from skillc_runtime.planning.progress import PlanningProgress, ReportProgress, ignore_progress
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import validate
from skillc_runtime.world.state.changes import AddIndividual, AddRelation
from skillc_runtime.world.state.world_state import WorldState

NS = "https://w3id.org/skillc/library/vans#"
TEXT = """use skiros

class Stop < Location
class Van  < Location
class Crate < Product
class Pallet < Product, Location
relation road(Stop, Stop)  symmetric
relation stands(Van, Stop)
relation lies(Product, Location)

skill Drive {
    in    van:  Van
    infer from: Stop
    in    to:   Stop
    pre   van stands from
    pre   from road to
    post  van stands to
    post  not van stands from
    duration 5 s
}

skill Load {
    in    van:   Van
    in    crate: Crate
    infer from:  Stop
    pre   van stands from
    pre   crate lies from
    pre   not _ lies van
    post  crate lies van
    post  not crate lies from
    duration 2 s
}

skill Unload {
    in    van:   Van
    in    crate: Crate
    in    to:    Stop
    pre   van stands to
    pre   crate lies van
    post  crate lies to
    post  not crate lies van
    duration 2 s
}

skill Stack {
    in    pallet: Pallet
    in    on:     Pallet
    infer from:   Location
    pre   pallet lies from
    pre   not pallet == on
    pre   not _ lies pallet
    pre   not _ lies on
    post  pallet lies on
    post  not pallet lies from
    duration 1 s
}

impl one of Drive { run python "skillc.primitives:StandIn" }
impl one of Load { run python "skillc.primitives:StandIn" }
impl one of Unload { run python "skillc.primitives:StandIn" }
impl one of Stack { run python "skillc.primitives:StandIn" }
"""


def compile_text(text: str) -> SkillLibrary:
    outcome = compile_sources([Source("vans.skill", text)], load_vocabulary(), {}, "vans", {})
    assert not outcome.diagnostics, outcome.diagnostics
    return outcome.value


LIBRARY = compile_text(TEXT)
KINDS = {"s": "Stop", "v": "Van", "c": "Crate", "p": "Pallet"}


def world(*facts: str) -> WorldState:
    """Return a world of facts such as `c1 lies s2`."""
    triples = [each.split() for each in facts]
    things = dict.fromkeys(name for one, _, other in triples for name in (one, other))
    added = [AddIndividual(NS + each, (NS + KINDS[each[0]],)) for each in things]
    return WorldState.empty(LIBRARY.vocabulary).with_changes(
        [*added, *(AddRelation(NS + one, NS + relation, NS + other) for one, relation, other in triples)]
    )


def goal(*facts: str) -> Condition:
    triples = [each.split() for each in facts]
    return And(tuple(Holds(Individual(NS + one), NS + name, Individual(NS + other)) for one, name, other in triples))


class Idle:
    """A planner that has no time."""

    name = "idle"

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        return GaveUp("it has no time")


def grid(width: int) -> list[str]:
    """Return roads between the stops of a square grid."""
    right = (f"s{row * width + n} road s{row * width + n + 1}" for row in range(width) for n in range(width - 1))
    down = (f"s{n} road s{n + width}" for n in range(width * (width - 1)))
    return [*right, *down]


@pytest.mark.parametrize("seed", range(1))
def test_many_vans_on_many_roads_have_a_plan_for_many_crates(seed: int) -> None:
    draw, width = random.Random(seed), 10
    stops = range(width * width)
    vans = [f"v{n} stands s{draw.choice(stops)}" for n in range(4)]
    crates = [f"c{n} lies s{draw.choice(stops)}" for n in range(150)]
    wanted = goal(*(f"c{n} lies s{draw.choice(stops)}" for n in range(4)))
    state, told, cancel = world(*grid(width), *vans, *crates), list[float](), CancelToken(60.0)

    def stop_when_found(progress: PlanningProgress) -> None:
        if progress.best_s is not None:
            told.append(progress.best_s)
            cancel.cancel("that is enough")

    found = solve(LIBRARY, state, wanted, (Idle(),), cancel, report=stop_when_found)
    assert isinstance(found, Solved) and found.optimal == "best found" and found.planner == "greedy search"
    validate(found.plan, LIBRARY, state, wanted)
    assert told == [found.plan.duration_s]
    assert any("far from" in each.why for each in found.left_out)


@pytest.mark.parametrize("order", [("p1 lies p2", "p2 lies p3"), ("p2 lies p3", "p1 lies p2")])
def test_what_breaks_a_part_that_was_reached_is_planned_together_with_it(order: tuple[str, str]) -> None:
    crowd = (f"p{n} lies s{n}" for n in range(10, 130))
    state = world("p1 lies s1", "p2 lies p1", "p3 lies s1", "p4 lies s2", *crowd)
    found = solve(LIBRARY, state, goal(*order), (Idle(),), CancelToken(60.0))
    assert isinstance(found, Solved)
    validate(found.plan, LIBRARY, state, goal(*order))


def test_where_no_part_has_a_plan_nothing_is_claimed() -> None:
    state = world(*grid(10), "c1 lies s1", *(f"c{n} lies s{n % 100}" for n in range(2, 50)))
    found = solve(LIBRARY, state, goal("c1 lies s5", "c2 lies s6"), (Idle(),), CancelToken(60.0), size=NARROWEST)
    assert isinstance(found, GaveUp)


def test_paths_join_what_is_named_along_the_shortest_ways() -> None:
    state = world(
        *(f"s{n} road s{n + 1}" for n in range(9)), "v1 stands s0", "c1 lies s9", "s2 road s20", "s20 road s21"
    )
    links = Links(state, (NS + "road", NS + "stands", NS + "lies"), state.individuals)
    paths = ShortestPaths(links, {NS + "v1", NS + "c1"})
    assert paths.find_between() == {f"{NS}s{n}" for n in range(10)}
    assert paths.find_nearest({NS + "s20", NS + "s21"}, 1) == (NS + "s20",)
    assert list(paths.trace(NS + "s20"))[:2] == [NS + "s20", NS + "s2"]
