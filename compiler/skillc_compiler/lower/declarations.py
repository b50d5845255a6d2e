"""From typed skills, implementations and tasks to those of the library: constants folded, refinements merged."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import structs

from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.logic.number_changes import needs_of_changes
from skillc_compiler.lower.bodies import lower_node
from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.typed import (
    Implementation,
    Parameter,
    Pause,
    Property,
    Requirement,
    Skill,
    Task,
    Test,
    TypedNode,
    VerifyEvent,
)
from skillc_dsl import syntax as s
from skillc_dsl.descriptions.members import FLAGS
from skillc_dsl.units import to_si
from skillc_model import properties
from skillc_model import skills as library
from skillc_model.conditions import Adjust, Effect, Expression, ForEach, Tolerance
from skillc_model.rewriting import constant_number, fold


def lower_skill(typed: Skill, implementations: Sequence[str]) -> library.Skill:
    """Return a description; `implementations` are the names of its implementations in rank order."""
    labelled = label_requirements(typed.requirements)
    return library.Skill(
        name=typed.name,
        doc=typed.doc,
        parameters=tuple(_parameter(p) for p in typed.parameters),
        pre=_preconditions(labelled),
        hold=_requirements(labelled, "hold"),
        post=_posts(labelled),
        possible=_requirements(labelled, "possible"),
        senses=tuple(each.known for each in typed.senses if each.known is not None),
        outcomes=_outcomes(typed),
        duration=_expression(typed.duration),
        cost=_expression(typed.cost),
        uses=_devices(typed, "uses"),
        shares=_devices(typed, "shares"),
        pause=_pause(typed.pause),
        implementations=tuple(implementations),
        source=typed.span.start,
        **{flag.field: flag.value for flag in FLAGS if flag.keyword in typed.flags},
    )


def lower_implementation(typed: Implementation, body: TypedNode | s.RunPython) -> library.Implementation:
    """Return an implementation with the description's conditions before its own."""
    labelled = label_requirements((*typed.skill.requirements, *typed.requirements))
    return library.Implementation(
        name=typed.name,
        skill=typed.skill.name,
        doc=typed.doc,
        parameters=tuple(_parameter(p) for p in typed.parameters),
        pre=_preconditions(labelled),
        hold=_requirements(labelled, "hold"),
        post=_posts(labelled),
        duration=_expression(typed.duration or typed.skill.duration),
        prefer=typed.prefer,
        lets=tuple(library.Let(let.name.text, fold(let.value.meaning)) for let in typed.lets),
        outputs=tuple(library.Let(each.name.text, fold(each.value.meaning)) for each in typed.outputs),
        body=library.Compound(lower_node(body))
        if isinstance(body, TypedNode)
        else library.Primitive(body.target.value),
        verify=tuple(_property(each) for each in typed.verify),
        source=typed.span.start,
    )


def lower_task(typed: Task) -> library.Task:
    """Return a task."""
    return library.Task(
        name=typed.name,
        doc=typed.doc,
        parameters=tuple(_parameter(p) for p in typed.parameters),
        scene=typed.scene,
        goal=fold(typed.goal.meaning) if typed.goal else None,
        goal_text=typed.goal_text,
        body=lower_node(typed.body) if typed.body else None,
        backend=typed.backend.text if typed.backend else None,
        within_s=constant_number(typed.within.meaning) if typed.within else None,
        minimise=typed.minimise.measure if typed.minimise else None,
        always=tuple(fold(each.meaning) for each in typed.always),
        source=typed.span.start,
    )


def lower_test(typed: Test) -> library.Test:
    """Return a test."""
    started = (effect for each in typed.starts for effect in effects_of(each))
    return library.Test(
        **structs.asdict(lower_task(typed)),
        starts=tuple(each for each in started if not isinstance(each, NoEffect)),
        outcomes={each.skill.name: each.outcome.text for each in typed.outcomes if each.skill is not None},
        expects=tuple(
            library.Expectation(
                condition=fold(each.condition.meaning) if each.condition else None,
                failure=each.failure,
                text=each.text,
                source=each.span.start,
            )
            for each in typed.expects
        ),
    )


def label_requirements(requirements: Sequence[Requirement]) -> list[tuple[str, Requirement]]:
    """Return the conditions with their labels; one without a label is named by kind and number, such as `pre1`."""
    taken = {r.label.text for r in requirements if r.label}
    counts = {"pre": 0, "hold": 0, "post": 0, "possible": 0, "outcome": 0}
    labelled = []
    for requirement in requirements:
        counts[requirement.kind] += 1
        name = requirement.label.text if requirement.label else f"{requirement.kind}{counts[requirement.kind]}"
        while requirement.label is None and name in taken:
            name += "_"
        taken.add(name)
        labelled.append((name, requirement))
    return labelled


