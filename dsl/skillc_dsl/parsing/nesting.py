"""The maximum depth of nesting; deeper parts are reported and dropped here, so that later stages need no check."""

from __future__ import annotations

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.parsing.lexer import token_span
from skillc_dsl.parsing.table_types import NESTED
from skillc_dsl.parsing.tokens import Token, Tree
from skillc_dsl.source import Span

DEEPEST = 64
"""The maximum depth of nested steps, conditions and values."""
_WITH_MEMBERS = frozenset({"skill", "impl", "task", "test"})


def drop_too_deep(tree: Tree, path: str) -> tuple[Tree, tuple[Diagnostic, ...]]:
    """Return the parse tree of a file without the members and declarations nested too deep, and a problem for each."""
    problems: list[Diagnostic] = []
    declarations: list[Tree | Token] = []
    for declaration in tree.children:
        if isinstance(declaration, Tree) and declaration.data in _WITH_MEMBERS:
            members = [member for member in declaration.children if not _reported(member, path, problems)]
            declarations.append(Tree(declaration.data, members))
        elif not _reported(declaration, path, problems):
            declarations.append(declaration)
    return Tree(tree.data, declarations), tuple(problems)


def _reported(part: Tree | Token, path: str, problems: list[Diagnostic]) -> bool:
    """Whether a part is nested too deep; if so, it is reported at the first token that exceeds the maximum depth."""
    found = _first_too_deep(part)
    if found is not None:
        problems.append(report_too_deep(token_span(found, path)))
    return found is not None


def _first_too_deep(part: Tree | Token) -> Token | None:
    waiting: list[tuple[Tree | Token, int]] = [(part, 0)]
    while waiting:
        inner, level = waiting.pop()
        if isinstance(inner, Token):
            if level > DEEPEST:
                return inner
            continue
        below = level + (inner.data in NESTED)
        waiting += [(child, below) for child in reversed(inner.children)]
    return None


def report_too_deep(span: Span) -> Diagnostic:
    """Return the diagnostic for text that is nested too deep from `span` on."""
    return Diagnostic(
        "nesting-too-deep",
        span,
        f"this is nested more than {DEEPEST} levels deep",
        "make skills of parts of the steps, or name parts of a value with `let`; "
        "each `else if`, and each operator of a long sum, is a level too",
    )
