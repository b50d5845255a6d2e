"""What calls use exclusively, and in which order: inside of a call that uses one thing others are used."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Implementation, TypedNode
from skillc_compiler.program.walk import calls_in
from skillc_model.conditions import Individual, Variable

Used: TypeAlias = Variable | Individual
"""Something that is used exclusively, as a body calls it."""

Order: TypeAlias = tuple[Used, Used]
"""What is used, and what is needed meanwhile."""


def used_by(call: Call) -> frozenset[Used]:
    """Return what a call uses exclusively from its start to its end, as far as the caller has names for it."""
    if call.skill is None:
        return frozenset()
    names = [device.parameter.text for device in call.skill.devices if device.kind == "uses"]
    return frozenset(_as_caller_says(call, (Variable(name) for name in names)))


def used_within(program: Program, call: Call, context: tuple[str, ...] = ()) -> frozenset[Used]:
    """Return what a call uses exclusively at some time; `context` names the skills whose bodies are being followed."""
    if call.skill is None or call.skill.name in context:
        return frozenset()
    inside = (each for of in program.candidates(call) for each in used_inside(program, of, context))
    return used_by(call) | frozenset(_as_caller_says(call, inside))


def used_inside(program: Program, of: Implementation, context: tuple[str, ...] = ()) -> frozenset[Used]:
    """Return what the body of an implementation uses exclusively at some time, as it calls it."""
    calls = calls_in(of.body) if isinstance(of.body, TypedNode) else ()
    return frozenset(each for call in calls for each in used_within(program, call, (*context, of.skill.name)))


def orders_of(program: Program, call: Call, context: tuple[str, ...] = ()) -> frozenset[Order]:
    """Return what a call needs while it uses something else, as far as the caller has names for both."""
    if call.skill is None or call.skill.name in context:
        return frozenset()
    used, found = used_by(call), set[Order]()
    for of in program.candidates(call):
        needed = _as_caller_says(call, used_inside(program, of, context))
        found |= {(one, other) for other in needed for one in used if one != other}
        for order in orders_inside(program, of, context):
            both = tuple(_as_caller_says(call, order))
            if len(both) == len(order):
                found.add((both[0], both[1]))
    return frozenset(found)


def orders_inside(program: Program, of: Implementation, context: tuple[str, ...] = ()) -> frozenset[Order]:
    """Return what the calls in the body of an implementation need while they use something else."""
    calls = calls_in(of.body) if isinstance(of.body, TypedNode) else ()
    return frozenset(each for call in calls for each in orders_of(program, call, (*context, of.skill.name)))


def _as_caller_says(call: Call, used: Iterator[Used] | frozenset[Used] | Order) -> Iterator[Used]:
    """Yield what is used in a called skill as its caller calls it; nothing for what the caller has no name for."""
    passed = {argument.name.text: argument.value.meaning for argument in call.values}
    for each in used:
        said = passed.get(each.name) if isinstance(each, Variable) else each
        if isinstance(said, Variable | Individual):
            yield said
