"""Groups errors that have one cause: those of one line, and those of a declaration that fits nowhere."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

from skillc_compiler.program.labels import declaration_place
from skillc_compiler.program.typed import Program, Skill
from skillc_compiler.program.types import Thing
from skillc_compiler.program.walk import all_calls, all_values
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span

Line: TypeAlias = tuple[str, int]


def group_by_cause(problems: Sequence[Diagnostic], program: Program) -> tuple[Diagnostic, ...]:
    """Return one problem for each cause; warnings on the line of an error are left out.

    Several errors on one line have one cause. So have errors that point to the same declaration if nothing that uses
    the declaration is right.
    """
    errors = [problem for problem in problems if problem.severity == "error"]
    if not errors:
        return tuple(problems)
    first = _first_in_lines(errors)
    warnings = (each for each in problems if each.severity == "warning" and _line(each.span) not in first)
    return (*_by_declaration(first, program), *warnings)


def _line(span: Span) -> Line:
    return span.path, span.line


def _first_in_lines(errors: Sequence[Diagnostic]) -> dict[Line, Diagnostic]:
    first: dict[Line, Diagnostic] = {}
    for error in errors:
        line = _line(error.span)
        first[line] = min(first.get(line, error), error, key=lambda each: each.span)
    return first


def _by_declaration(errors: Mapping[Line, Diagnostic], program: Program) -> Iterator[Diagnostic]:
    places = [{label.span for label in error.labels} for error in errors.values()]
    times = Counter(place for each in places for place in each)
    uses = _uses(program) if any(count > 1 for count in times.values()) else {}
    wrong = {
        place: count
        for place, count in times.items()
        if count > 1 and place in uses and all(_line(use) in errors or use in times for use in uses[place])
    }
    groups: dict[Span, list[Diagnostic]] = defaultdict(list)
    for error, labelled in zip(errors.values(), places, strict=True):
        cause = max(labelled & wrong.keys(), key=lambda place: (wrong[place], place), default=error.span)
        groups[cause].append(error)
    for group in groups.values():
        one, *others = sorted(group, key=lambda each: each.span)
        yield replace(one, labels=(*one.labels, *(Label(other.span, "also here") for other in others)))


def _uses(program: Program) -> Mapping[Span, list[Span]]:
    """Return where each declared name is used: read, or called.

    For a parameter that calls give values to these count, whatever its own skill does with it.
    """
    found: dict[Span, list[Span]] = defaultdict(list)
    passed: dict[Span, list[Span]] = defaultdict(list)
    for value in all_values(program):
        if value.declared is not None:
            found[value.declared].append(value.span)
    for call in all_calls(program):
        if call.skill is not None:
            found[call.skill.name_span].append(call.written.skill.span)
        for argument in call.arguments:
            parameter = call.skill.parameter(argument.name.text) if call.skill else None
            if parameter is not None:
                passed[parameter.span].append(argument.value.span)
    for skill in program.skills.values():
        for device in skill.devices:
            if (place := _class_place(program, skill, device.parameter.text)) is not None:
                found[place].append(device.parameter.span)
    return {**found, **passed}


def _class_place(program: Program, skill: Skill, name: str) -> Span | None:
    """Return where the class of a parameter is declared, None if that is unknown."""
    parameter = skill.parameter(name)
    cls = parameter.type.cls if parameter is not None and isinstance(parameter.type, Thing) else None
    term = program.vocabulary.classes.get(cls or "")
    return declaration_place(term) if term is not None else None
