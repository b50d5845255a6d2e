"""From understood skills, implementations and tasks to those of the library: constants folded, everything merged."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_compiler.logic.effects import NoEffect, effects
from skillc_compiler.lower.bodies import node
from skillc_compiler.program.typed import (
    Event,
    Implementation,
    Parameter,
    Property,
    Requirement,
    Skill,
    Task,
    TypedExpression,
    TypedNode,
    position,
)
from skillc_dsl import syntax as s
from skillc_model import properties
from skillc_model import skills as library
from skillc_model.conditions import Expression
from skillc_model.rewriting import constant_number, fold


def skill(understood: Skill, implementations: Sequence[str]) -> library.Skill:
    """Return a description; `implementations` are the names of its implementations in rank order."""
    labelled = label(understood.requirements)
    return library.Skill(
        name=understood.name,
        doc=understood.doc,
        parameters=tuple(_parameter(p) for p in understood.parameters),
        pre=_requirements(labelled, "pre"),
        hold=_requirements(labelled, "hold"),
        post=_posts(labelled),
        duration=_expression(understood.duration),
        uses=_devices(understood, "uses"),
        shares=_devices(understood, "shares"),
        scoped="scoped" in understood.flags,
        planned="noplan" not in understood.flags,
        fallback="fallback" in understood.flags,
        implementations=tuple(implementations),
        source=position(understood.span),
    )


def implementation(understood: Implementation, body: TypedNode | s.RunPython) -> library.Implementation:
    """Return an implementation with the description's conditions before its own."""
    labelled = label((*understood.skill.requirements, *understood.requirements))
    return library.Implementation(
        name=understood.name,
        skill=understood.skill.name,
        doc=understood.doc,
        parameters=tuple(_parameter(p) for p in understood.parameters),
        pre=_requirements(labelled, "pre"),
        hold=_requirements(labelled, "hold"),
        post=_posts(labelled),
        duration=_expression(understood.duration or understood.skill.duration),
        prefer=understood.prefer,
        lets=tuple(library.Let(let.name.text, fold(let.value.meaning)) for let in understood.lets),
        body=library.Compound(node(body)) if isinstance(body, TypedNode) else library.Primitive(body.target.value),
        verify=tuple(_property(each) for each in understood.verify),
        source=position(understood.span),
    )


def task(understood: Task) -> library.Task:
    """Return a task."""
    return library.Task(
        name=understood.name,
        doc=understood.doc,
        scene=understood.scene,
        goal=fold(understood.goal.meaning) if understood.goal else None,
        goal_text=understood.goal_text,
        body=node(understood.body) if understood.body else None,
        source=position(understood.span),
    )


def label(requirements: Sequence[Requirement]) -> list[tuple[str, Requirement]]:
    """Return the conditions with their labels; one without is called `pre1` by its kind and its place among them."""
    taken = {r.label.text for r in requirements if r.label}
    counts = {"pre": 0, "hold": 0, "post": 0}
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
        library.Requirement(label=name, condition=fold(r.clause.meaning), text=r.text, source=position(r.span))
        for name, r in labelled
        if r.kind == kind
    )


def _posts(labelled: Sequence[tuple[str, Requirement]]) -> tuple[library.Post, ...]:
    return tuple(
        library.Post(
            label=name,
            condition=fold(r.clause.meaning),
            effects=tuple(effect for effect in effects(r.clause) if not isinstance(effect, NoEffect)),
            sensed=r.sensed,
            text=r.text,
            source=position(r.span),
        )
        for name, r in labelled
        if r.kind == "post"
    )


def _parameter(understood: Parameter) -> library.Parameter:
    return library.Parameter(
        name=understood.name,
        direction=understood.direction,
        type=understood.declared,
        any_=understood.any_,
        default=_expression(understood.default),
        low=constant_number(understood.low.meaning) if understood.low else None,
        high=constant_number(understood.high.meaning) if understood.high else None,
        doc=understood.doc,
        source=position(understood.span),
    )


def _expression(valued: TypedExpression | None) -> Expression | None:
    return fold(valued.meaning) if valued else None


def _devices(understood: Skill, kind: str) -> tuple[str, ...]:
    return tuple(device.parameter.text for device in understood.devices if device.kind == kind)


def _property(understood: Property) -> properties.Property:
    """Return the property of a `verify` line."""
    return properties.Property(
        pattern=understood.pattern,
        first=_event(understood.first),
        second=_event(understood.second) if understood.second else None,
        text=understood.text,
        source=position(understood.span),
    )


def _event(understood: Event) -> properties.Event:
    if understood.clause is not None:
        return properties.Is(fold(understood.clause.meaning))
    if understood.measured is not None:
        limit = fold(understood.measured.limit.meaning)
        return properties.Measures("force", understood.measured.operator, limit)
    assert understood.skill is not None, "an event is a skill, a condition or a force"
    return properties.Runs(understood.skill)
