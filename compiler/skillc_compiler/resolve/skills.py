"""Resolving skills: parameters, conditions, devices, flags."""

from __future__ import annotations

from collections.abc import Container, Iterator

from skillc_compiler.program.typed import Parameter, Pause, Skill
from skillc_compiler.program.types import Measure, type_of
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.handing.taken_over import take_over
from skillc_compiler.resolve.members import (
    resolve_constant,
    resolve_cost,
    resolve_duration,
    resolve_requirements,
    resolve_senses,
    single_member,
)
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_compiler.resolve.type_names import resolve_type
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Label
from skillc_dsl.token_table import KEYWORDS
from skillc_dsl.units import TIME


def resolve_skill(context: FileContext, written: s.SkillDeclaration) -> Skill:
    """Return the resolved description."""
    own = tuple(_parameters(context, written))
    taken, needed, calls = take_over(context, written, own)
    parameters = (*own, *taken)
    before, after = build_scopes(f"the skill `{written.name.text}`", written.name.text, parameters)
    requirements = tuple(resolve_requirements(context, before, after, written.members, {}))
    said = {each.condition.meaning for each in requirements if each.kind == "pre"}
    return Skill(
        name=written.name.text,
        doc=written.doc,
        parameters=parameters,
        requirements=(*(each for each in needed if each.condition.meaning not in said), *requirements),
        senses=tuple(resolve_senses(context, before, written.members)),
        duration=resolve_duration(context, before, written.members),
        cost=resolve_cost(context, before, written.members),
        devices=tuple(_devices(context, written, parameters)),
        pause=_pause(context, written),
        flags=frozenset(_flags(written)),
        name_span=written.name.span,
        span=written.span,
        taken_over=calls,
    )


def names_taken_over(written: s.SkillDeclaration, known: Container[str]) -> list[str]:
    """Return the names of the known skills of which a skill takes something over."""
    names = (each.call.skill.text for each in written.members if isinstance(each, s.TakenOver))
    return [name for name in names if name in known]


def build_scopes(owner: str, skill: str, parameters: tuple[Parameter, ...]) -> tuple[Scope, Scope]:
    """Return the scope before a skill has run, in which outputs have no values, and the scope after it."""
    inputs = {p.name: LocalName(p.type, "parameter", p.span) for p in parameters if p.direction != "out"}
    outputs = {p.name: p for p in parameters if p.direction == "out"}
    unassigned = {n: LocalName(p.type, "out", p.span, is_assigned=False) for n, p in outputs.items()}
    assigned = {n: LocalName(p.type, "out", p.span) for n, p in outputs.items()}
    return Scope(owner, {**inputs, **unassigned}, skill), Scope(owner, {**inputs, **assigned}, skill)


def _parameters(context: FileContext, written: s.SkillDeclaration) -> Iterator[Parameter]:
    seen: dict[str, s.Parameter] = {}
    for member in written.members:
        if not isinstance(member, s.Parameter):
            continue
        first = seen.setdefault(member.name.text, member)
        if first is member:
            yield _parameter(context, member)
            continue
        context.report(
            "duplicate-parameter",
            member.name.span,
            f"the parameter `{member.name.text}` is declared twice",
            "give it another name, or remove one",
            Label(first.name.span, "first declared here"),
        )


def _parameter(context: FileContext, written: s.Parameter) -> Parameter:
    declared = resolve_type(context.names, written.type)
    kind = type_of(declared)
    return Parameter(
        name=written.name.text,
        direction=written.direction,
        any_=written.any,
        declared=declared,
        type=kind,
        default=resolve_constant(context, written.default, kind),
        low=resolve_constant(context, written.range.low if written.range else None, kind),
        high=resolve_constant(context, written.range.high if written.range else None, kind),
        doc=written.doc,
        span=written.name.span,
        some=written.some,
    )


def _pause(context: FileContext, written: s.SkillDeclaration) -> Pause | None:
    """Return where the skill may be paused; a second `pause` line is reported."""
    found = single_member(context, written.members, s.Pause, "pause")
    return Pause(found.where, resolve_constant(context, found.keep, Measure(TIME)), found.span) if found else None


def _flags(written: s.SkillDeclaration) -> Iterator[str]:
    """Yield the flags, also one that stands on the line after a `uses` or `shares` without a name."""
    for member in written.members:
        match member:
            case s.Flag(flag=flag):
                yield flag
            case s.DeviceUse() if _is_flag_taken(member):
                yield member.parameter.text
            case _:
                pass


def _is_flag_taken(use: s.DeviceUse) -> bool:
    """Whether a `uses` or `shares` has no name, so that the flag on the next line is taken for it."""
    return use.parameter.text in KEYWORDS["flag"] and use.parameter.span.line > use.span.line


def _devices(
    context: FileContext, written: s.SkillDeclaration, parameters: tuple[Parameter, ...]
) -> Iterator[s.DeviceUse]:
    names = [p.name for p in parameters]
    for member in written.members:
        if isinstance(member, s.DeviceUse):
            if member.parameter.text in names:
                yield member
                continue
            if _is_flag_taken(member):
                message = f"`{member.kind}` needs a parameter, and takes `{member.parameter.text}` for its name"
                such = f", such as `{member.kind} {names[0]}`" if names else ""
                context.report("unknown-parameter", member.span, message, f"write which device it is{such}")
                continue
            message = f"the skill `{written.name.text}` has no parameter `{member.parameter.text}`"
            context.report_unknown(
                UnknownName("parameter", member.parameter, message, tuple(names), owner=written.name.text)
            )
