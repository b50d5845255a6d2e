"""What a task says holds always: no plan breaks it, and its run fails when it is broken, whoever does that."""

from __future__ import annotations

import heapq
from itertools import count, product
from pathlib import Path
from time import sleep

import pytest
from click.testing import CliRunner, Result

import skillc as skillc_api
from skillc.cli.main import skillc
from skillc_compiler.goals.parsing import home_of, parse_goal
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.objectives.always import find_broken, plan_keeping
from skillc_runtime.planning.plan import Solved, Step, Unsolvable
from skillc_runtime.planning.planners import choose_planner, find_planners
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import PlanError, apply_step
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.world_state import WorldState
from symbolic.ward import compile_ward, write_ward
from waiting import LONG_S

MANIFEST = 'name = "ward"\nedition = 2\n\n[tool.run]\nbackend = "symbolic"\n'
LAB = "http://example.org/lab#"
SECOND_CART = 'lab:Cart-2 a ward:Cart ; skiros:at lab:Ward-2 ; skillc:deviceState "Idle" .\n'


@pytest.fixture
def ward(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = write_ward(tmp_path)
    (folder / "skillc.toml").write_text(MANIFEST, encoding="utf-8")
    monkeypatch.chdir(folder)
    return folder


def call(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def keep(ward: Path, condition: str) -> None:
    """State in the task `deliver` what holds always."""
    lines = [each for each in (ward / "tasks.skill").read_text().splitlines() if "always" not in each]
    at = next(number for number, each in enumerate(lines) if "goal" in each)
    (ward / "tasks.skill").write_text("\n".join([*lines[:at], f"    always {condition}", *lines[at:], ""]))


def test_no_plan_breaks_it(ward: Path) -> None:
    keep(ward, "not lab:Kitchen contain lab:Tray-1 or lab:Kitchen contain lab:Tray-2")
    planned = call("plan", "deliver").stdout
    assert planned.index("Tray-2, to: lab:Kitchen") < planned.index("Tray-1, to: lab:Kitchen"), "the costlier order"
    assert "4 steps, 60 s expected, proved optimal" in planned
    assert call("run", "deliver", "--tick-timeout", "0").exit_code == 0
    keep(ward, "forall c: Cart (not c at lab:Ward-2)")
    for each in (("plan", "deliver"), ("run", "deliver")):
        answer = call(*each)
        assert answer.exit_code == 3
        assert "there is no plan: each plan breaks what is to hold always; the best plan without it" in answer.stdout
        assert "at step 2, Go: `always forall c: ward:Cart (not c at lab:Ward-2)` is broken" in answer.stdout
    keep(ward, "lab:Cart-1 at lab:Kitchen")
    assert "is broken already: lab:Cart-1 at lab:Ward-1; needed" in call("run", "deliver").stdout
    assert "warning[cannot-start]" in call("check").stdout
    keep(ward, "not lab:Cart-1 at lab:Ward-9")
    assert "`always` names lab:Ward-9, which is not in the world model" in call("plan", "deliver").stdout


def test_the_command_line_adds_to_it(ward: Path) -> None:
    keep(ward, "not lab:Kitchen contain lab:Tray-1 or lab:Kitchen contain lab:Tray-2")
    more = ("--always", "not lab:Cart-1 at lab:Ward-2")
    for command in (("plan",), ("run", "--tick-timeout", "0")):
        answer = call(*command, "deliver", *more)
        assert answer.exit_code == 3 and "each plan breaks what is to hold always" in answer.stdout
    only = call("plan", "--scene", "ward.ttl", "--goal", "lab:Kitchen contain lab:Tray-1", "--always", "not lab:Cart-1")
    assert only.exit_code == 1 and "condition:1:5" in only.stderr
    with pytest.raises(skillc_api.PlanningError, match="each plan breaks what is to hold always"):
        skillc_api.plan("deliver", always=more[1:])


def test_what_forbids_facts_lets_steps_run_at_once(ward: Path) -> None:
    plan, scene = ("plan", "deliver", "--minimise", "makespan"), ward / "ward.ttl"
    keep(ward, "not lab:Kitchen contain lab:Tray-2 or lab:Kitchen contain lab:Tray-1")
    alone = call(*plan).stdout
    assert "over after 50 s with 50 s of work, best found, not proved optimal" in alone
    assert "note: steps that change what `always` reads run beside no other step" in alone
    scene.write_text(scene.read_text() + SECOND_CART)
    keep(ward, "not lab:Cart-1 at lab:Ward-2")
    assert "over after 20 s with 40 s of work, proved optimal" in call(*plan).stdout


def test_a_run_fails_when_it_is_broken(ward: Path) -> None:
    """By the facts that a step of a body leaves, and by somebody else."""
    body = "do seq { Carry(cart: lab:Cart-1, tray: lab:Tray-1, to: lab:Kitchen) Go(cart: lab:Cart-1, to: lab:Ward-2) }"
    never = "always forall c: Cart (not c at lab:Kitchen)"
    task = f'\ntask carry {{\n    scene "ward.ttl"\n    {body}\n    {never}\n}}\n'
    (ward / "tasks.skill").write_text((ward / "tasks.skill").read_text() + task, encoding="utf-8")
    failed = call("run", "carry", "--tick-timeout", "0", "--out", "report")
    why = "`always forall c: ward:Cart (not c at lab:Kitchen)` is broken: not for every ward:Cart: lab:Cart-1 at"
    assert failed.exit_code == 3 and why in failed.stdout and "time  20.0 s" in failed.stdout
    assert f"why: {why}" in call("why", "report").stdout
    keep(ward, "not lab:Tray-2.isWarm == true")
    operation = skillc_api.start("deliver", pace="real")
    while operation.state != "running":
        sleep(0.01)
    with operation.edit("somebody", "it is warm") as world:
        world.set("lab:Tray-2", "ward:isWarm", True)
    run = operation.wait(LONG_S)
    assert run.status == "failed" and run.failure is not None and "isWarm == true` is broken" in run.failure


def test_a_parameter_of_the_task_is_in_it(ward: Path) -> None:
    text = (ward / "tasks.skill").read_text().replace("task deliver {", "task deliver(away: Ward) {")
    (ward / "tasks.skill").write_text(text)
    keep(ward, "not lab:Cart-1 at away")
    assert "not lab:Cart-1 at lab:Ward-2" in call("plan", "deliver", "away=lab:Ward-2").stdout


CONDITIONS = (
    "forall c: Cart (not c at {place})",
    "not lab:Kitchen contain {tray} or {place} contain {other}",
    "{place} contain {tray} implies lab:Cart-1 at {place} or lab:Cart-1 at lab:Kitchen",
    "exists t: Tray (not lab:Kitchen contain t) or lab:Cart-1 at lab:Kitchen",
    "not (lab:Cart-1 at {place} and lab:Kitchen contain {tray})",
    "forall t: Tray (not {place} contain t or not lab:Kitchen contain {other})",
)


@pytest.mark.slow
def test_plans_are_the_best_that_keep_it(tmp_path: Path) -> None:
    """Planned by A*, as a search through all states of the world finds them."""
    library = compile_ward(tmp_path)
    state = load_scene(tmp_path / "ward" / "ward.ttl", library.vocabulary)
    goal = read("lab:Kitchen contain lab:Tray-1 and lab:Kitchen contain lab:Tray-2", library, state)
    planners = choose_planner(find_planners(None), "built-in").for_work
    seen = set()
    trays = (("lab:Tray-1", "lab:Tray-2"), ("lab:Tray-2", "lab:Tray-1"))
    for form, (tray, other), place in product(CONDITIONS, trays, ("lab:Ward-1", "lab:Ward-2", "lab:Kitchen")):
        always = (read(form.format(place=place, tray=tray, other=other), library, state),)
        found = plan_keeping(always, library, state, goal, lambda known, end: solve(known, state, end, planners))
        best = None if find_broken(always, state) else search(library, state, goal, always)
        assert isinstance(found, Unsolvable if best is None else Solved), (always, found)
        seen.add(best)
        assert best is None or (isinstance(found, Solved) and found.plan.duration_s == best)
    assert {None, 50.0, 60.0} <= seen


def read(text: str, library: SkillLibrary, state: WorldState) -> Condition:
    kinds = {f"{LAB}{name}": state.types(f"{LAB}{name}") for name in ("Tray-1", "Tray-2", "Cart-1", "Kitchen")}
    kinds |= {f"{LAB}{name}": state.types(f"{LAB}{name}") for name in ("Ward-1", "Ward-2")}
    told = parse_goal(text, library.vocabulary, kinds, state.vocabulary.prefixes, home_of(library), library.skills)
    assert told.value is not None, told.diagnostics
    return told.value


def search(library: SkillLibrary, state: WorldState, goal: Condition, always: tuple[Condition, ...]) -> float | None:
    """Return the least work of a plan, in s, by Dijkstra's algorithm over states of the world; None without one."""
    places, trays = [f"{LAB}{each}" for each in ("Ward-1", "Ward-2", "Kitchen")], [f"{LAB}Tray-{n}" for n in (1, 2)]
    cart = f"{LAB}Cart-1"
    steps = [
        (10.0, Step("Go", {"cart": cart, "to": to, "from": here})) for to, here in product(places, places) if to != here
    ]
    steps += [
        (20.0, Step("Carry", {"cart": cart, "tray": tray, "to": to, "from": here}))
        for tray, to, here in product(trays, places, places)
        if to != here
    ]
    number, done = count(), set()
    queue = [(0.0, next(number), state)]
    while queue:
        work_s, _, world = heapq.heappop(queue)
        at = tuple(world.pairs("http://rvmi.aau.dk/ontologies/skiros.owl#at"))
        key = (at, tuple(sorted(world.pairs("http://rvmi.aau.dk/ontologies/skiros.owl#contain"))))
        if key in done:
            continue
        done.add(key)
        if evaluate(goal, world, {}):
            return work_s
        for seconds, step in steps:
            try:
                after = apply_step(step, library, world)
            except PlanError:
                continue
            if find_broken(always, after) is None:
                heapq.heappush(queue, (work_s + seconds, next(number), after))
    return None
