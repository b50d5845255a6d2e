"""The lines that a remedy adds to a skill, and the edit that adds them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from skillc_compiler.analysis.findings import Remedy
from skillc_compiler.program.typed import Skill
from skillc_dsl.diagnostics import Fix
from skillc_model.conditions import Condition, ForEach
from skillc_model.format_condition import format_condition, format_each
from skillc_model.format_type import format_type
from skillc_rdf.vocabulary.types import Vocabulary


def remedy_lines(remedy: Remedy, vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the lines of a remedy in the syntax of the language."""
    return (
        *(f"infer {name}: {vocabulary.short(cls)}" for name, cls in remedy.parameters),
        *(f"out {name}: {format_type(type_, vocabulary)}" for name, type_ in remedy.outputs),
        *(f"pre {format_condition(each, vocabulary)}" for each in remedy.required),
        *(f"post {_format_effect(each, vocabulary)}" for each in remedy.after),
    )


def _format_effect(effect: Condition | ForEach, vocabulary: Vocabulary) -> str:
    return format_each(effect, vocabulary) if isinstance(effect, ForEach) else format_condition(effect, vocabulary)


def quote_all(texts: Iterable[str]) -> str:
    """Return texts as a message names them: each once, as in `` `a` and `b` ``."""
    return " and ".join(f"`{each}`" for each in dict.fromkeys(texts))


def add_lines(lines: Sequence[str], skill: Skill) -> Fix:
    """Return the edit that adds lines at the end of a skill."""
    end = skill.span.after
    place = end._replace(column=end.column - 1, end_column=end.column - 1)
    is_one_line = skill.span.line == skill.span.end_line
    text = f"{' '.join(lines)} " if is_one_line else "".join(f"    {line}\n" for line in lines)
    what = quote_all(lines) if len(lines) == 1 else f"these {len(lines)} lines to `{skill.name}`"
    return Fix(place, text, f"add {what}", safe=False)
