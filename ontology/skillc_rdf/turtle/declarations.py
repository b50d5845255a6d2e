"""Parses declarations of prefixes and of the base."""

from __future__ import annotations

from skillc_dsl.diagnostics import Fix
from skillc_rdf.turtle import messages
from skillc_rdf.turtle.cursor import Cursor
from skillc_rdf.turtle.messages import SyntaxMessage
from skillc_rdf.turtle.term_parser import TermParser
from skillc_rdf.turtle.terms import local_of
from skillc_rdf.turtle.tokens import Token


class DeclarationParser:
    """Parses declarations at the cursor, and declares them in `naming`."""

    def __init__(self, cursor: Cursor, naming: TermParser) -> None:
        self._cursor = cursor
        self._naming = naming

    def read(self) -> None:
        """Parse a declaration, complete or not."""
        keyword = self._cursor.take()
        word = keyword.text.removeprefix("@")
        if word.lower() not in ("prefix", "base") or (keyword.kind == "at" and word != word.lower()):
            self._not_understood(
                keyword, SyntaxMessage(f"there is no `{keyword.text}`", "the directives are `@prefix` and `@base`")
            )
            return
        name = self._cursor.take() if word.lower() == "prefix" else None
        if name is not None and (name.kind != "name" or local_of(name)[1]):
            self._not_understood(name, messages.explain_declaration(word.lower()))
        elif self._cursor.peek.kind != "iri":
            self._naming.give_up(name)
            self._not_understood(self._cursor.peek, messages.explain_declaration(word.lower()))
        else:
            self._naming.declare(name, self._cursor.take())
            self._end_directive(keyword)

    def read_lost(self) -> None:
        """Parse the declaration of a prefix without `@prefix`."""
        name = self._cursor.take()
        place = self._cursor.lines.place(name.start, name.start)
        edit = Fix(place, "@prefix ", "insert `@prefix`", safe=False)
        self._cursor.report(name, SyntaxMessage("`@prefix` is missing before this"), edit)
        self._naming.declare(name, self._cursor.take())
        self._cursor.take_mark(".")

    def leave_line(self) -> None:
        """Skip the rest of the line."""
        cursor = self._cursor
        while not (cursor.at_new_line or cursor.at_end or cursor.at_directive or cursor.at_lost_prefix):
            self._naming.doubt(cursor.take())

    def _end_directive(self, keyword: Token) -> None:
        if keyword.kind == "at":
            self._end_line()
        elif self._cursor.peek.is_mark("."):
            message = SyntaxMessage(f"`{keyword.text}` does not end with a `.`", "delete the `.`")
            self._cursor.report(self._cursor.take(), message)

    def _end_line(self) -> None:
        """Take the `.` of a declaration; if it is missing, report that and skip the rest of the line."""
        if self._cursor.take_mark("."):
            return
        self._cursor.report_missing(".")
        self.leave_line()

    def _not_understood(self, token: Token, message: SyntaxMessage) -> None:
        """Report an error and skip the statement."""
        self._cursor.report(token, message)
        while not self._cursor.peek.is_mark(".") and not self._cursor.at_end:
            self._naming.doubt(self._cursor.take())
        self._cursor.take_mark(".")
