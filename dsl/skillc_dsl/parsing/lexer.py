"""The lexer: splits text into tokens; invalid characters are reported and skipped or repaired."""

from __future__ import annotations

import re
from types import MappingProxyType

from lark import Token
from lark.exceptions import UnexpectedCharacters
from lark.lexer import LexerState

from skillc_dsl.diagnostics import Diagnostic, Fix, Outcome
from skillc_dsl.encoding import REPLACEMENT
from skillc_dsl.parsing.grammar import END, load_parser
from skillc_dsl.source import Source, Span

_HINTS = MappingProxyType(
    {
        ";": "a line needs no `;` at its end",
        "'": 'text stands in double quotes: "like this"',
        "&": "write `and`",
        "|": "write `or`",
        "!": "write `not`",
        "^": "write a square as `m2`, or as a product",
        "°": "write `deg`, as in `90 deg`",
        "%": "write a fraction, such as 0.2",
        "@": "names of individuals are written with their prefix, as in `lab:Board-1`",
        "$": "parameters are read by their bare name",
        "?": "parameters are read by their bare name",
    }
)


def token_span(token: Token, path: str) -> Span:
    """Return the place of a token."""
    return Span(path, token.line or 1, token.column or 1, token.end_line or 1, token.end_column or 1)


def tokenize(source: Source) -> Outcome[tuple[Token, ...]]:
    """Return the tokens of `source` followed by an END token, without invalid characters."""
    thread = load_parser().parse_interactive(source.text).lexer_thread
    tokens: list[Token] = []
    problems: list[Diagnostic] = []
    while True:
        try:
            tokens.extend(thread.lexer.lex(thread.state, None))
        except UnexpectedCharacters:
            _skip(thread.state, source, tokens, problems)
        else:
            break
    return Outcome((*tokens, empty_token_after(tokens[-1] if tokens else None, END)), tuple(problems))


def empty_token_after(last: Token | None, terminal: str) -> Token:
    """Return an empty token right after `last`, or at the start of the file."""
    line, column, position = (last.end_line, last.end_column, last.end_pos) if last is not None else (1, 1, 0)
    return Token(terminal, "", position, line, column, line, column, position)


def _skip(state: LexerState, source: Source, tokens: list[Token], problems: list[Diagnostic]) -> None:
    """Report and skip characters that form no token: an unterminated string, or a run of unknown characters."""
    counter = state.line_ctr
    start, line, column = counter.char_pos, counter.line, counter.column
    quote = {'"': r'"[^\n]*', "'": r"'[^'\n]*'|'+"}.get(source.text[start])
    pattern = quote or re.escape(source.text[start]) + "+"
    match = re.compile(pattern).match(source.text, start)
    stretch = match.group().rstrip() if match else source.text[start]
    span = Span(source.path, line, column, line, column + len(stretch))
    if stretch.startswith('"'):
        end = (line, span.end_column, start + len(stretch))
        tokens.append(Token("STRING", f'{stretch}"', start, line, column, *end))
        problems.append(_unterminated(span))
    elif stretch.startswith("'") and len(stretch) > 1:
        tokens.append(
            Token("STRING", f'"{stretch[1:-1]}"', start, line, column, line, span.end_column, start + len(stretch))
        )
        problems.append(_single_quotes(span, stretch))
    elif stretch[0] != REPLACEMENT:
        problems.append(_unknown_character(span, stretch))
    counter.feed(Token("STRING", stretch), test_newline=False)


def _unterminated(span: Span) -> Diagnostic:
    end = Span(span.path, span.line, span.end_column, span.line, span.end_column)
    help_ = "text stands between two double quotes on one line"
    message = 'this text has no closing `"` on its line'
    return Diagnostic("unterminated-string", span, message, help_, fix=Fix(end, '"', "close the text"))


def _single_quotes(span: Span, stretch: str) -> Diagnostic:
    fix = Fix(span, f'"{stretch[1:-1]}"', "use double quotes")
    return Diagnostic(
        "unknown-character", span, "text stands in double quotes, not in `'`", 'like this: "text"', fix=fix
    )


def _unknown_character(span: Span, stretch: str) -> Diagnostic:
    shown = stretch if stretch.isprintable() else f"U+{ord(stretch[0]):04X}"
    return Diagnostic("unknown-character", span, f"`{shown}` means nothing here", _HINTS.get(stretch[0], "delete it"))
