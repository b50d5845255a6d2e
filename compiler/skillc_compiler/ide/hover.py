"""What to show about the name under the cursor."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.describing import described
from skillc_dsl.source import Span


@dataclass(frozen=True, slots=True)
class Hover:
    """A text in Markdown about a place."""

    span: Span
    markdown: str


def hover(analysis: Analysis, path: str, line: int, column: int) -> Hover | None:
    """Return what is known of the name at a place; a shorthand argument tells of the parameter and the local name."""
    there = analysis.index.at(path, line, column)
    if not there:
        return None
    span = there[0].span
    texts = [described(analysis, occurrence.symbol) for occurrence in there if occurrence.span == span]
    told = list(dict.fromkeys(text for text in texts if text))
    return Hover(span, "\n\n---\n\n".join(told)) if told else None
