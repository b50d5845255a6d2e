"""Turns a plan into a body: calls in the arrangement of its steps, each skipped if what it would achieve holds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from msgspec import structs

from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import And, Condition, Expression, Individual, Not, Or
from skillc_model.rewriting import substitute
from skillc_model.skills import SkillLibrary
from skillc_model.traversal import free_variables
from skillc_runtime.planning.arrangement import Arrangement, InParallel, InSeries
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.recording.space_claim import SpaceClaim


def build_plan_body(
    plan: Plan, arrangement: Arrangement, library: SkillLibrary, space: SpaceClaim | None = None
) -> tree.Node:
    """Return the body that runs the steps of a plan in the given arrangement.

    Steps are tried first with the implementations that `space`, what is known of the plan in space, names.
    """
    if not plan.steps:
        return tree.Sequence(children=(), reactive=False, source=Position(path=library.name, line=1, column=1))
    ways = {} if space is None else space.way_names
    steps = [_build_step(each, library, ways.get(number)) for number, each in enumerate(plan.steps)]
    return _build_arrangement(arrangement, steps)


def achieved_condition(step: Step, library: SkillLibrary) -> Condition | None:
    """Return the condition that a step is to achieve: its posts, that what it senses is known, and what comes of it.

    None if there is no such condition, if one is not ground, or if something comes of it that it does not sense.
    """
    individuals = {name: Individual(iri) for name, iri in step.arguments.items()}
    skill = library.skills[step.skill]
    if skill.outcomes and not skill.senses:
        return None
    come = [each.condition for each in skill.outcomes if step.outcome in ("", each.label)]
    wanted = (*(post.achieved for post in skill.post), *skill.senses, *([Or(tuple(come))] if come else []))
    if not wanted or any(free_variables(each) - individuals.keys() for each in wanted):
        return None
    return And(tuple(substitute(each, individuals) for each in wanted))


def _build_arrangement(arrangement: Arrangement, steps: Sequence[tree.Node]) -> tree.Node:
    match arrangement:
        case int():
            return steps[arrangement]
        case InSeries(parts):
            children = tuple(_build_arrangement(part, steps) for part in parts)
            return tree.Sequence(children=children, reactive=False, source=children[0].source)
        case InParallel(parts, after):
            children = tuple(_build_arrangement(part, steps) for part in parts)
            return tree.Parallel(policy="all", children=children, source=children[0].source, after=after)
        case _:
            assert_never(arrangement)


def _build_step(step: Step, library: SkillLibrary, way: str | None) -> tree.Node:
    skill = library.skills[step.skill]
    arguments: dict[str, Expression] = {name: Individual(iri) for name, iri in step.arguments.items()}
    call: tree.Node = tree.Call(
        skill=skill.name, implementation=None, arguments=arguments, out=None, source=skill.source
    )
    if way is not None:
        call = tree.Selector(
            children=(structs.replace(call, implementation=way), call), reactive=False, source=skill.source
        )
    achieved = achieved_condition(step, library)
    if achieved is None:
        return call
    text = " and ".join(post.text for post in skill.post) or "what it senses is known"
    return tree.If(condition=Not(achieved), text=f"not ({text})", then=call, orelse=None, source=skill.source)
