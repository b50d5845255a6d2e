"""Resolving calls of skills: the skill, and the value of each parameter."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec import structs

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.typed import Argument, Call, Parameter, Skill
from skillc_compiler.program.types import UNKNOWN, Type, fits
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.handing.handed import hand_over
from skillc_compiler.resolve.references import ANYTHING, ExpectedType
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_compiler.resolve.values import resolve_value
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Label
from skillc_dsl.spelling import close_names
from skillc_model.conditions import Variable


def resolve_call(context: FileContext, scope: Scope, written: s.CallSkill) -> tuple[Call, Scope]:
    """Return the call, and the scope after it, in which its output has a value."""
    name = context.names.look_up_skill(written.skill)
    skill = context.skills.get(name) if name else None
    implementation = _implementation(context, written, skill)
    known = context.implementations.get(skill.name) or () if skill else ()
    is_known = implementation is None or implementation in known
    arguments = tuple(_arguments(context, scope, written, skill if is_known else None))
    typed = Call(skill, implementation, arguments, written.out, written)
    typed = structs.replace(typed, handed=hand_over(context, scope, typed))
    return typed, _scope_after(context, scope, written, skill)


def _arguments(context: FileContext, scope: Scope, written: s.CallSkill, skill: Skill | None) -> Iterator[Argument]:
    for argument in written.arguments:
        parameter = skill.parameter(argument.name.text) if skill else None
        if skill and (parameter is None or parameter.direction == "out"):
            _report_argument(context, scope, argument, skill, parameter, written)
        elif skill is None and _is_shorthand(argument) and argument.name.text not in scope.variables:
            continue
        else:
            yield Argument(argument.name, _resolve_passed(context, scope, argument.value, parameter))


def _resolve_passed(
    context: FileContext, scope: Scope, written: s.Value, parameter: Parameter | None
) -> TypedExpression:
    """Resolve an argument; for an erroneous parameter or skill, a bare name may be anything."""
    if (parameter is None or parameter.type == UNKNOWN) and isinstance(written, s.NameReference):
        text = written.name.text
        if ":" not in text and text not in scope.variables:
            return TypedExpression(Variable(text), UNKNOWN, written.span)
    wanted = ExpectedType(parameter.type) if parameter else ANYTHING
    return resolve_value(context, scope, written, wanted)


def _is_shorthand(argument: s.Argument) -> bool:
    return isinstance(argument.value, s.NameReference) and argument.value.span == argument.name.span


def _report_argument(
    context: FileContext,
    scope: Scope,
    argument: s.Argument,
    skill: Skill,
    out: Parameter | None,
    written: s.CallSkill,
) -> None:
    """Report an argument that no parameter takes; its value is still resolved, unless it is a bare name."""
    name = argument.name.text
    own = scope.variables.get(name) if _is_shorthand(argument) else None
    is_individual = _is_shorthand(argument) and ":" in name
    shown = own.type if own else UNKNOWN
    is_name = _is_shorthand(argument) and not is_individual
    kind = shown if is_name else resolve_value(context, scope, argument.value).type
    if out is not None:
        context.report(
            "unknown-argument",
            argument.name.span,
            f"`{name}` is an output of `{skill.name}`, which cannot be passed in",
            f"read it with `{skill.name}(..) -> {name}`",
            Label(out.span, "declared here", is_cause=True),
        )
        return
    free = _free_parameters(context, skill, written, kind)
    needed = [each for each in free if (found := skill.parameter(each)) and found.direction == "in"]
    is_value = (own is not None or is_individual) and len(needed) == 1 and not close_names(name, free)
    context.report_unknown(
        UnknownName(
            "argument",
            argument.name,
            f"the skill `{skill.name}` has no parameter `{name}`",
            () if is_value else tuple(free),
            f"write `{needed[0]}: {name}`" if is_value else f"it takes {_format_parameters(skill)}",
            (Label(skill.name_span, "declared here"),),
            owner=skill.name,
            passed=True,
        )
    )


def _free_parameters(context: FileContext, skill: Skill, written: s.CallSkill, kind: Type) -> list[str]:
    """Return the parameters that are not passed yet and that take a value of this type."""
    passed = {a.name.text for a in written.arguments}
    takes = [p for p in skill.parameters if p.direction != "out" and p.name not in passed]
    return [p.name for p in takes if fits(context.vocabulary, kind, p.type)]


def _format_parameters(skill: Skill) -> str:
    return ", ".join(f"`{p.name}`" for p in skill.parameters if p.direction != "out") or "no arguments"


def _implementation(context: FileContext, written: s.CallSkill, skill: Skill | None) -> str | None:
    name = written.implementation
    if name is None or skill is None:
        return None
    known = context.implementations.get(skill.name) or ()
    if name.text not in known:
        message = f"the skill `{skill.name}` has no implementation `{name.text}`"
        context.report_unknown(UnknownName("implementation", name, message, tuple(known), owner=skill.name))
    return name.text


def _scope_after(context: FileContext, scope: Scope, written: s.CallSkill, skill: Skill | None) -> Scope:
    if written.out is None:
        return scope
    outputs = [p for p in skill.parameters if p.direction == "out"] if skill else []
    kind = outputs[0].type if len(outputs) == 1 else UNKNOWN
    if skill and len(outputs) != 1:
        context.report(
            "no-output",
            written.out.span,
            f"the skill `{skill.name}` has {len(outputs) or 'no'} outputs, so `->` has nothing to name",
            "remove `->`, or declare one `out` parameter in the skill",
            *_label_output(skill, written, written.out.text),
        )
    return _assign_output(context, scope, written.out, kind)


def _label_output(skill: Skill, written: s.CallSkill, name: str) -> tuple[Label, ...]:
    """Return labels at the outputs, else at the parameters that may be meant to be the output, and at the skill."""
    if outputs := [each for each in skill.parameters if each.direction == "out"]:
        return tuple(Label(each.span, "an output") for each in outputs)
    passed = {argument.name.text for argument in written.arguments}
    left = [each for each in skill.parameters if each.name not in passed]
    named, required = [each for each in left if each.name == name], [each for each in left if each.direction == "in"]
    meant = named or required or left
    shown = (Label(each.span, f"this is `{each.direction}`", is_cause=len(meant) == 1) for each in meant)
    return (Label(skill.name_span, "declared here"), *shown)


def _assign_output(context: FileContext, scope: Scope, name: s.Name, kind: Type) -> Scope:
    former = scope.variables.get(name.text)
    if former is None or former.origin not in ("out", "output"):
        return context.bind(scope, name, LocalName(kind, "output", name.span))
    if not fits(context.vocabulary, kind, former.type):
        context.report(
            "wrong-type",
            name.span,
            f"this output does not fit `{name.text}`",
            "give the output another name",
            Label(former.span, "declared here"),
        )
    return scope.with_name(name.text, LocalName(former.type, former.origin, former.span))
