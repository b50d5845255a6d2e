"""The one way a `.skill` file is laid out."""

from __future__ import annotations

from collections.abc import Iterator

from lark import Token, Tree

from skillc_dsl.diagnostics import Diagnostic, Outcome
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

    A file with errors stays as it is, and they are told. So does one that would not mean the same, which is a fault
    of skillc's and told as `not-formattable`.
    """
    errors = tuple(problem for problem in parse(source).diagnostics if problem.severity == "error")
    if errors:
        return Outcome(source.text, errors)
    try:
        text = _layout(source)
    except RecursionError:
        return Outcome(source.text, (_not_formattable(source, "it nests too deeply"),))
    if not say_the_same(source, Source(source.path, text)):
        return Outcome(source.text, (_not_formattable(source, "it would not mean the same"),))
    return Outcome(text)


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


def _not_formattable(source: Source, why: str) -> Diagnostic:
    message = f"the file cannot be formatted: {why}"
    return Diagnostic(
        "not-formattable", Span(source.path, 1, 1, 1, 1), message, "it is left as it is; please report it"
    )
