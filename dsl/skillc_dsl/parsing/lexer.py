"""The lexer: splits text into tokens; invalid characters are reported and skipped or repaired."""

from __future__ import annotations

import re
from collections.abc import Sequence
from types import MappingProxyType
from typing import NamedTuple

from skillc_dsl.diagnostics import Diagnostic, Fix, Outcome
from skillc_dsl.parsing.grammar import DECLARATIONS, END, begins_line
from skillc_dsl.parsing.table_types import WORD
from skillc_dsl.parsing.tables import load_pattern, load_tables
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source, Span
from skillc_dsl.token_table import list_later_words

_HINTS = MappingProxyType(
    {
        ";": "a line needs no `;` at its end",
        "'": 'text stands in double quotes: "like this"',
        "^": "write a square as `m2`, or as a product",
        "°": "write `deg`, as in `90 deg`",
        "%": "it is a unit, as in `5 %`, and no operator",
        "@": "names of individuals are written with their prefix, as in `lab:Board-1`",
        "$": "parameters are read by their bare name",
        "?": "parameters are read by their bare name",
    }
)
_MEANT = MappingProxyType(
    {
        **dict.fromkeys(("&", "&&", "∧"), "and"),
        **dict.fromkeys(("|", "||", "∨"), "or"),
        **dict.fromkeys(("!", "~", "¬"), "not"),
        **dict.fromkeys(("×", "·"), "*"),
        "÷": "/",
        "≤": "<=",
        "≥": ">=",
        "≠": "!=",
        "→": "implies",
        **dict.fromkeys((";", "$", "?"), ""),
    }
)
"""What replaces characters of other languages; empty if they are deleted."""


class LexerPosition(NamedTuple):
    """A position in the text, with its line and column."""

    position: int
    line: int
    column: int


_BEFORE_OF = ("IMPL", "LABEL", "COLON", "LSQB", "ARROW")
"""What stands before the name that `of` follows, where it is a word."""


def token_span(token: Token, path: str) -> Span:
    """Return the place of a token."""
    return Span(path, token.line or 1, token.column or 1, token.end_line or 1, token.end_column or 1)


def tokenize(source: Source) -> Outcome[tuple[Token, ...]]:
    """Return the tokens of `source` followed by an END token, without invalid characters.

    Words that came after the edition of the source are names, and so is every word right after a dot.
    """
    tables, match, text = load_tables(), load_pattern().match, source.text
    words, ignored, tokens = tables.words, tables.ignored, list[Token]()
    problems: list[Diagnostic] = []
    at, line, begin, size = 0, 1, 0, len(text)
    while at < size:
        found = match(text, at)
        if found is None:
            at += _skip(LexerPosition(at, line, at - begin + 1), source, tokens, problems)
            continue
        end, terminal = found.end(), found.lastgroup or ""
        if terminal not in ignored:
            written = found.group()
            if terminal == WORD and written in words and not _is_member(tokens, at):
                terminal = words[written]
            tokens.append(Token(terminal, written, at, line, at - begin + 1, line, end - begin + 1, end))
        elif breaks := text.count("\n", at, end):
            line, begin = line + breaks, text.rindex("\n", at, end) + 1
        at = end
    if later := list_later_words(source.edition):
        _read_as_names(tokens, later)
    return Outcome((*tokens, empty_token_after(tokens[-1] if tokens else None, END)), tuple(problems))


def _is_member(tokens: Sequence[Token], at: int) -> bool:
    """Whether a word at this position stands right after a dot, as in `why.skill`."""
    return bool(tokens) and tokens[-1].type == "DOT" and tokens[-1].end_pos == at


def _read_as_names(tokens: list[Token], later: frozenset[str]) -> None:
    """Make names of later words and of `of`, but for declarations that begin with one: no name can stand there."""
    terminals = {load_tables().words[word] for word in later}
    is_later = False
    for index, token in enumerate(tokens):
        if token.type in DECLARATIONS and begins_line(tokens, index):
            is_later = token.type in terminals and (is_later or _opens_block(tokens, index))
        if (token.type in terminals and not is_later) or _is_value_called_of(tokens, index):
            place = (token.start_pos, token.line, token.column, token.end_line, token.end_column, token.end_pos)
            tokens[index] = Token(WORD, token.value, *place)


def _is_value_called_of(tokens: Sequence[Token], index: int) -> bool:
    """Whether `of` stands neither in a type nor in the head of an `impl`: there it was a name before `pre of` came."""
    return tokens[index].type == "OF" and (index < 2 or tokens[index - 2].type not in _BEFORE_OF)


def _opens_block(tokens: Sequence[Token], index: int) -> bool:
    """Whether a name and `{` follow the token at `index`."""
    return [each.type for each in tokens[index + 2 : index + 3]] == ["LBRACE"]


def empty_token_after(last: Token | None, terminal: str) -> Token:
    """Return an empty token right after `last`, or at the start of the file."""
    line, column, position = (last.end_line, last.end_column, last.end_pos) if last is not None else (1, 1, 0)
    return Token(terminal, "", position, line, column, line, column, position)


def _skip(place: LexerPosition, source: Source, tokens: list[Token], problems: list[Diagnostic]) -> int:
    """Report characters that form no token, an unterminated string or a run of unknown ones; return how many."""
    start, line, column = place
    quote = {'"': r'"[^\n]*', "'": r"'[^'\n]*'|'+"}.get(source.text[start])
    pattern = quote or re.escape(source.text[start]) + "+"
    match = re.compile(pattern).match(source.text, start)
    stretch = match.group().rstrip() if match else source.text[start]
    span = Span(source.path, line, column, line, column + len(stretch))
    end = (line, span.end_column, start + len(stretch))
    if stretch.startswith('"'):
        tokens.append(Token("STRING", f'{stretch}"', start, line, column, *end))
        problems.append(_unterminated(span))
    elif stretch.startswith("'") and len(stretch) > 1:
        tokens.append(Token("STRING", f'"{stretch[1:-1]}"', start, line, column, *end))
        problems.append(_single_quotes(span, stretch))
    else:
        problems.append(_unknown_character(span, stretch, source.text[max(0, start - 1) : end[2] + 1]))
    return len(stretch)


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


def _unknown_character(span: Span, stretch: str, around: str) -> Diagnostic:
    shown = stretch if stretch.isprintable() else f"U+{ord(stretch[0]):04X}"
    meant = _MEANT.get(stretch)
    help_ = _HINTS.get(stretch[0]) or (f"write `{meant}`" if meant else "delete it")
    fix = None
    if meant is not None:
        before, after = (" " * (bool(meant) and not side.isspace()) for side in (around[0], around[-1]))
        fix = Fix(span, f"{before}{meant}{after}", f"write `{meant}`" if meant else "delete it", safe=False)
    return Diagnostic("unknown-character", span, f"`{shown}` means nothing here", help_, fix=fix)
