"""Groups errors that have one cause: those of one line, and those of a declaration that fits nowhere."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

from skillc_compiler.program.directions import find_right_directions
from skillc_compiler.program.labels import declaration_place
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Skill, TypedNode
from skillc_compiler.program.types import Thing
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span

Line: TypeAlias = tuple[str, int]


def group_by_cause(problems: Sequence[Diagnostic], program: Program) -> tuple[Diagnostic, ...]:
    """Return one problem for each cause; warnings on the line of an error are left out.

    Several errors on one line have one cause. So have errors with the same cause among their labels, and errors that
    point to the same declaration if nothing that uses the declaration is right. A label is no cause afterwards if
    something relies on what stands there.
    """
    errors = [problem for problem in problems if problem.severity == "error"]
    if not errors:
        return tuple(problems)
    first = _first_in_lines(errors)
    warnings = (each for each in problems if each.severity == "warning" and _line(each.span) not in first)
    confirmed = _confirm_causes(first.values(), program)
    return (*_by_declaration(_by_stated_cause(confirmed), program), *warnings)


def _line(span: Span) -> Line:
    return span.path, span.line


def _first_in_lines(errors: Sequence[Diagnostic]) -> dict[Line, Diagnostic]:
    first: dict[Line, Diagnostic] = {}
    for error in errors:
        line = _line(error.span)
        first[line] = min(first.get(line, error), error, key=lambda each: each.span)
    return first


def _confirm_causes(errors: Collection[Diagnostic], program: Program) -> list[Diagnostic]:
    """Return the errors; labels at parameters whose direction is certainly right are no causes."""
    if all(_cause(error) is None for error in errors):
        return list(errors)
    right = find_right_directions(program)
    return [_without_causes(error, right) for error in errors]


def _without_causes(error: Diagnostic, right: Collection[Span]) -> Diagnostic:
    labels = (label._replace(is_cause=label.is_cause and label.span not in right) for label in error.labels)
    return replace(error, labels=tuple(labels))


def _cause(error: Diagnostic) -> Span | None:
    return next((label.span for label in error.labels if label.is_cause), None)


def _by_stated_cause(errors: Sequence[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield one error for each stated cause; what is wrong on the line of a cause, or points to it, has it, too."""
    causes = {_line(cause): cause for error in errors if (cause := _cause(error)) is not None}
    groups: dict[Span, list[Diagnostic]] = defaultdict(list)
    for error in errors:
        places = (error.span, *(label.span for label in error.labels))
        shared = next((causes[_line(place)] for place in places if _line(place) in causes), error.span)
        groups[_cause(error) or shared].append(error)
    for cause, group in groups.items():
        yield _join(sorted(group, key=lambda each: (each.span.path != cause.path, each.span)))


def _join(errors: Sequence[Diagnostic]) -> Diagnostic:
    """Return the first of several errors, with the places of the others."""
    one, *others = errors
    return replace(one, labels=(*one.labels, *(Label(other.span, "also here") for other in others)))


def _by_declaration(problems: Iterable[Diagnostic], program: Program) -> Iterator[Diagnostic]:
    errors = {_line(error.span): error for error in problems}
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
        yield _join(sorted(group, key=lambda each: each.span))


def _uses(program: Program) -> Mapping[Span, Sequence[Span]]:
    """Return where each declared name is used, read or called, and where each condition of a skill is needed or made.

    For a parameter of a skill that is called, these are the places where it is passed, whatever its own skill does with
    it.
    """
    found: dict[Span, list[Span]] = defaultdict(list)
    for value in program.values:
        if value.declared is not None:
            found[value.declared].append(value.span)
    for skill in program.skills.values():
        for device in skill.devices:
            if (place := _class_place(program, skill, device.parameter.text)) is not None:
                found[place].append(device.parameter.span)
    return {**found, **_uses_of_skills(program)}


def _uses_of_skills(program: Program) -> Mapping[Span, Sequence[Span]]:
    """Return the calls of skills, the places where parameters are passed, and where conditions are needed or made."""
    found: dict[Span, list[Span]] = defaultdict(list)
    for call in program.calls:
        if call.skill is None:
            continue
        name = call.written.skill.span
        found[call.skill.name_span].append(name)
        for argument in call.arguments:
            if (parameter := call.skill.parameter(argument.name.text)) is not None:
                found[parameter.span].append(argument.value.span)
        for requirement in (each for each in call.skill.requirements if not each.says_what_comes):
            found[requirement.span].append(name)
    for implementation in (each for each in program.implementations if isinstance(each.body, TypedNode)):
        for requirement in (each for each in implementation.skill.requirements if each.says_what_comes):
            found[requirement.span].append(implementation.name_span)
    return found


def _class_place(program: Program, skill: Skill, name: str) -> Span | None:
    """Return where the class of a parameter is declared, None if that is unknown."""
    parameter = skill.parameter(name)
    cls = parameter.type.cls if parameter is not None and isinstance(parameter.type, Thing) else None
    term = program.vocabulary.classes.get(cls or "")
    return declaration_place(term) if term is not None else None
