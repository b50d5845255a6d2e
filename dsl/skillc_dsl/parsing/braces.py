"""Finds missing and superfluous braces by indentation, reports and repairs them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import takewhile

from skillc_dsl.diagnostics import Diagnostic, Fix, Label, Outcome
from skillc_dsl.parsing.grammar import DECLARATIONS, END, begins_line
from skillc_dsl.parsing.lexer import empty_token_after, token_span
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Span


def close_braces(tokens: tuple[Token, ...], path: str) -> Outcome[tuple[Token, ...]]:
    """Return the tokens with missing `}` added and superfluous `}` removed in each declaration."""
    closed: list[Token] = []
    problems: list[Diagnostic] = []
    for start, end in _regions(tokens):
        region = tokens[start:end]
        missing = sum((t.type == "LBRACE") - (t.type == "RBRACE") for t in region)
        if missing > 0:
            region, found = _close(region, tokens[end], missing, path)
            problems += found
        elif missing < 0:
            region, found = _without_surplus(region, -missing, path)
            problems += found
        closed += region
    return Outcome((*closed, tokens[-1]), tuple(problems))


def region_lines(tokens: tuple[Token, ...]) -> Iterator[range]:
    """Yield the lines of each declaration, up to the first line of the next."""
    for start, end in _regions(tokens):
        first, last = tokens[start].line or 1, tokens[end].line or 1
        yield range(first if start else 1, last + (tokens[end].type == END))


def _regions(tokens: tuple[Token, ...]) -> Iterator[tuple[int, int]]:
    """Yield the range of tokens of each declaration, which begins with a keyword at the beginning of a line."""
    start = 0
    for index, token in enumerate(tokens):
        if token.type == END or (index > start and _begins_declaration(tokens, index)):
            yield start, index
            start = index


def _begins_declaration(tokens: Sequence[Token], index: int) -> bool:
    """Whether a token begins a line with a keyword of declarations that is no name in a list, as of an `enum`."""
    is_first = tokens[index].type in DECLARATIONS and begins_line(tokens, index)
    return is_first and tokens[index + 1].type not in ("COMMA", "RBRACE")


def _close(
    region: Sequence[Token], following: Token, missing: int, path: str
) -> tuple[tuple[Token, ...], list[Diagnostic]]:
    """Add a `}` for each brace that is still open at a less indented `}` or at the end of the region."""
    result: list[Token] = []
    problems: list[Diagnostic] = []
    opened: list[tuple[Token, int]] = []
    indent = 1
    for index, token in enumerate(region):
        if begins_line(region, index):
            indent = token.column or 1
        if token.type == "LBRACE":
            opened.append((token, indent))
        elif token.type == "RBRACE" and opened:
            while len(problems) < missing and len(opened) > 1 and opened[-1][1] > indent:
                problems.append(_unclosed(*opened.pop(), result[-1], token, path))
                result.append(empty_token_after(result[-1], "RBRACE"))
            opened.pop()
        result.append(token)
    for opener, column in reversed(opened):
        problems.append(_unclosed(opener, column, result[-1], following, path))
        result.append(empty_token_after(result[-1], "RBRACE"))
    return tuple(result), problems


def _without_surplus(region: Sequence[Token], surplus: int, path: str) -> tuple[tuple[Token, ...], list[Diagnostic]]:
    """Remove up to `surplus` `}` that are indented deeper than the line of the brace that they would close."""
    result: list[Token] = []
    problems: list[Diagnostic] = []
    opened: list[int] = []
    lines: list[Token] = []
    for index, token in enumerate(region):
        if begins_line(region, index) or not lines:
            lines.append(token)
        indent = lines[-1].column or 1
        closes = token.type == "RBRACE" and bool(opened)
        if closes and opened[-1] < indent and len(problems) < surplus:
            problems.append(_unopened(token_span(token, path), _find_block(lines, path)))
            continue
        if token.type == "LBRACE":
            opened.append(indent)
        elif closes:
            opened.pop()
        result.append(token)
    return tuple(result), problems


def _find_block(lines: Sequence[Token], path: str) -> tuple[Label, ...]:
    """Return a label where the block begins that the last of the lines ends, as the indentation has it."""
    *before, last = lines
    block = list(takewhile(lambda line: (line.column or 1) > (last.column or 1), reversed(before)))
    return tuple(Label(token_span(each, path), "no `{` opens a block before this line") for each in block[-1:])


def _unopened(span: Span, labels: tuple[Label, ...]) -> Diagnostic:
    fix = Fix(span, "", "delete it", safe=False)
    message, help_ = "this `}` is one too many", "delete it, or add the `{` before it"
    return Diagnostic("unopened-brace", span, message, help_, labels=labels, fix=fix)


def _unclosed(opener: Token, indent: int, last: Token, found: Token, path: str) -> Diagnostic:
    """Report after `last`, where the brace belongs, that `opener` is open; `found` is the token that shows it."""
    where = "at the end of the file" if found.type == END else f"before the `{found}` of line {found.line}"
    place = token_span(last, path)
    fix = Fix(place.after, "\n" + " " * (indent - 1) + "}", "close the brace")
    message = f"the `{{` of line {opener.line} is not closed {where}"
    label = Label(token_span(opener, path), "opened here")
    return Diagnostic("unclosed-brace", place, message, "add a `}` on the next line", labels=(label,), fix=fix)