def _requirements(labelled: Sequence[tuple[str, Requirement]], kind: str) -> tuple[library.Requirement, ...]:
    return tuple(
        library.Requirement(label=name, condition=fold(r.condition.meaning), text=r.text, source=r.span.start)
        for name, r in labelled
        if r.kind == kind
    )


def _preconditions(labelled: Sequence[tuple[str, Requirement]]) -> tuple[library.Requirement, ...]:
    """Return the preconditions, those included that changes of numbers imply."""
    implied = (
        library.Requirement(
            label=f"{name}_range", condition=fold(need), text=f"{r.text} stays in its range", source=r.span.start
        )
        for name, r in labelled
        if r.kind == "post"
        for need in needs_of_changes(r.condition)
    )
    return (*_requirements(labelled, "pre"), *implied)


def _posts(labelled: Sequence[tuple[str, Requirement]]) -> tuple[library.Post, ...]:
    return tuple(
        library.Post(
            label=name,
            condition=fold(r.condition.meaning),
            effects=_effects(r),
            sensed=r.sensed,
            text=r.text,
            source=r.span.start,
        )
        for name, r in labelled
        if r.kind == "post"
    )


def _effects(requirement: Requirement) -> tuple[Effect, ...]:
    effects = (effect for effect in effects_of(requirement.condition) if not isinstance(effect, NoEffect))
    tolerance = requirement.tolerance
    return tuple(effects) if tolerance is None else tuple(_with_tolerance(each, tolerance) for each in effects)


def _with_tolerance(effect: Effect, written: s.Number | s.Quantity) -> Effect:
    match effect:
        case Adjust():
            relative = isinstance(written, s.Quantity) and written.unit == "%"
            amount = to_si(written.value, written.unit) if isinstance(written, s.Quantity) else written.value
            return structs.replace(effect, tolerance=Tolerance(amount, relative))
        case ForEach(effect=Adjust() as inner):
            return structs.replace(effect, effect=_with_tolerance(inner, written))
        case _:
            return effect


def _outcomes(typed: Skill) -> tuple[library.Outcome, ...]:
    """Return the outcomes; those that do not say how likely they are share what is left."""
    stated = [each.likely.value for each in typed.outcomes if each.likely is not None]
    open_ = len(typed.outcomes) - len(stated)
    share = round((1.0 - sum(stated)) / open_, 12) if open_ else 0.0
    return tuple(
        library.Outcome(
            label=each.label.text if each.label else "",
            condition=fold(each.condition.meaning),
            effects=_effects(each),
            likely=share if each.likely is None else each.likely.value,
            text=each.text,
            source=each.span.start,
        )
        for each in typed.outcomes
    )


def _parameter(typed: Parameter) -> library.Parameter:
    return library.Parameter(
        name=typed.name,
        direction=typed.direction,
        type=typed.declared,
        any_=typed.any_,
        default=_expression(typed.default),
        low=constant_number(typed.low.meaning) if typed.low else None,
        high=constant_number(typed.high.meaning) if typed.high else None,
        doc=typed.doc,
        source=typed.span.start,
    )


def _expression(valued: TypedExpression | None) -> Expression | None:
    return fold(valued.meaning) if valued else None


def _pause(typed: Pause | None) -> library.PausePolicy:
    if typed is None:
        return library.PausePolicy()
    return library.PausePolicy(typed.where, constant_number(typed.keep.meaning) if typed.keep else None)


def _devices(typed: Skill, kind: str) -> tuple[str, ...]:
    return tuple(device.parameter.text for device in typed.devices if device.kind == kind)


def _property(typed: Property) -> properties.Property:
    """Return the property of a `verify` line."""
    return properties.Property(
        pattern=typed.pattern,
        first=_event(typed.first),
        second=_event(typed.second) if typed.second else None,
        text=typed.text,
        source=typed.span.start,
    )


def _event(typed: VerifyEvent) -> properties.VerifyEvent:
    if typed.condition is not None:
        return properties.ConditionEvent(fold(typed.condition.meaning))
    if typed.measured is not None:
        limit = fold(typed.measured.limit.meaning)
        return properties.Measures("force", typed.measured.operator, limit)
    assert typed.skill is not None, "an event is a skill, a condition or a force"
    return properties.Runs(typed.skill)
