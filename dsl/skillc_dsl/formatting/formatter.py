"""The formatter of `.skill` files."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec

from skillc_dsl.comments import find_comments
from skillc_dsl.diagnostics import Diagnostic, Fix, Outcome
from skillc_dsl.formatting.files import FileFormatter
from skillc_dsl.formatting.layout import lay_out, render_rows
from skillc_dsl.formatting.notes import attach_comments
from skillc_dsl.parsing.automaton import parse_tree
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.parser import parse
from skillc_dsl.parsing.tokens import Token, Tree
from skillc_dsl.source import Source, Span

_WRITTEN = ("text", "goal_text")
"""Fields that hold the source text of a condition."""
_TEXT_OR_BLANK = re.compile(r'("[^"\n]*")|\s+')


def equal_modulo_layout(left: Source, right: Source) -> bool:
    """Whether both parse without errors to the same tree and have the same comments in the same order."""
    trees = parse(left), parse(right)
    if not all(tree.ok for tree in trees):
        return False
    notes = ([comment.written for comment in find_comments(source)] for source in (left, right))
    return _flat(trees[0].value) == _flat(trees[1].value) and next(notes) == next(notes)


def _flat(tree: object) -> list[object]:
    """Return the content of a tree in order, without places; brackets mark its nested parts."""
    result: list[object] = []
    pending: list[object] = [tree]
    while pending:
        node = pending.pop()
        match node:
            case Span():
                continue
            case tuple():
                pending += [_END, *reversed(node), "("]
            case msgspec.Struct():
                pending += [_END, *reversed([_field(node, name) for name in node.__struct_fields__])]
                result.append(type(node))
            case _:
                result.append(node)
    return result


_END = ")"


def _field(node: object, name: str) -> object:
    value = getattr(node, name)
    return _TEXT_OR_BLANK.sub(r"\1", value) if name in _WRITTEN and isinstance(value, str) else value


def format_source(source: Source) -> Outcome[str]:
    """Return the formatted text of a file, with the same meaning and the same comments.

    A file with errors is returned unchanged, with the errors as diagnostics, as is a file whose meaning would change.
    """
    errors = tuple(problem for problem in parse(source).diagnostics if problem.severity == "error")
    if errors:
        return Outcome(source.text, errors)
    text = _layout(source)
    if text != source.text and not equal_modulo_layout(source, source._replace(text=text)):
        return Outcome(source.text, (_refused(source, "it would not mean the same"),))
    return Outcome(text)


def check_layout(source: Source) -> Diagnostic | None:
    """Return the warning that a file is not formatted, at the first line that differs, with the formatted text as fix.

    Return None for a formatted file, and for a file with errors, which must be fixed first.
    """
    outcome = format_source(source)
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
    tree = parse_tree(tokenize(source).value)
    notes = attach_comments(source, [*tree.tokens()], frozenset(_statements(tree)))
    return render_rows(lay_out(FileFormatter(notes).file(tree)))


def _statements(tree: Tree) -> Iterator[int]:
    """Yield the positions of declarations, members and steps; blank lines above them are kept."""
    for holder in tree.trees():
        names = [child.type for child in holder.children if isinstance(child, Token)]
        if holder.data == "start" or "LBRACE" in names:
            for child in holder.children:
                first = next(child.tokens(), None) if isinstance(child, Tree) else None
                if first is not None:
                    yield first.start_pos or 0


def _refused(source: Source, why: str) -> Diagnostic:
    start = Span(source.path, 1, 1, 1, 1)
    message = f"this file cannot be formatted: {why}"
    return Diagnostic("not-formatted", start, message, "it is left as it is; please report it")
