"""A planner's answer as text and as JSON."""

from __future__ import annotations

import json
from typing import assert_never

from skillc_runtime.commands._mission import Mission
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Step, Unsolvable


def as_text(answer: PlanResult, mission: Mission) -> str:
    """Return the steps, one a line, or why there are none."""
    match answer:
        case Solved(plan=plan, optimal=optimal, planner=planner):
            quality = "proved optimal" if optimal == "proven" else "best found, not proved optimal"
            lines = [f"{number}  {_call(step, mission)}" for number, step in enumerate(plan.steps, 1)]
            return "\n".join(
                [*lines, f"{len(plan.steps)} steps, {plan.duration_s:g} s expected, {quality} ({planner})"]
            )
        case Unsolvable(why=why):
            return f"there is no plan: {why}"
        case GaveUp(why=why):
            return f"no plan was found: {why}"
        case _:
            assert_never(answer)


def as_json(answer: PlanResult, mission: Mission) -> str:
    """Return one JSON object: status, steps with source lines, optimality, planner, or the reason."""
    match answer:
        case Solved(plan=plan, optimal=optimal, planner=planner):
            document: dict[str, object] = {
                "status": "solved",
                "plan": [
                    {
                        "skill": step.skill,
                        "arguments": _arguments(step, mission),
                        "source": str(mission.library.skills[step.skill].source),
                    }
                    for step in plan.steps
                ],
                "plan_optimal": optimal == "proven",
                "duration_s": plan.duration_s,
                "planner": planner,
            }
        case Unsolvable(why=why):
            document = {"status": "unsolvable", "failure": why}
        case GaveUp(why=why):
            document = {"status": "gave-up", "failure": why}
        case _:
            assert_never(answer)
    return json.dumps(document, indent=2)


def _call(step: Step, mission: Mission) -> str:
    return f"{step.skill}({', '.join(f'{name}: {value}' for name, value in _arguments(step, mission).items())})"


def _arguments(step: Step, mission: Mission) -> dict[str, str]:
    short = mission.assignment.state.vocabulary.short
    return {name: short(iri) for name, iri in step.arguments.items()}
