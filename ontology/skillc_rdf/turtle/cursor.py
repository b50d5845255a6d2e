"""The parser's position in the tokens of a text, with look-ahead, error recovery and error reports."""

from __future__ import annotations

from functools import cached_property

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_rdf.turtle.lines import Lines
from skillc_rdf.turtle.messages import SyntaxMessage, explain_missing_mark
from skillc_rdf.turtle.statements import Extent
from skillc_rdf.turtle.tokens import Token, tokens


class Cursor:
    """The tokens of a text and the position among them; `problems` collects diagnostics."""

    def __init__(self, path: str, text: str) -> None:
        self.lines = Lines(path, text)
        self.problems: list[Diagnostic] = []
        self._tokens = list(tokens(text))
        self._next = 0
        self._line_told = 0

    @property
    def peek(self) -> Token:
        """The next token."""
        return self._tokens[self._next]

    @property
    def before(self) -> Token:
        """The token taken last."""
        return self._tokens[self._next - 1]

    @property
    def at_end(self) -> bool:
        """Whether no token is left."""
        return self.peek.kind == "end"

    @property
    def at_directive(self) -> bool:
        """Whether a declaration of a prefix or base begins here."""
        return self.peek.kind == "at" or (self.peek.kind == "word" and self.peek.text.upper() in ("PREFIX", "BASE"))

    @property
    def at_typed_thing(self) -> bool:
        """Whether a subject and `a` come next, as at the beginning of a statement."""
        return self.peek.kind in ("name", "iri") and self._tokens[self._next + 1].is_word("a")

    @property
    def at_lost_prefix(self) -> bool:
        """Whether a prefix, its IRI and `.` come next: a declaration without `@prefix`."""
        first, second, third = (*self._tokens[self._next : self._next + 3], self.peek, self.peek)[:3]
        return first.kind == "name" and first.text.endswith(":") and second.kind == "iri" and third.is_mark(".")

    @property
    def at_value_of_name(self) -> bool:
        """Whether a name and a literal come after a `.`: a statement that was ended too early."""
        after = self._tokens[min(self._next + 1, len(self._tokens) - 1)]
        return self.peek.kind == "name" and after.kind in ("number", "text") and self.before.is_mark(".")

    @property
    def at_new_line(self) -> bool:
        """Whether the next token is on a later line than the one taken last."""
        return self.lines.line(self.peek.start) > self.lines.line(self.before.start)

    @cached_property
    def names(self) -> frozenset[str]:
        """All prefixed names in the text."""
        return frozenset(token.text for token in self._tokens if token.kind == "name")

    def take(self) -> Token:
        """Return the next token and advance."""
        token = self._tokens[self._next]
        if token.kind != "end":
            self._next += 1
        return token

    def take_mark(self, mark: str) -> bool:
        """Advance if the next token is the mark; return whether it was."""
        found = self.peek.is_mark(mark)
        if found:
            self.take()
        return found

    def terms_ahead(self, most: int) -> int:
        """Return how many terms come before the next mark, at most `most`."""
        count, position = 0, self._next
        while (token := self._tokens[position]).begins_term and count < most:
            count += 1
            position += 1
            if token.is_mark("[("):
                position = self._behind_bracket(position)
            while self._tokens[position].kind in ("at", "datatype"):
                position += 2 if self._tokens[position].kind == "datatype" else 1
        return count

    def put(self, mark: str) -> None:
        """Report that a mark is missing here, and insert it before the next token."""
        self.report_missing(mark)
        self.insert(mark)

    def report_missing(self, mark: str) -> None:
        """Report that a mark is missing here."""
        before = self.before
        place = self.lines.place(before.end, before.end)
        self.report(before, explain_missing_mark(mark, before), Fix(place, f" {mark}", f"insert `{mark}`", safe=False))

    def insert(self, mark: str) -> None:
        """Insert a mark before the next token."""
        self._tokens.insert(self._next, Token("mark", mark, self.before.end, self.before.end))

    def replace_last(self, mark: str, message: SyntaxMessage) -> None:
        """Report that the token taken last should be `mark`, and insert that before the next token."""
        self.report(self.before, message._replace(instead=mark))
        self.insert(mark)

    def report(self, token: Token, message: SyntaxMessage, edit: Fix | None = None) -> None:
        """Report an error at a token; further errors on the same line are consequences and are omitted."""
        place = self.lines.place(token.start, max(token.end, token.start + (token.kind == "end")))
        if self._line_told in (place.line, place.end_line):
            return
        self._line_told = place.end_line
        if edit is None and message.instead is not None:
            edit = Fix(place, message.instead, f"write `{message.instead}`", safe=False)
        self.problems.append(Diagnostic("broken-turtle", place, message.message, message.help, fix=edit))

    def _behind_bracket(self, position: int) -> int:
        depth = 1
        while depth and self._tokens[position].kind != "end":
            depth += self._tokens[position].is_mark("[(") - self._tokens[position].is_mark("])")
            position += 1
        return position


def extent(token: Token) -> Extent:
    """Return the extent of a token."""
    return Extent(token.start, token.end)
