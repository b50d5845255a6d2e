"""Missing or duplicate arguments."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.labels import label_declaration
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Parameter, Skill
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.source import Span
from skillc_model.conditions import Invoke

NAMES = ("missing-argument", "duplicate-argument", "wrong-argument-count")
NEEDS = Need.TYPES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield the problems with the arguments of each call of a skill or function."""
    for call in program.calls:
        yield from _check_duplicates(call)
        if call.skill:
            yield from _check_missing(call, call.skill)
    for value in program.values:
        if isinstance(value.meaning, Invoke):
            yield from _check_count(program, value, value.meaning)


def _check_duplicates(call: Call) -> Iterator[Diagnostic]:
    seen: dict[str, s.Name] = {}
    for argument in call.written.arguments:
        first = seen.setdefault(argument.name.text, argument.name)
        if first is not argument.name:
            yield Diagnostic(
                "duplicate-argument",
                argument.name.span,
                f"`{first.text}` is passed twice",
                help="keep one of them",
                labels=(Label(first.span, "passed here"),),
            )


def _check_missing(call: Call, skill: Skill) -> Iterator[Diagnostic]:
    passed = {argument.name.text for argument in call.written.arguments}
    if any(skill.parameter(name) is None for name in passed) or len(passed) < len(call.written.arguments):
        return  # a misspelt or repeated argument is reported as such
    missing = [p for p in skill.parameters if p.direction == "in" and p.name not in passed]
    if missing:
        names = " and ".join(f"`{p.name}`" for p in missing)
        yield Diagnostic(
            "missing-argument",
            call.written.skill.span,
            f"`{skill.name}` needs {names}",
            help=f"pass {', '.join(f'`{p.name}: ..`' for p in missing)}",
            labels=tuple(Label(p.span, "declared here", is_cause=True) for p in missing),
            fix=_pass_own(call.written, missing),
        )


def _pass_own(call: s.CallSkill, missing: Sequence[Parameter]) -> Fix:
    """Return the edit that passes what has the names of the missing parameters where the call is."""
    added = ", ".join(f"{each.name}: {each.name}" for each in missing)
    if call.arguments:
        return Fix(call.arguments[-1].value.span.after, f", {added}", f"pass `{added}`", safe=False)
    name = call.implementation or call.skill
    start = name.span.end_column + (2 if call.implementation else 1)
    place = Span(name.span.path, name.span.end_line, start, name.span.end_line, start)
    return Fix(place, added, f"pass `{added}`", safe=False)


def _check_count(program: Program, value: TypedExpression, meaning: Invoke) -> Iterator[Diagnostic]:
    function = program.vocabulary.functions.get(meaning.function)
    if function and len(function.parameters) != len(meaning.arguments):
        names = ", ".join(name for name, _ in function.parameters)
        yield Diagnostic(
            "wrong-argument-count",
            value.span,
            f"`{function.name}` takes {len(function.parameters)} values, not {len(meaning.arguments)}",
            help=f"write `{function.name}({names})`",
            labels=label_declaration(function),
        )
