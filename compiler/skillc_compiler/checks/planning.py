"""Skills that planners cannot use: without effects, with values to choose or count, or with colliding names."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Skill
from skillc_compiler.program.types import INT, Measure, Thing, UnknownType, describe_type, type_of
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_model.conditions import (
    Adjust,
    Assign,
    Effect,
    ForEach,
    Individual,
    Invoke,
    PropertyOf,
    Variable,
    exact_value,
    single_effect,
)
from skillc_model.pddl.kebab import to_kebab
from skillc_model.traversal import free_variables, walk
from skillc_rdf.vocabulary.types import local_name

NAMES = ("no-effect", "unplannable-parameter", "numeric-effect", "colliding-names")
UNPLANNABLE = "unplannable-construct"
"""What is reported of skills whose implementations are why planners leave them out."""
NEEDS = Need.TYPES
READS = Reads.NEIGHBOURS


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield warnings about planned skills, and an error for names that collide in PDDL."""
    for skill in program.skills.values():
        yield from check_skill(program, skill)
    yield from _check_names(program)


def check_skill(program: Program, skill: Skill) -> Iterator[Diagnostic]:
    """Yield the reasons in a planned skill's description why planners leave it out."""
    if "noplan" not in skill.flags:
        yield from _check_effect(skill)
        yield from _check_parameters(skill)
        yield from _check_numbers(program, skill)


def _check_effect(skill: Skill) -> Iterator[Diagnostic]:
    if not any(requirement.says_what_comes for requirement in skill.requirements):
        yield Diagnostic(
            "no-effect",
            skill.name_span,
            f"`{skill.name}` has no postcondition, so no plan can contain it",
            help="add a `post` with what it achieves, or `noplan`",
            severity="warning",
        )


def _check_parameters(skill: Skill) -> Iterator[Diagnostic]:
    for parameter in skill.parameters:
        if parameter.direction in ("in", "infer") and not isinstance(parameter.type, Thing | UnknownType):
            yield Diagnostic(
                "unplannable-parameter",
                parameter.span,
                f"the planner chooses individuals, not {describe_type(parameter.type)}, "
                f"so it cannot use `{skill.name}`",
                help="make the parameter `opt` with a default, read a property instead, or add `noplan`",
                severity="warning",
            )


def _check_numbers(program: Program, skill: Skill) -> Iterator[Diagnostic]:
    for post in (requirement for requirement in skill.requirements if requirement.says_what_comes):
        for effect in effects_of(post.condition):
            single = None if isinstance(effect, NoEffect) else single_effect(effect)
            if not isinstance(single, Assign | Adjust) or single.property not in program.vocabulary.properties:
                continue
            kind = type_of(program.vocabulary.properties[single.property].type)
            if (isinstance(kind, Measure) or kind == INT) and not _is_plannable(effect, skill, post.kind):
                yield Diagnostic(
                    "numeric-effect",
                    post.condition.span,
                    f"the planner leaves `{skill.name}` out: how it changes `{local_name(single.property)}` depends on "
                    "what is known only at run time",
                    help="add `noplan`, or let it depend on numbers of `in` and `infer` parameters alone",
                    severity="warning",
                )


def _is_plannable(effect: Effect | NoEffect, skill: Skill, kind: str) -> bool:
    """Whether a planner can compute a number: from constants and numbers of things that it chooses."""
    match effect:
        case Adjust():
            value = exact_value(effect)
        case Assign():
            value = effect.value
        case ForEach(effect=single):  # planned if all get the same: then its variable is not read
            return _is_plannable(single, skill, kind)
        case _:
            return False
    chosen = {each.name for each in skill.parameters if each.direction in ("in", "infer")}
    if value is None or kind != "post" or not free_variables(value) <= chosen:
        return False
    reads = [each for each in walk(value) if isinstance(each, PropertyOf | Invoke)]
    return all(isinstance(each, PropertyOf) and isinstance(each.of, Variable | Individual) for each in reads)


def _check_names(program: Program) -> Iterator[Diagnostic]:
    seen: dict[str, Skill] = {}
    for skill in program.skills.values():
        first = seen.setdefault(to_kebab(skill.name), skill)
        if first is not skill:
            yield Diagnostic(
                "colliding-names",
                skill.name_span,
                f"`{skill.name}` and `{first.name}` have the same name in PDDL: `{to_kebab(skill.name)}`",
                help="give one of them another name",
                labels=(Label(first.name_span, "the other one"),),
            )
