"""Resolving implementations: refinements merged into the parameters, `let` values, own conditions, body."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec import structs

from skillc_compiler.program.typed import (
    Body,
    ForceLimit,
    Implementation,
    Let,
    Output,
    Parameter,
    Property,
    Refinement,
    Skill,
    VerifyEvent,
)
from skillc_compiler.program.types import Measure, describe_type, fits, type_of
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.conditions import resolve_condition
from skillc_compiler.resolve.members import resolve_constant, resolve_duration, resolve_requirements, single_member
from skillc_compiler.resolve.nodes import assume_outputs_assigned, resolve_node
from skillc_compiler.resolve.references import ANYTHING, ExpectedType
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_compiler.resolve.skills import build_scopes
from skillc_compiler.resolve.type_names import resolve_type
from skillc_compiler.resolve.values import resolve_value
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Label
from skillc_dsl.source import Span
from skillc_dsl.units import FORCE

FORCE_NAME = "force"
"""The name of the measured contact force, unless a parameter has that name."""


def resolve_verify(context: FileContext, scope: Scope, written: s.Verify, text: str) -> Property | None:
    """Return the resolved `verify` line, or None if a skill in it is unknown."""
    first = _event(context, scope, written.first)
    second = _event(context, scope, written.second) if written.second is not None else None
    if first is None or (second is None and written.second is not None):
        return None
    return Property(written.pattern, first, second, text, written.span)


def _event(context: FileContext, scope: Scope, written: s.VerifyEvent) -> VerifyEvent | None:
    match written.what:
        case s.Name() as name:
            skill = context.names.look_up_skill(name)
            return VerifyEvent(written.span, skill=skill) if skill is not None else None
        case s.Compare(left=s.NameReference(name=name), operator=operator, right=right) if _is_force(scope, name):
            limit = resolve_value(context, scope, right, ExpectedType(Measure(FORCE)))
            if not fits(context.vocabulary, limit.type, Measure(FORCE)):
                message = f"this is {describe_type(limit.type)}, where a Force is expected"
                context.report("wrong-type", limit.span, message, "a force has a unit, such as `25 N`")
            return VerifyEvent(written.span, measured=ForceLimit(operator, limit))
        case _:
            return VerifyEvent(written.span, condition=resolve_condition(context, scope, written.what))


def _is_force(scope: Scope, name: s.Name) -> bool:
    return name.text == FORCE_NAME and FORCE_NAME not in scope.variables


def resolve_implementation(
    context: FileContext, written: s.ImplementationDeclaration, skill: Skill, lines: Sequence[str]
) -> Implementation:
    """Return the resolved implementation; `lines` is the text of its file."""
    refinements = tuple(_resolve_refinements(context, written, skill))
    parameters = tuple(_merge_refinement(p, refinements) for p in skill.parameters)
    owner = f"the implementation `{written.name.text}` of `{skill.name}`"
    before, after = build_scopes(owner, skill.name, parameters)
    lets, inner = _resolve_lets(context, before, written)
    body, at_end = _resolve_body(context, inner, written)
    labels = {r.label.text: r.label for r in skill.requirements if r.label}
    prefer = single_member(context, written.members, s.Prefer, "prefer")
    return Implementation(
        name=written.name.text,
        doc=written.doc,
        skill=skill,
        refinements=refinements,
        parameters=parameters,
        requirements=tuple(resolve_requirements(context, before, after, written.members, labels)),
        duration=resolve_duration(context, before, written.members),
        prefer=prefer.value.value if prefer else 0.0,
        lets=lets,
        outputs=tuple(_resolve_outputs(context, at_end, written, skill)),
        body=body,
        verify=tuple(_resolve_verify_lines(context, inner, written, lines)),
        name_span=written.name.span,
        span=written.span,
    )


def _resolve_refinements(
    context: FileContext, written: s.ImplementationDeclaration, skill: Skill
) -> Iterator[Refinement]:
    seen: dict[str, s.Refinement] = {}
    for member in written.members:
        if not isinstance(member, s.Refinement):
            continue
        declared = resolve_type(context.names, member.type)
        kind = type_of(declared)
        if seen.setdefault(member.name.text, member) is not member:
            context.report(
                "duplicate-parameter",
                member.name.span,
                f"`{member.name.text}` is refined twice",
                "keep one of them",
                Label(seen[member.name.text].name.span, "first refined here"),
            )
            continue
        yield Refinement(
            of=_find_parameter(context, member, skill),
            declared=declared,
            type=kind,
            default=resolve_constant(context, member.default, kind),
            low=resolve_constant(context, member.range.low if member.range else None, kind),
            high=resolve_constant(context, member.range.high if member.range else None, kind),
            written=member,
        )


def _find_parameter(context: FileContext, member: s.Refinement, skill: Skill) -> Parameter | None:
    parameter = skill.parameter(member.name.text)
    if parameter is None:
        context.report_unknown(
            UnknownName(
                "parameter",
                member.name,
                f"the skill `{skill.name}` has no parameter `{member.name.text}` to refine",
                tuple(each.name for each in skill.parameters),
                labels=(Label(skill.name_span, "declared here"),),
                owner=skill.name,
            )
        )
    return parameter


def _merge_refinement(parameter: Parameter, refinements: Sequence[Refinement]) -> Parameter:
    for new in refinements:
        if new.of is parameter:
            return structs.replace(
                parameter,
                declared=new.declared,
                type=new.type,
                default=new.default or parameter.default,
                low=new.low or parameter.low,
                high=new.high or parameter.high,
            )
    return parameter


def _resolve_lets(
    context: FileContext, scope: Scope, written: s.ImplementationDeclaration
) -> tuple[tuple[Let, ...], Scope]:
    lets = []
    for member in written.members:
        if isinstance(member, s.Let):
            named = resolve_value(context, scope, member.value)
            lets.append(Let(member.name, named))
            scope = context.bind(scope, member.name, LocalName(named.type, "let", member.name.span))
    return tuple(lets), scope


def _resolve_outputs(
    context: FileContext, scope: Scope, written: s.ImplementationDeclaration, skill: Skill
) -> Iterator[Output]:
    outputs = {each.name: each for each in skill.parameters if each.direction == "out"}
    seen: dict[str, s.Output] = {}
    for member in written.members:
        if not isinstance(member, s.Output):
            continue
        name = member.name
        parameter = outputs.get(name.text)
        if seen.setdefault(name.text, member) is not member:
            label = Label(seen[name.text].name.span, "the first one")
            message = f"the output `{name.text}` is given two values"
            context.report("duplicate-member", name.span, message, "keep one of them", label)
        elif parameter is None:
            message, declared = (
                f"the skill `{skill.name}` has no output `{name.text}`",
                Label(skill.name_span, "declared"),
            )
            unknown = UnknownName("parameter", name, message, tuple(outputs), labels=(declared,), owner=skill.name)
            context.report_unknown(unknown)
        elif any(isinstance(each, s.RunPython) for each in written.members):
            message, help_ = f"the Python class gives the output `{name.text}`", "delete it, or write a body with `do`"
            context.report("misplaced-output", member.span, message, help_)
        wanted = ExpectedType(parameter.type) if parameter else ANYTHING
        yield Output(name, parameter, resolve_value(context, scope, member.value, wanted))


def _resolve_body(context: FileContext, scope: Scope, written: s.ImplementationDeclaration) -> tuple[Body, Scope]:
    """Return the body, and the scope at its end."""
    bodies = [m for m in written.members if isinstance(m, s.Body | s.RunPython)]
    for extra in bodies[1:]:
        context.report(
            "duplicate-member",
            extra.span,
            "an implementation can only have one body",
            "keep one `do` or `run`, or make two implementations",
            Label(bodies[0].span, "the first one"),
        )
    match bodies[:1]:
        case [s.Body(node=node)]:
            return resolve_node(context, assume_outputs_assigned(scope), node)
        case [s.RunPython() as python]:
            return python, assume_outputs_assigned(scope)
    return None, scope


def _resolve_verify_lines(
    context: FileContext, scope: Scope, written: s.ImplementationDeclaration, lines: Sequence[str]
) -> Iterator[Property]:
    for member in written.members:
        if isinstance(member, s.Verify):
            typed = resolve_verify(context, scope, member, _text_of(lines, member.span))
            yield from (typed,) if typed is not None else ()


def _text_of(lines: Sequence[str], span: Span) -> str:
    """Return the text that a span covers, in one line."""
    covered = list(lines[span.line - 1 : span.end_line])
    covered[-1] = covered[-1][: span.end_column - 1]
    covered[0] = covered[0][span.column - 1 :]
    return " ".join(" ".join(covered).split())
