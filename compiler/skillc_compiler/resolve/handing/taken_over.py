"""What a skill takes over of a call by `pre of`: its preconditions, and the parameters that it would infer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from msgspec import structs

from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.typed import Call, Parameter, Requirement, Skill, TakenOver
from skillc_compiler.resolve.calls import resolve_call
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Label
from skillc_dsl.source import Span
from skillc_dsl.units import in_units_of
from skillc_model.conditions import And, Condition, Expression, Given, Not, Or
from skillc_model.format_condition import format_condition
from skillc_model.rewriting import ALWAYS, NEVER, fold, map_children, substitute


def take_over(
    context: FileContext, written: s.SkillDeclaration, own: Sequence[Parameter]
) -> tuple[tuple[Parameter, ...], tuple[Requirement, ...], tuple[TakenOver, ...]]:
    """Return the parameters, the preconditions and the calls that a skill with its own parameters takes over."""
    parameters, requirements, calls = list(own), dict[Condition, Requirement](), []
    for member in (each for each in written.members if isinstance(each, s.TakenOver)):
        call = _resolve(context, written, member.call, parameters)
        if call is None or call.skill is None:
            continue
        found = tuple(_infer(context, call, call.skill, parameters))
        parameters += found
        for each in _preconditions(context, call, call.skill):
            requirements.setdefault(each.condition.meaning, each)
        calls.append(TakenOver(call, tuple(each.name for each in found)))
    return tuple(parameters[len(own) :]), tuple(requirements.values()), tuple(calls)


def _resolve(
    context: FileContext, written: s.SkillDeclaration, call: s.CallSkill, parameters: Sequence[Parameter]
) -> Call | None:
    """Return the call; None if its skill is unknown, or would take over what this one has."""
    name = written.name.text
    known = {p.name: LocalName(p.type, "parameter", p.span) for p in parameters if p.direction != "out"}
    typed, _ = resolve_call(context, Scope(f"the skill `{name}`", known), call)
    if typed.skill is None and call.skill.text in context.names.skills:
        message = f"`pre of {call.skill.text}` leads back to `{name}`, so it never ends"
        context.report("recursion", call.skill.span, message, "write the preconditions of one of them")
    return typed if typed.skill is not None else None


def _infer(context: FileContext, call: Call, skill: Skill, known: Sequence[Parameter]) -> Iterator[Parameter]:
    """Yield the parameters that the call leaves open; one of a name that is taken is reported."""
    passed, span = {each.name.text for each in call.arguments}, call.written.skill.span
    taken = {each.name: each for each in known}
    for each in (one for one in skill.parameters if one.direction == "infer" and one.name not in passed):
        former = taken.get(each.name)
        if former is None:
            yield structs.replace(each, span=span, some=False, taken_from=each.taken_from or skill.name)
            continue
        context.report(
            "duplicate-parameter",
            span,
            f"`{skill.name}` infers `{each.name}`, and there is a parameter `{each.name}` already",
            f"pass it if it is the same: `{each.name}: {each.name}`",
            Label(former.span, "the other one"),
        )


def _preconditions(context: FileContext, call: Call, skill: Skill) -> Iterator[Requirement]:
    """Yield the preconditions of a call in the terms of the skill around it."""
    span = call.written.span
    values: dict[str, Expression] = {each.name.text: each.value.meaning for each in call.arguments}
    defaults = {each.name: each.default.meaning for each in skill.parameters if each.default is not None}
    given = {p.name: p.name in values or p.name in defaults or p.direction != "opt" for p in skill.parameters}
    for each in (one for one in skill.requirements if one.kind == "pre"):
        condition = _about(each.condition, {**defaults, **values}, given, span)
        if fold(condition.meaning) != ALWAYS:
            text = in_units_of(format_condition(condition.meaning, context.vocabulary), (each.text,))
            yield Requirement("pre", None, False, condition, text, span, taken_from=skill.name)


def _about(
    condition: TypedCondition, values: Mapping[str, Expression], given: Mapping[str, bool], span: Span
) -> TypedCondition:
    """Return a condition of a called skill with the values of its parameters, as if it stood at a place."""
    return structs.replace(
        condition,
        meaning=substitute(_decide(condition.meaning, given), values),
        span=span,
        values=tuple(_valued(each, values, given, span) for each in condition.values),
        parts=tuple(_about(each, values, given, span) for each in condition.parts),
    )


def _valued(
    value: TypedExpression, values: Mapping[str, Expression], given: Mapping[str, bool], span: Span
) -> TypedExpression:
    return structs.replace(
        value,
        meaning=substitute(value.meaning, values),
        span=span,
        parts=tuple(_valued(each, values, given, span) for each in value.parts),
        declared=None,
        conditions=tuple(_about(each, values, given, span) for each in value.conditions),
    )


def _decide(condition: Condition, given: Mapping[str, bool]) -> Condition:
    """Return a condition with the answer for each parameter whether it is given."""
    match condition:
        case Given(parameter=name):
            return ALWAYS if given.get(name, True) else NEVER
        case Not() | And() | Or():
            return map_children(condition, lambda part: _decide(part, given))
    return condition
