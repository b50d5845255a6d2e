"""The answer of a planner, as text and as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import assert_never

import msgspec

from skillc.services.reporting.reporter import format_count
from skillc.services.tasks.loading import LoadedTask
from skillc_model.skills import PlanMeasure, TaskPart
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.execution.task_planning import find_several
from skillc_runtime.planning.plan import GaveUp, Plan, Solved, Step, Unsolvable, describe_quality
from skillc_runtime.planning.schedule import PlanAnswer, Scheduled
from skillc_runtime.recording.space_claim import SpaceClaim

NAMED = 3
"""How many of the things that a planner left out are named in text."""


def format_plan(answer: PlanAnswer, loaded: LoadedTask, space: SpaceClaim | None = None) -> str:
    """Return the steps, one per line (those of a schedule with their times), or why there is no plan.

    `space` is what is known about them in space.
    """
    text = _format(answer, loaded)
    return text if space is None else f"{text}\n{space.text}"


def _format(answer: PlanAnswer, loaded: LoadedTask) -> str:
    match answer:
        case Solved(plan=plan):
            lines = [*_steps(plan, loaded)]
            total = f"{format_count(plan.count, 'step')}, {describe_expected(answer)} ({answer.planner})"
            more = (*_policy(plan), *_tasks(answer, loaded), *_assumed(answer), *_left_out(answer, loaded))
            return "\n".join([*lines, total, *more])
        case Scheduled():
            return _schedule_text(answer, loaded)
        case Unsolvable() | GaveUp():
            return f"{answer.message}\n{answer.why}" if answer.causes else answer.message
        case _:
            assert_never(answer)


def describe_expected(answer: Solved | Scheduled) -> str:
    """Return how long a plan takes, what it costs if that is minimised, and what is known of that, in one line."""
    match answer:
        case Solved(plan=plan, cost=cost):
            expected = f"{plan.duration_s:g} s expected" + (f", {plan.worst_s:g} s at most" if plan.branches else "")
            expected += "" if cost is None else f", cost {cost:g}"
        case Scheduled(plan=plan, schedule=schedule):
            expected = f"over after {schedule.makespan_s:g} s with {plan.duration_s:g} s of work"
        case _:
            assert_never(answer)
    return f"{expected}, {_quality(answer)}"


def _steps(plan: Plan, loaded: LoadedTask, first: int = 1, indent: str = "") -> Iterator[str]:
    """Yield a line for each step, those of each branch below what comes of the step before."""
    yield from (f"{indent}{number}  {_call(step, loaded)}" for number, step in enumerate(plan.steps, first))
    for branch in plan.branches:
        yield f"{indent}   {branch.outcome} ({100.0 * branch.likely:.3g} %):"
        if branch.plan is None:
            yield f"{indent}      planned when it comes"
        elif not branch.plan.steps:
            yield f"{indent}      nothing is left to do"
        else:
            yield from _steps(branch.plan, loaded, first + len(plan.steps), f"{indent}      ")


def _policy(plan: Plan) -> Iterator[str]:
    """Yield what is known of the branches of a policy."""
    left_open = len([*plan.list_open()])
    if left_open:
        yield f"each branch but {left_open} reaches the goal; these are planned when they come, as there are too many"
    elif plan.branches:
        yield "each branch reaches the goal"


def _schedule_text(answer: Scheduled, loaded: LoadedTask) -> str:
    timed = answer.schedule.steps
    lines = [f"{each.start_s:7.1f} s  {each.duration_s:6.1f} s  {_call(each.step, loaded)}" for each in timed]
    lines.append(f"{format_count(len(timed), 'step')}, {describe_expected(answer)} ({answer.planner})")
    lines += [f"times: {answer.times}", *_tasks(answer, loaded), *_assumed(answer), *_left_out(answer, loaded)]
    return "\n".join(lines if answer.note is None else [*lines, f"note: {answer.note}"])


def _tasks(answer: Solved | Scheduled, loaded: LoadedTask) -> Iterator[str]:
    """Yield when each of several tasks that are planned as one is done."""
    for part, done_s in _done(answer, loaded):
        limit = "" if part.within_s is None else f", within {part.within_s:g} s"
        yield f"{part.name}: done after {done_s:g} s{limit}"


def _done(answer: Solved | Scheduled, loaded: LoadedTask) -> list[tuple[TaskPart, float]]:
    """Return several tasks that are planned as one, each with the time in s after which it is done."""
    tasks = None if answer.plan.branches else find_several(loaded.assignment, loaded.library)
    return [] if tasks is None else [*zip(tasks.parts, tasks.done_s(tasks.schedule_of(answer)), strict=True)]


def _quality(answer: Solved | Scheduled) -> str:
    costs = isinstance(answer, Solved) and answer.cost is not None
    return describe_quality(answer.optimal, answer.left_out, answer.at_least_s, costs)


def _assumed(answer: Solved | Scheduled) -> Iterator[str]:
    """Yield the durations that were assumed because they are known only after execution."""
    yield from (f"assumed: {each}" for each in answer.assumptions)


def _left_out(answer: Solved | Scheduled, loaded: LoadedTask) -> Iterator[str]:
    """Yield what the planner left out, unless that can be proved to make no difference."""
    short = loaded.assignment.state.vocabulary.short
    for each in answer.left_out:
        if not each.harmless:
            more = len(each.what) - NAMED
            names = ", ".join(short(iri) for iri in each.what[:NAMED]) + (f" and {more} more" if more > 0 else "")
            them = "it" if len(each.what) == 1 else "them"
            needed = "yet no better plan needs" if answer.optimal == "proven" else "a better plan may need"
            yield f"planned without {names}: {each.why}; {needed} {them}"


def plan_as_json(answer: PlanAnswer, loaded: LoadedTask, space: SpaceClaim | None = None) -> str:
    """Return `describe_answer` as one JSON object, with the names that people type in place of IRIs."""
    return json.dumps(_name(describe_answer(answer, loaded, space)), indent=2)


def describe_answer(answer: PlanAnswer, loaded: LoadedTask, space: SpaceClaim | None) -> dict[str, object]:
    """Return status, steps with source lines, optimality, planner and space, or the reason, as plain data."""
    described = _describe(answer, loaded)
    return described if space is None else {**described, "space": msgspec.to_builtins(space)}


def _name(described: object) -> object:
    """Return plain data with the names of individuals that people type, in place of their IRIs with labels."""
    match described:
        case {"iri": str(), "label": str(label)}:
            return label
        case dict():
            return {name: _name(each) for name, each in described.items()}
        case list() | tuple():
            return [_name(each) for each in described]
        case _:
            return described


def _describe(answer: PlanAnswer, loaded: LoadedTask) -> dict[str, object]:
    match answer:
        case Solved(plan=plan):
            steps = [_step(step, loaded) for step in plan.steps]
            branches = {"branches": _branches(plan, loaded), "worst_s": plan.worst_s} if plan.branches else {}
            known = {"duration_s": plan.duration_s, "cost": answer.cost, "planner": answer.planner, **branches}
            return {**_solved(answer, steps, loaded), **known}
        case Scheduled(schedule=schedule, plan=plan):
            steps = [
                {**_step(each.step, loaded), "start_s": each.start_s, "duration_s": each.duration_s}
                for each in schedule.steps
            ]
            times = {"makespan_s": schedule.makespan_s, "duration_s": plan.duration_s}
            notes = {"planner": answer.planner, "times": answer.times, "note": answer.note}
            return {**_solved(answer, steps, loaded), **times, **notes}
        case Unsolvable(why=why, causes=causes):
            return {"status": "unsolvable", "failure": why, "causes": list(causes)}
        case GaveUp(why=why, causes=causes):
            return {"status": "gave-up", "failure": why, "causes": list(causes), "searched": answer.searched}
        case _:
            assert_never(answer)


def _branches(plan: Plan, loaded: LoadedTask) -> list[dict[str, object]]:
    """Return the branches of a policy; the plan of one that is planned when it comes is None."""
    return [
        {
            "outcome": branch.outcome,
            "likely": branch.likely,
            "plan": None if branch.plan is None else [_step(step, loaded) for step in branch.plan.steps],
            "duration_s": None if branch.plan is None else branch.plan.duration_s,
            "branches": [] if branch.plan is None else _branches(branch.plan, loaded),
        }
        for branch in plan.branches
    ]


def _solved(answer: Solved | Scheduled, steps: list[dict[str, object]], loaded: LoadedTask) -> dict[str, object]:
    short = loaded.assignment.state.vocabulary.short
    done = [{"task": part.name, "done_s": done_s, "within_s": part.within_s} for part, done_s in _done(answer, loaded)]
    return {
        "status": "solved",
        "minimise": _measure(loaded),
        "plan": steps,
        "plan_optimal": answer.optimal == "proven",
        "optimal": answer.optimal,
        "at_least_s": answer.at_least_s,
        "quality": _quality(answer),
        "assumptions": list(answer.assumptions),
        "left_out": [
            {"kind": each.kind, "what": [short(iri) for iri in each.what], "why": each.why, "harmless": each.harmless}
            for each in answer.left_out
        ],
        **({"tasks": done} if done else {}),
    }


def _measure(loaded: LoadedTask) -> PlanMeasure:
    """Return what the plan of a task has little of."""
    objective = loaded.assignment.objective
    return objective.minimise or "work" if isinstance(objective, AchieveGoal) else "work"


def _step(step: Step, loaded: LoadedTask) -> dict[str, object]:
    source = str(loaded.library.skills[step.skill].source)
    return {"skill": step.skill, "arguments": _arguments(step, loaded), "source": source}


def _call(step: Step, loaded: LoadedTask) -> str:
    return f"{step.skill}({', '.join(f'{name}: {value}' for name, value in _arguments(step, loaded).items())})"


def _arguments(step: Step, loaded: LoadedTask) -> dict[str, str]:
    short = loaded.assignment.state.vocabulary.short
    return {name: short(iri) for name, iri in step.arguments.items()}
