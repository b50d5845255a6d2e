"""What the product makes of a drawn library, beside what its text says."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import inf
from random import Random

from columns.case import Case
from columns.meaning import Condition as Drawn
from columns.searching import can_reach, cheapest, walk
from columns.skills import Skill
from columns.worlds import LAB, World, from_state, normal, to_state
from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import Condition, Individual
from skillc_model.declared import act_as_declared
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.symbolic.cell import SymbolicCell
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.planning.arrangement import find_predecessors
from skillc_runtime.planning.plan import Branch, GaveUp, Plan, PlanResult, Solved, Step, Unsolvable
from skillc_runtime.planning.schedule import Planners
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import PlanError, apply_step
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState

DEADLINE_S = 20.0
TICKS_S = 0.9
"""Much more than what the ticks between the steps of a body take, in s; all durations are whole seconds."""


@dataclass
class Counts:
    """How many of each were compared, and how the planner answered."""

    of: Counter[str] = field(default_factory=Counter)
    why: list[object] = field(default_factory=list)

    def add(self, what: str) -> None:
        """Count one more."""
        self.of[what] += 1


def check_knowledge(case: Case, random: Random, counts: Counts) -> None:
    """The world model holds the same conditions and does the same steps, in the world and after one of them."""
    world = case.world
    for _ in range(2):
        state = to_state(world, case.library.vocabulary)
        assert normal(world) == from_state(state, world.people)
        for goal, task in zip(case.goals, _goals(case), strict=True):
            assert evaluate(task, state, {}) == goal.holds(world, {}), (goal.text, case.told)
            counts.add("conditions")
        for skill in case.skills:
            for names in skill.calls(world):
                found = _done(case.library, skill, names, state)
                expected = {label: normal(after) for label, after in skill.after(world, names).items()}
                assert {label: from_state(each, world.people) for label, each in found.items()} == expected, (
                    skill.name, names, found.keys(), expected.keys(), case.told,
                )  # fmt: skip
                counts.add("steps")
        world = walk(case.skills, world, random)


def _goals(case: Case) -> Iterator[Condition]:
    for at in range(len(case.goals)):
        goal = case.library.tasks[f"goal{at}"].goal
        assert goal is not None
        yield goal


def _done(library: SkillLibrary, skill: Skill, names: object, state: WorldState) -> dict[str, WorldState]:
    step = Step(skill.name, {name: LAB + each for name, each in names.items()})  # type: ignore[attr-defined]
    found = {}
    for label in [each.label for each in skill.outcomes] or [""]:
        try:
            found[label] = apply_step(step.with_outcome(label) if label else step, library, state)
        except PlanError:
            continue
    return found


def check_execution(case: Case, counts: Counts) -> None:
    """A body ends in the symbolic cell as it says, in one of the worlds that it says."""
    for at, body in enumerate(case.bodies):
        node = case.library.tasks[f"go{at}"].body
        assert node is not None
        within_s = case.library.tasks[f"go{at}"].within_s or inf
        ends = [(ok, normal(after)) for ok, after in body.ends(case.world, {})]
        end = execute(case, node, within_s)
        if end is None:
            counts.add("bodies refused")  # a step of it can never start, although the body may not come to it
        elif any(after.seconds > within_s for _, after in ends):
            late = end.why is not None and "was not done within" in end.why
            assert late or _fits(end, [each for each in ends if each[1].seconds < within_s]), (
                body.text, end, ends, case.told,
            )  # fmt: skip
            counts.add("bodies that are late")
        else:
            assert _fits(end, ends), (body.text, end, ends, case.told)
            counts.add("bodies that succeed" if end.ok else "bodies that fail")


def _fits(end: Ended, ends: list[tuple[bool, World]]) -> bool:
    """Whether it ended as it says, at the time that it says."""
    return any((end.ok, end.world) == each and abs(end.world.seconds - each[1].seconds) < TICKS_S for each in ends)


@dataclass(frozen=True)
class Ended:
    """How a body ended, in which world, and why it failed."""

    ok: bool
    world: World
    why: str | None


def execute(case: Case, node: tree.Node, within_s: float = inf) -> Ended | None:
    """Run a body in the symbolic cell; None if it is refused before it starts."""
    library = act_as_declared(case.library)
    state = to_state(case.world, library.vocabulary)
    limit_s = None if within_s == inf else within_s
    prepared = prepare_task(Assignment("go", state, ExecuteBody(node), within_s=limit_s), library)
    if not isinstance(prepared, PreparedTask):
        return None
    cell = SymbolicCell(WorldModel(state))
    ended = execute_task(prepared, library, cell)
    world = from_state(cell.world.snapshot(), case.world.people).later(cell.now)
    return Ended(ended.status == "succeeded", world, str(ended.failure))


def check_planner(case: Case, random: Random, counts: Counts) -> None:
    """The planner's answer is that of trying everything; its plan runs, in any order that it allows."""
    state = to_state(case.world, case.library.vocabulary)
    for drawn, goal in zip(case.goals, _goals(case), strict=True):
        best = cheapest(case.skills, case.world, drawn)
        if best is None:
            counts.add("too many states")
            continue
        answer = solve(case.library, state, goal, (AStar(),), CancelToken(DEADLINE_S))
        _check_answer(answer, case, drawn, best, counts)
        if isinstance(answer, Solved):
            _follow(answer.plan, case, case.world, drawn)
            _check_run(answer.plan, case, state, goal, drawn, counts)
            if answer.plan.steps and not any(case.skills[_number(case, each)].outcomes for each in answer.plan.steps):
                _check_orders(answer.plan, case, state, drawn, random)
                counts.add("plans run")


