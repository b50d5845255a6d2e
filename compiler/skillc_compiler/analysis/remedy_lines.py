"""The lines that a remedy adds to a skill, and the edit that adds them."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_compiler.analysis.findings import Remedy
from skillc_compiler.program.typed import Skill
from skillc_dsl.diagnostics import Fix
from skillc_model.conditions import Condition, Not, Same
from skillc_model.format_condition import format_condition
from skillc_rdf.vocabulary.types import Vocabulary


def remedy_lines(remedy: Remedy, vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the lines of a remedy in the syntax of the language."""
    return (
        *(f"infer {name}: {vocabulary.short(cls)}" for name, cls in remedy.parameters),
        *(f"pre {format_condition(each, vocabulary)}" for each in (*remedy.before, *remedy.apart)),
        *(f"post {format_condition(each, vocabulary)}" for each in remedy.after),
    )


def describe_same(apart: Sequence[Condition], vocabulary: Vocabulary) -> str:
    """Return that some names may mean the same thing, as a remedy says that they differ."""
    pairs = [each.body for each in apart if isinstance(each, Not) and isinstance(each.body, Same)]
    said = (format_condition(each, vocabulary).split(" == ") for each in pairs)
    return " or ".join(f"`{left}` and `{right}` are the same" for left, right in said)


def add_lines(lines: Sequence[str], skill: Skill) -> Fix:
    """Return the edit that adds lines at the end of a skill."""
    end = skill.span.after
    place = end._replace(column=end.column - 1, end_column=end.column - 1)
    is_one_line = skill.span.line == skill.span.end_line
    text = f"{' '.join(lines)} " if is_one_line else "".join(f"    {line}\n" for line in lines)
    return Fix(place, text, f"add {' and '.join(f'`{line}`' for line in lines)}", safe=False)
