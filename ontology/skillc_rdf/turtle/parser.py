"""Parses Turtle into statements. After an error the parser continues at the next `;` or `.`."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.turtle import messages
from skillc_rdf.turtle.cursor import Cursor, extent
from skillc_rdf.turtle.declarations import DeclarationParser
from skillc_rdf.turtle.messages import SyntaxMessage, detect_other_format
from skillc_rdf.turtle.statements import SOMETHING, Extent, Node, Parsed, Statement
from skillc_rdf.turtle.term_parser import ParsedTerm, TermParser
from skillc_rdf.turtle.terms import RDF, RDF_TYPE, make_node
from skillc_rdf.turtle.tokens import Token

NOTHING_KNOWN: Mapping[str, str] = MappingProxyType({})
DEEPEST = 100
"""The greatest depth of nested brackets."""
MOST_PROBLEMS = 100
"""The number of errors after which the rest of a text is not read."""
_SURROGATE = re.compile("[\ud800-\udfff]")
FIRST, REST, NIL = f"{RDF}first", f"{RDF}rest", f"{RDF}nil"


def parse(path: str, text: str, base: str = "", known: Mapping[str, str] = NOTHING_KNOWN) -> Parsed:
    """Parse a Turtle text. `base` resolves relative IRIs; `known` are the prefixes of the vocabularies."""
    halves = _SURROGATE.search(text)
    if halves is not None:
        line, column = text.count("\n", 0, halves.start()) + 1, halves.start() - text.rfind("\n", 0, halves.start())
        half = Diagnostic("broken-turtle", Span(path, line, column, line, column + 1), "this is half a character")
        return Parsed((), {}, (half,), frozenset({SOMETHING}))
    other = detect_other_format(text)
    if other is not None:
        problem = Diagnostic("not-turtle", Span(path, 1, 1, 1, 2), f"this is {other[0]}, not Turtle", other[1])
        return Parsed((), {}, (problem,), frozenset())
    return _Parser(Cursor(path, text), base, known).document()


class _Parser:
    """A recursive descent parser; each method takes the tokens of the construct that it is named after."""

    def __init__(self, cursor: Cursor, base: str, known: Mapping[str, str]) -> None:
        self._cursor = cursor
        self._naming = TermParser(cursor, base, known)
        self._declarations = DeclarationParser(cursor, self._naming)
        self._statements: list[Statement] = []
        self._depth = 0

    def document(self) -> Parsed:
        cursor = self._cursor
        subject: ParsedTerm = None, Extent(0, 0)
        while not cursor.at_end:
            if len(cursor.problems) >= MOST_PROBLEMS:
                self._give_up()
                break
            if cursor.at_directive:
                self._declarations.read()
            elif cursor.at_lost_prefix:
                self._declarations.read_lost()
            elif cursor.peek.is_mark("."):
                cursor.report(cursor.peek, messages.explain_no_subject(cursor.take()))
            else:
                subject = self._sentence(subject)
        problems = sorted((*cursor.problems, *self._naming.prefixes.problems()), key=lambda problem: problem.span)
        prefixes = self._naming.prefixes.all()
        return Parsed(tuple(self._statements), prefixes, tuple(problems), frozenset(self._naming.doubtful))

    def _give_up(self) -> None:
        """Skip the rest of a text with too many errors."""
        token = self._cursor.peek
        message = SyntaxMessage(f"there are {MOST_PROBLEMS} errors before this; the rest of the file is not checked")
        self._cursor.report(token, message)
        self._naming.doubtful.add(SOMETHING)

    def _sentence(self, before: ParsedTerm) -> ParsedTerm:
        """Parse the statements about a subject and return it: `before` if they continue those about that one."""
        cursor = self._cursor
        if cursor.peek.is_mark(";,"):
            cursor.report(cursor.peek, messages.explain_no_subject(cursor.take()))
            if before[0] is None:
                self._declarations.leave_line()
                return before
            subject = before
        elif cursor.at_value_of_name and before[0] is not None:
            cursor.report(cursor.before, messages.explain_early_end())
            subject = before
        else:
            subject = self._subject()
            if subject[0] is None and cursor.at_lost_prefix:
                return before
        self._pairs(*subject)
        self._end()
        return subject

    def _end(self) -> None:
        """Take the `.` of a statement, or report that it is missing."""
        if not self._cursor.take_mark(".") and not self._cursor.peek.is_mark(",;"):
            self._cursor.put(".")
            self._cursor.take()

    def _subject(self) -> ParsedTerm:
        token = self._cursor.peek
        if token.kind in ("iri", "name", "blank") or token.is_mark("(["):
            return self._term()
        message = messages.explain_invalid_term(token, self._cursor.names) or messages.explain_no_subject(token)
        self._cursor.report(token, message)
        if not token.is_word("a"):
            self._cursor.take()
        self._naming.doubtful.add(SOMETHING)
        return None, extent(token)

    def _pairs(self, subject: Node | None, at: Extent) -> None:
        """Parse `predicate object, .. ; ..` up to a `.` or a `]`; broken pairs are skipped."""
        cursor = self._cursor
        if self._says_nothing(subject):
            cursor.report(cursor.before, messages.explain_lone_subject(cursor.before))
        while not cursor.peek.is_mark(".])") and not cursor.at_end:
            if cursor.take_mark(";"):
                if cursor.at_typed_thing and not self._depth:
                    cursor.replace_last(".", messages.explain_new_statement(cursor.peek))
                continue
            statements = len(self._statements)
            if self._pair(subject, at):
                continue
            self._leave_out(statements)
            if isinstance(subject, ox.NamedNode):
                self._naming.doubtful.add(subject.value)

    def _says_nothing(self, subject: Node | None) -> bool:
        """Whether a statement ends after its subject; a subject `[ .. ]` alone is a statement."""
        if self._cursor.before.is_mark("]") and self._cursor.peek.is_mark("."):
            return False
        return subject is not None and not self._cursor.peek.begins_term

    def _pair(self, subject: Node | None, at: Extent) -> bool:
        """Parse a predicate and its objects; return whether they are valid."""
        cursor, written = self._cursor, self._cursor.peek
        predicate = self._predicate()
        while predicate is not None:
            if not cursor.peek.begins_term or self._at_next_statement():
                self._report_no_object(written)
                return False
            object_, object_at = self._term(written)
            if object_ is None:
                return False
            if subject is not None:
                places = at, extent(written), object_at
                self._statements.append(Statement(subject, predicate, object_, *places, cursor.lines))
            if not cursor.take_mark(","):
                return cursor.peek.is_mark(";.]") or self._mended()
        return False

    def _at_next_statement(self) -> bool:
        """Whether a statement begins on a later line, so that the one before lacks its end."""
        return not self._depth and self._cursor.at_typed_thing and self._cursor.at_new_line

    def _report_no_object(self, predicate: Token) -> None:
        before = self._cursor.before
        if before.is_mark(","):
            self._cursor.report(
                before, SyntaxMessage("a value is missing after this `,`", "write it, or delete the `,`")
            )
        else:
            self._cursor.report(predicate, messages.explain_no_object(self._cursor.peek, predicate))

    def _predicate(self) -> str | None:
        token = self._cursor.take()
        if token.is_word("a"):
            return RDF_TYPE
        if token.kind in ("iri", "name"):
            return self._naming.iri(token)
        self._cursor.report(
            token, messages.explain_invalid_term(token, self._cursor.names) or messages.explain_no_predicate(token)
        )
        return None

    def _mended(self) -> bool:
        """Report and repair an error after an object; return whether the objects before it are valid."""
        token, before = self._cursor.peek, self._cursor.before
        if token.is_mark(")"):
            while self._cursor.peek.is_mark(")"):
                self._cursor.report(self._cursor.take(), SyntaxMessage("this `)` closes nothing", "delete it"))
        elif before.kind == "number" and token.is_unit:
            self._cursor.report(self._cursor.take(), messages.explain_unit(before, token))
        elif self._is_surplus():
            self._cursor.report(token, messages.explain_surplus(self._cursor.take(), before))
            self._naming.doubt(token)
            self._cursor.insert(";")
        else:
            mark = self._missing()
            self._cursor.put(mark)
            return mark != ","
        return self._cursor.peek.is_mark(";.],") or self._mended()

    def _is_surplus(self) -> bool:
        """Whether there is a term in the place of the `;` before another pair on the same line."""
        cursor = self._cursor
        return cursor.terms_ahead(most=3) == 3 and not cursor.at_new_line and not cursor.at_typed_thing

    def _missing(self) -> str:
        """Return the mark that is missing here, guessed from the number of terms before the next mark."""
        if self._cursor.at_end or self._cursor.at_directive:
            return "]" if self._depth else "."
        count = self._cursor.terms_ahead(most=3)
        if count == 3 and not self._depth:
            return "."
        return ";" if count >= 2 else ","

    def _leave_out(self, count: int) -> None:
        """Skip a broken pair and discard its statements, from index `count` on; all that it names becomes doubtful."""
        for statement in self._statements[count:]:
            nodes = (statement.subject, statement.object)
            self._naming.doubtful.update(node.value for node in nodes if isinstance(node, ox.NamedNode))
        del self._statements[count:]
        depth = 0
        while not self._cursor.peek.is_mark(".") and not self._cursor.at_end:
            if not depth and self._cursor.peek.is_mark(";]"):
                return
            if self._at_next_statement():
                self._cursor.insert(".")
                return
            token = self._cursor.take()
            depth += token.is_mark("[(") - (depth > 0 and token.is_mark("])"))
            self._naming.doubt(token)

    def _term(self, predicate: Token | None = None) -> ParsedTerm:
        token = self._cursor.take()
        return (self._nested(token), extent(token)) if token.is_mark("[(") else self._naming.term(token, predicate)

    def _nested(self, bracket: Token) -> Node | None:
        """Parse the content of brackets; None if they are nested too deeply."""
        if self._depth >= DEEPEST:
            message = SyntaxMessage("brackets are nested too deeply", "give the things in them names")
            self._cursor.report(bracket, message)
            return None
        self._depth += 1
        node = self._things(bracket) if bracket.text == "[" else self._list(bracket)
        self._depth -= 1
        return node

    def _things(self, bracket: Token) -> ox.BlankNode:
        node = ox.BlankNode()
        if not self._cursor.peek.is_mark("]"):
            self._pairs(node, extent(bracket))
        self._close(bracket, "]")
        return node

    def _list(self, bracket: Token) -> Node:
        members: list[tuple[Node, Extent]] = []
        while self._cursor.peek.begins_term:
            member, at = self._term()
            if member is not None:
                members.append((member, at))
        self._close(bracket, ")")
        opened, lines = extent(bracket), self._cursor.lines
        rest: Node = make_node(NIL)
        for member, at in reversed(members):
            cell = ox.BlankNode()
            self._statements.append(Statement(cell, FIRST, member, opened, opened, at, lines))
            self._statements.append(Statement(cell, REST, rest, opened, opened, opened, lines))
            rest = cell
        return rest

    def _close(self, bracket: Token, mark: str) -> None:
        if not self._cursor.take_mark(mark):
            self._cursor.report(bracket, SyntaxMessage(f"the `{bracket.text}` that begins here has no `{mark}`"))