def _check_answer(answer: PlanResult, case: Case, goal: Drawn, best: float, counts: Counts) -> None:
    told = (answer, best, goal.text, case.told)
    looks = any(each.outcomes for each in case.skills)
    match answer:
        case Solved(plan=plan, optimal=optimal):
            assert best < float("inf"), told
            if not plan.branches:
                assert plan.duration_s >= best - 1e-6, told
                assert optimal != "proven" or looks or abs(plan.duration_s - best) < 1e-6, told
            counts.add(f"{'policy' if plan.branches else 'plan'}, {optimal}")
        case Unsolvable():
            assert best == float("inf"), told
            counts.add("no plan")
        case GaveUp(why=why):
            counts.why.append((why, told))
            if best == float("inf"):
                counts.add("gave up, and there is none")
            elif looks and not can_reach(case.skills, case.world, goal):
                counts.add("gave up, and no policy reaches it")
            else:
                counts.add("gave up, though there is a plan")


def _check_run(plan: Plan, case: Case, state: WorldState, goal: Condition, drawn: Drawn, counts: Counts) -> None:
    """A run for the goal reaches it, whatever comes, with steps side by side where its plan allows that."""
    ended = run_goal(goal, state, case.library)
    end = from_state(ended.backend.world.snapshot(), case.world.people)
    told = (ended.failure, plan, end, drawn.text, case.told)
    assert (ended.status == "succeeded") == drawn.holds(end, {}), told
    assert ended.status == "succeeded" or any(each.plan is None for each in _branches(plan)), told
    counts.add("policies run" if plan.branches else "goals reached")


def run_goal(goal: Condition, state: WorldState, library: SkillLibrary) -> Execution[SymbolicCell]:
    """Plan for a goal, and run the plan in the symbolic cell."""
    library = act_as_declared(library)
    prepared = prepare_task(Assignment("go", state, AchieveGoal(goal)), library, planners=Planners((AStar(),), None))
    assert isinstance(prepared, PreparedTask), prepared
    return execute_task(prepared, library, SymbolicCell(WorldModel(state)))


def _branches(plan: Plan) -> Iterator[Branch]:
    for each in plan.branches:
        yield each
        if each.plan is not None:
            yield from _branches(each.plan)


def _number(case: Case, step: Step) -> int:
    return [each.name for each in case.skills].index(step.skill)


def _names(step: Step) -> dict[str, str]:
    return {name: iri.removeprefix(LAB) for name, iri in step.arguments.items()}


def _follow(plan: Plan, case: Case, world: World, goal: Drawn) -> None:
    """Whatever comes, the goal is reached."""
    *steps, look = plan.steps or (None,)
    for step in steps if plan.branches else plan.steps:
        (world,) = case.skills[_number(case, step)].after(world, _names(step)).values()
    if not plan.branches:
        assert goal.holds(world, {}), (plan, goal.text, case.told)
        return
    assert look is not None
    ends = case.skills[_number(case, look)].after(world, _names(look))
    branches = {each.outcome: each.plan for each in plan.branches}
    assert set(ends) <= set(branches), (plan, goal.text, case.told)
    for label, after in ends.items():
        branch = branches[label]
        if branch is not None:
            _follow(branch, case, after, goal)


def _check_orders(plan: Plan, case: Case, state: WorldState, goal: Drawn, random: Random) -> None:
    """The steps reach the goal in another order that their arrangement allows, and so does the run of them."""
    before = find_predecessors(plan, case.library, state)
    left, order = set(range(len(plan.steps))), list[int]()
    while left:
        order.append(random.choice(sorted(each for each in left if not before[each] & left)))
        left.discard(order[-1])
    world = case.world
    for number in order:
        step = plan.steps[number]
        ends = case.skills[_number(case, step)].after(world, _names(step))
        assert len(ends) == 1, (plan, order, goal.text, case.told)
        (world,) = ends.values()
    assert goal.holds(world, {}), (plan, order, goal.text, case.told)
    calls = []
    for step in plan.steps:
        given = {name: Individual(iri) for name, iri in step.arguments.items()}
        calls.append(tree.Call(skill=step.skill, implementation=None, arguments=given, out=None, source=_PLACE))
    end = execute(case, tree.Sequence(children=tuple(calls), reactive=False, source=_PLACE))
    assert end is not None and end.ok and goal.holds(end.world, {}), (plan, end, goal.text, case.told)


_PLACE = Position("columns", 1, 1)
