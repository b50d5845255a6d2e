"""A reader's place among the tokens of a text: what comes next, what is missing, what has been said to be wrong."""

from __future__ import annotations

from functools import cached_property

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_rdf.turtle.lines import Lines
from skillc_rdf.turtle.messages import SyntaxMessage, missing_mark
from skillc_rdf.turtle.statements import Extent
from skillc_rdf.turtle.tokens import Token, tokens


class Cursor:
    """The tokens of a text and the next of them; `problems` collects what is wrong."""

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
        """The token that was taken last."""
        return self._tokens[self._next - 1]

    @property
    def at_end(self) -> bool:
        """Whether there is no more token."""
        return self.peek.kind == "end"

    @property
    def at_directive(self) -> bool:
        """Whether a declaration of a prefix or a base begins here."""
        return self.peek.kind == "at" or (self.peek.kind == "word" and self.peek.text.upper() in ("PREFIX", "BASE"))

    @property
    def at_typed_thing(self) -> bool:
        """Whether a thing with its class comes next, as at the beginning of a statement."""
        return self.peek.kind in ("name", "iri") and self._tokens[self._next + 1].is_word("a")

    @property
    def at_lost_prefix(self) -> bool:
        """Whether a prefix and its IRI come next, as in a declaration, and nothing else."""
        first, second, third = (*self._tokens[self._next : self._next + 3], self.peek, self.peek)[:3]
        return first.kind == "name" and first.text.endswith(":") and second.kind == "iri" and third.is_mark(".")

    @property
    def at_value_of_name(self) -> bool:
        """Whether a name and a value come next, as in the middle of a statement."""
        after = self._tokens[min(self._next + 1, len(self._tokens) - 1)]
        return self.peek.kind == "name" and after.kind in ("number", "text") and self.before.is_mark(".")

    @property
    def at_new_line(self) -> bool:
        """Whether the next token stands on a later line than the one taken last."""
        return self.lines.line(self.peek.start) > self.lines.line(self.before.start)

    @cached_property
    def names(self) -> frozenset[str]:
        """All names with prefixes that the text has."""
        return frozenset(token.text for token in self._tokens if token.kind == "name")

    def take(self) -> Token:
        """Return the next token and go on."""
        token = self._tokens[self._next]
        if token.kind != "end":
            self._next += 1
        return token

    def take_mark(self, mark: str) -> bool:
        """Go on if the next token is the mark; whether it was."""
        found = self.peek.is_mark(mark)
        if found:
            self.take()
        return found

    def terms_ahead(self, most: int) -> int:
        """Return how many terms come before the next mark, at most so many."""
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
        """Say that a mark is missing here, and put it before the next token."""
        self.report_missing(mark)
        self.insert(mark)

    def report_missing(self, mark: str) -> None:
        """Say that a mark is missing here."""
        before = self.before
        place = self.lines.place(before.end, before.end)
        self.report(before, missing_mark(mark, before), Fix(place, f" {mark}", f"insert `{mark}`", safe=False))

    def insert(self, mark: str) -> None:
        """Put a mark before the next token."""
        self._tokens.insert(self._next, Token("mark", mark, self.before.end, self.before.end))

    def replace_last(self, mark: str, message: SyntaxMessage) -> None:
        """Say that the token taken last should be a mark, and put that before the next token."""
        self.report(self.before, message._replace(instead=mark))
        self.insert(mark)

    def report(self, token: Token, message: SyntaxMessage, edit: Fix | None = None) -> None:
        """Report what is wrong with a token; further problems on the same line follow from it and are left out."""
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
    """Return where a token begins and ends."""
    return Extent(token.start, token.end)
