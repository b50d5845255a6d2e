"""Repairs syntax errors by changing one token, so that the rest of the declaration can be parsed."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterator, Sequence

import msgspec

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.parsing.grammar import DECLARATIONS, END, begins_line, can_continue, fixed_texts, list_fitting_terminals
from skillc_dsl.parsing.lexer import token_span
from skillc_dsl.parsing.prefix_repairs import name_prefix
from skillc_dsl.parsing.token_repairs import join_tokens, report_missing_space
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Span

_INSERTED = (
    *("RPAR", "RSQB", "COMMA", "EQUAL", "OF", "DOTS", "LBRACE", "COLON", "LPAR", "IN", "SEQ", "PYTHON", "ARROW"),
    *("STEPS", "KEEP"),
)
_SPACED = ("EQUAL", "DOTS", "LBRACE", "ARROW")
_WORDS = ("OF", "PYTHON", "STEPS", "KEEP")
_SWAPPED = {"EQUAL": "EQUALS", "EQUALS": "EQUAL"}
_BLOCKS = ("SEQ", "SEL", "PAR", "REACTIVE")
_KEPT = DECLARATIONS | {"NAME", "QNAME", "LABEL", "LBRACE", "RBRACE", "LESS", END}


class Repair(msgspec.Struct, frozen=True):
    """The problem, and the tokens that replace the faulty one."""

    problem: Diagnostic
    tokens: tuple[Token, ...]


class Fault(msgspec.Struct, frozen=True):
    """A token that does not fit after the input that led to the parser's `states`."""

    states: Sequence[int]
    tokens: Sequence[Token]
    index: int
    path: str

    @property
    def token(self) -> Token:
        """The token that does not fit."""
        return self.tokens[self.index]

    @property
    def span(self) -> Span:
        """The place of that token."""
        return token_span(self.token, self.path)

    @property
    def gap(self) -> Span:
        """The empty place right after the preceding token."""
        if self.index == 0:
            return Span(self.path, 1, 1, 1, 1)
        before = token_span(self.tokens[self.index - 1], self.path)
        return before.after

    def mended_by(self, *terminals: str, skip: int = 1) -> bool:
        """Whether `terminals` fit in place of the next `skip` tokens, followed by the two tokens after those.

        If these two are on a new line, which may have an unrelated fault, only the first of them must fit.
        """
        start = self.index + skip
        after = self.tokens[start : start + 2]
        if begins_line(self.tokens, min(start, len(self.tokens) - 1)):
            after = after[:1]
        return can_continue(self.states, *terminals, *(token.type for token in after))


def repair(fault: Fault) -> Repair | None:
    """Return the first change of one token that lets the parser continue, or None."""
    attempts: tuple[Callable[[Fault], Iterator[Repair]], ...]
    attempts = (
        _repeated,
        _nameless_prefix,
        _nameless_implementation,
        _label,
        _swapped,
        _keyword,
        _body,
        _missing,
        _superfluous,
    )
    return next((found for attempt in attempts for found in attempt(fault)), None)


def _repeated(fault: Fault) -> Iterator[Repair]:
    """A duplicated word or mark."""
    if fault.index and fault.token == fault.tokens[fault.index - 1] and fault.token.type not in ("LBRACE", "RBRACE"):
        yield from _superfluous(fault)


def _nameless_prefix(fault: Fault) -> Iterator[Repair]:
    """An address right after `prefix`."""
    if fault.token.type == "IRI" and fault.mended_by("LABEL", "IRI"):
        name, problem = name_prefix(fault.tokens, fault.index, fault.path)
        before = fault.tokens[fault.index - 1]
        yield Repair(problem, (join_tokens("LABEL", before, before, f"{name}:"), fault.token))


def _nameless_implementation(fault: Fault) -> Iterator[Repair]:
    """`impl of SKILL`, whose `of` is read as a name."""
    before = fault.tokens[fault.index - 1]
    if before == "of" and fault.mended_by("OF", skip=0):
        span = token_span(before, fault.path)
        problem = Diagnostic("syntax", span, "the implementation has no name", "write `impl NAME of SKILL`")
        yield Repair(problem, (_inserted("OF", fault.gap), fault.token))


def _label(fault: Fault) -> Iterator[Repair]:
    """`arm:ArmDevice` and `arm ArmDevice` in place of a label."""
    token = fault.token
    if token.type == "QNAME" and fault.mended_by("LABEL", "NAME"):
        name, rest = token.split(":", 1)
        column = (token.column or 1) + len(name) + 1
        label = Token("LABEL", f"{name}:", token.start_pos, token.line, token.column, token.line, column, None)
        value = Token("NAME", rest, None, token.line, column, token.line, token.end_column, token.end_pos)
        yield Repair(report_missing_space(token_span(label, fault.path), rest), (label, value))
    elif token.isidentifier() and fault.mended_by("LABEL"):
        end = Span(fault.path, fault.span.line, fault.span.end_column, fault.span.line, fault.span.end_column)
        problem = Diagnostic("syntax", fault.span, f"`:` is missing after `{token}`", fix=Fix(end, ":", "insert `:`"))
        yield Repair(problem, (join_tokens("LABEL", token, token, f"{token}:"),))


