"""The one way a `.skill` file is laid out."""

from __future__ import annotations

from collections.abc import Iterator

from lark import Token, Tree

from skillc_dsl.diagnostics import Diagnostic, Fix, Outcome
from skillc_dsl.formatting.declarations import Declarations
from skillc_dsl.formatting.layout import lay_out
from skillc_dsl.formatting.notes import notes_of
from skillc_dsl.formatting.remarks import text_of
from skillc_dsl.formatting.sameness import say_the_same
from skillc_dsl.grammar import machine
from skillc_dsl.parser import parse
from skillc_dsl.source import Source, Span


def formatted(source: Source) -> Outcome[str]:
    """Return the text of a file in its one layout: same meaning, same comments.

    A file with errors stays as it is, and they are told. So does one that would not mean the same.
    """
    errors = tuple(problem for problem in parse(source).diagnostics if problem.severity == "error")
    if errors:
        return Outcome(source.text, errors)
    text = _layout(source)
    if text != source.text and not say_the_same(source, Source(source.path, text)):
        return Outcome(source.text, (_refused(source, "it would not mean the same"),))
    return Outcome(text)


def not_formatted(source: Source) -> Diagnostic | None:
    """Return the warning that a file is not in its one layout, at the first line that differs, with the layout as fix.

    None for a file that is, and for one with errors, which have to be cured first.
    """
    outcome = formatted(source)
    if not outcome.ok or outcome.value == source.text:
        return None
    old, new = source.text.split("\n"), outcome.value.split("\n")
    same = next((n for n, (left, right) in enumerate(zip(old, new, strict=False)) if left != right), len(new) - 1)
    line = min(same, len(old) - 1)
    span = Span(source.path, line + 1, 1, line + 1, len(old[line]) + 1)
    fix = Fix(Span(source.path, 1, 1, len(old), len(old[-1]) + 1), outcome.value, "format the file")
    message = "this file is not formatted; this is the first line that differs"
    return Diagnostic("not-formatted", span, message, "run `skillc fmt` on it", "warning", fix=fix)


def _layout(source: Source) -> str:
    tree: Tree[Token] = machine().parse(source.text)
    tokens = list(tree.scan_values(lambda value: isinstance(value, Token)))
    notes = notes_of(source, tokens, frozenset(_statements(tree)))
    return text_of(lay_out(Declarations(notes).file(tree)))


def _statements(tree: Tree[Token]) -> Iterator[int]:
    """Yield where each declaration, member and step starts, above which a blank line may stand."""
    for holder in tree.iter_subtrees():
        names = [child.type for child in holder.children if isinstance(child, Token)]
        if holder.data == "start" or "LBRACE" in names:
            for child in holder.children:
                first = next(child.scan_values(lambda v: True), None) if isinstance(child, Tree) else None
                if first is not None:
                    yield first.start_pos or 0


def _refused(source: Source, why: str) -> Diagnostic:
    start = Span(source.path, 1, 1, 1, 1)
    message = f"this file cannot be formatted: {why}"
    return Diagnostic("not-formatted", start, message, "it is left as it is; please report it")