def _swapped(fault: Fault) -> Iterator[Repair]:
    """`=` in a comparison, `==` in an assignment."""
    right = _SWAPPED.get(fault.token.type)
    if right and fault.mended_by(right):
        text = fixed_texts()[right]
        role = "compares" if right == "EQUALS" else "gives a value"
        fix = Fix(fault.span, text, f"write `{text}`")
        problem = Diagnostic("syntax", fault.span, f"`{text}` {role}, not `{fault.token}`", fix=fix)
        yield Repair(problem, (join_tokens(right, fault.token, fault.token, text),))


def _keyword(fault: Fault) -> Iterator[Repair]:
    """A misspelt keyword."""
    if fault.token.type != "NAME":
        return
    possible = list_fitting_terminals(fault.states)
    if not begins_line(fault.tokens, fault.index):
        possible -= DECLARATIONS
    keywords = {fixed_texts()[t]: t for t in possible if fixed_texts().get(t, "").isalpha()}
    for near in difflib.get_close_matches(fault.token, sorted(keywords), n=3, cutoff=0.7):
        if fault.mended_by(keywords[near]):
            fix = Fix(fault.span, near, f"write `{near}`", safe=False)
            message = f"there is no keyword `{fault.token}` that fits here"
            problem = Diagnostic("syntax", fault.span, message, f"did you mean `{near}`?", fix=fix)
            yield Repair(problem, (join_tokens(keywords[near], fault.token, fault.token, near),))


def _body(fault: Fault) -> Iterator[Repair]:
    """A block of steps without the `do` of a body."""
    if fault.token.type in _BLOCKS and begins_line(fault.tokens, fault.index) and fault.mended_by("DO", skip=0):
        start = Span(fault.path, fault.span.line, fault.span.column, fault.span.line, fault.span.column)
        problem = Diagnostic(
            "syntax", fault.span, f"`do` is missing before `{fault.token}`", fix=Fix(start, "do ", "insert `do`")
        )
        yield Repair(problem, (_inserted("DO", start), fault.token))


def _missing(fault: Fault) -> Iterator[Repair]:
    """A missing bracket, comma or short keyword before the faulty token."""
    name_fits = can_continue(fault.states, "NAME")
    complete = can_continue(fault.states, "RBRACE") or can_continue(fault.states, END)
    new_line = begins_line(fault.tokens, fault.index)
    if complete and new_line:
        return
    span = token_span(fault.tokens[fault.index - 1], fault.path) if new_line and fault.index else fault.span
    for terminal in _INSERTED:
        if (new_line and terminal == "LPAR") or (name_fits and terminal in _WORDS):
            continue
        if fault.mended_by(terminal, skip=0) and (terminal != "LBRACE" or _has_unopened(fault)):
            text, gap = fixed_texts()[terminal], fault.gap
            before = fault.tokens[fault.index - 1]
            padded = f" {text}" if text.isalpha() or terminal in _SPACED else text
            fix = Fix(gap, padded, f"insert `{text}`")
            problem = Diagnostic("syntax", span, f"`{text}` is missing after `{before}`", fix=fix)
            yield Repair(problem, (_inserted(terminal, gap), fault.token))


def _inserted(terminal: str, gap: Span) -> Token:
    """Return a token that the text lacks."""
    return Token(terminal, fixed_texts()[terminal], None, gap.line, gap.column, gap.line, gap.column, None)


def _has_unopened(fault: Fault) -> bool:
    """Whether the faulty declaration has more `}` than `{`, so that a `{` is missing."""
    open_ = 0
    for index, token in enumerate(fault.tokens):
        if token.type in DECLARATIONS and begins_line(fault.tokens, index):
            if index > fault.index:
                break
            open_ = 0
        open_ += (token.type == "LBRACE") - (token.type == "RBRACE")
    return open_ < 0


def _superfluous(fault: Fault) -> Iterator[Repair]:
    """A superfluous mark or word in a line; at the end of a line only if the line is complete without it."""
    if fault.token.type in _KEPT or begins_line(fault.tokens, fault.index):
        return
    complete = can_continue(fault.states, "RBRACE") or can_continue(fault.states, END)
    at_end = begins_line(fault.tokens, fault.index + 1)
    if fault.mended_by() and (complete or not at_end):
        fix = Fix(fault.span, "", "delete it", safe=False)
        yield Repair(Diagnostic("syntax", fault.span, f"`{fault.token}` is one too many here", fix=fix), ())
