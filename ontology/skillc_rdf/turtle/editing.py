"""Adds and removes statements in Turtle texts; the layout and comments around them are not changed."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from typing import TypeAlias

import pyoxigraph as ox

from skillc_rdf.turtle.parser import parse
from skillc_rdf.turtle.statements import Node, Statement
from skillc_rdf.turtle.terms import RDF_TYPE, XSD
from skillc_rdf.turtle.tokens import Token, tokens

Names: TypeAlias = Callable[[str], str]
"""Maps an IRI that is an alias to the term that it stands for; other IRIs to themselves."""
INDENT = "    "
_LOCAL = re.compile(r"[A-Za-z_](?:[\w-]*[\w])?")
_PLAIN = re.compile(r"[+-]?\d+|[+-]?\d*\.\d+|[+-]?(?:\d+(?:\.\d*)?|\.\d+)[eE][+-]?\d+|true|false")


class StatementNotFound(ValueError):
    """The statement to remove is not in the text."""


class Editor:
    """A Turtle text without errors that is edited statement by statement."""

    def __init__(self, text: str, base: str, named: Names) -> None:
        self.text = text
        self._base = base
        self._named = named

    def add(self, subject: str, predicate: str, object_: Node) -> None:
        """Add a statement next to the others about its subject; do nothing if it is in the text."""
        said = self._said(subject)
        alike = [each for each in said if self._named(each.predicate) == predicate]
        if any(self._same(each.object, object_) for each in alike):
            return
        written = self.format_node(object_)
        if alike:
            end = self._end(alike[-1])
            self._put(end, end, f", {written}")
        elif said:
            self._put_beside(max(said, key=lambda each: each.object_at), f"{self._predicate(predicate)} {written}")
        else:
            before = "" if not self.text or self.text.endswith("\n") else "\n"
            sentence = f"{self.format_node(ox.NamedNode(subject))} {self._predicate(predicate)} {written} ."
            self.text += f"{before}\n{sentence}\n"

    def set(self, subject: str, predicate: str, object_: Node) -> None:
        """Set the only object of a subject and predicate."""
        alike = self._alike(subject, predicate)
        if not alike:
            self.add(subject, predicate, object_)
            return
        for each in reversed(alike[1:]):
            self._cut(each)
        self._put(alike[0].object_at.start, self._end(alike[0]), self.format_node(object_))

    def remove(self, subject: str, predicate: str, object_: Node) -> None:
        """Remove a statement; StatementNotFound if it is not in the text."""
        alike = self._alike(subject, predicate)
        found = [each for each in alike if self._same(each.object, object_)]
        if not found:
            raise StatementNotFound
        for each in reversed(found):
            self._cut(each)

    def forget(self, individual: str) -> None:
        """Remove all statements with an individual as subject or object; StatementNotFound if there are none."""
        if not self._about(individual):
            raise StatementNotFound
        while found := self._about(individual):
            self._cut(found[-1])

    def replace(
        self, subject: str, former: Collection[str], pairs: Mapping[str, Node], beside: Collection[str]
    ) -> None:
        """Replace the statements of a subject with the `former` predicates by others, each with one object.

        A predicate that stays keeps its place; new ones follow the last statement with a predicate of `beside`, on the
        same line.
        """
        for predicate in pairs:
            if self._alike(subject, predicate):
                self.set(subject, predicate, pairs[predicate])
        new = " ; ".join(self.format_pair(*each) for each in pairs.items() if not self._alike(subject, each[0]))
        places = [each for each in self._said(subject) if self._named(each.predicate) in beside]
        if new and places:
            end = self._end(max(places, key=lambda each: each.object_at))
            self._put(end, end, f" ; {new}")
        elif new:
            self._put_beside(max(self._said(subject), key=lambda each: each.object_at), new)
        for predicate in set(former) - pairs.keys():
            while found := self._alike(subject, predicate):
                self._cut(found[-1])

    def format_pair(self, predicate: str, object_: Node) -> str:
        """Return a predicate and its object as Turtle, with the prefixes of the text."""
        return f"{self._predicate(predicate)} {self.format_node(object_)}"

    def _alike(self, subject: str, predicate: str) -> list[Statement]:
        return [each for each in self._said(subject) if self._named(each.predicate) == predicate]

    def _about(self, individual: str) -> list[Statement]:
        node = ox.NamedNode(individual)
        ends = (each for each in self._statements() if isinstance(each.subject, ox.NamedNode))
        return [each for each in ends if node in (each.subject, each.object)]

    def _said(self, subject: str) -> list[Statement]:
        return [each for each in self._statements() if each.subject == ox.NamedNode(subject)]

    def _statements(self) -> tuple[Statement, ...]:
        return parse("", self.text, self._base).statements

    def _same(self, one: Node, other: Node) -> bool:
        if isinstance(one, ox.NamedNode) and isinstance(other, ox.NamedNode):
            return self._named(one.value) == self._named(other.value)
        if isinstance(one, ox.Literal) and isinstance(other, ox.Literal) and one.value != other.value:
            return _number(one) is not None and _number(one) == _number(other)
        return one == other or (isinstance(one, ox.Literal) and isinstance(other, ox.Literal))

    def format_node(self, node: Node) -> str:
        """Return a term as Turtle, with the prefixes of the text."""
        match node:
            case ox.NamedNode(value=iri):
                return self._shortened(iri)
            case ox.Literal(value=text, datatype=datatype) if datatype.value.startswith(XSD) and _PLAIN.fullmatch(text):
                return text if self._reads_as(text, datatype.value) else str(node)
            case _:
                return str(node)

    def _reads_as(self, text: str, datatype: str) -> bool:
        """Whether a literal of this datatype can be written without quotes."""
        kind = "integer" if re.fullmatch(r"[+-]?\d+", text) else "decimal"
        kind = "double" if "e" in text.lower() and text not in ("true", "false") else kind
        return datatype == XSD + ("boolean" if text in ("true", "false") else kind)

    def _predicate(self, iri: str) -> str:
        return "a" if iri == RDF_TYPE else self._shortened(iri)

    def _shortened(self, iri: str) -> str:
        prefixes: Mapping[str, str] = parse("", self.text, self._base).prefixes
        for prefix, base in sorted(prefixes.items()):
            if base and iri.startswith(base) and _LOCAL.fullmatch(iri[len(base) :]):
                return f"{prefix}:{iri[len(base) :]}"
        return f"<{iri}>"

    def _put_beside(self, last: Statement, pair: str) -> None:
        """Insert a predicate with its object before the last pair of a subject, so that its trailing comment stays."""
        if last.predicate == RDF_TYPE:
            end = self._end(last)
            self._put(end, end, f" ;\n{INDENT}{pair}")
        else:
            start = last.predicate_at.start
            self._put(start, start, f"{pair} ;\n{INDENT}")

    def _end(self, statement: Statement) -> int:
        """Return the offset where an object ends, brackets included."""
        depth = 0
        for token in tokens(self.text):
            if token.start < statement.object_at.start:
                continue
            depth += token.is_mark("[(") - token.is_mark("])")
            if depth == 0:
                return max(token.end, statement.object_at.end)
        return len(self.text)

    def _cut(self, statement: Statement) -> None:
        """Remove an object; also its predicate if it has no other object, and the subject if nothing is left."""
        marks = list(tokens(self.text))
        starts = {token.start: number for number, token in enumerate(marks)}
        first, end = starts[statement.object_at.start], self._end(statement)
        behind = next(number for number, token in enumerate(marks) if token.start >= end)
        before, after = marks[first - 1], marks[behind]
        if after.is_mark(","):
            self._take(statement.object_at.start, marks[behind + 1].start)
        elif before.is_mark(","):
            self._take(before.start, end)
        else:
            self._cut_pair(statement, end, marks[first - 2], after, marks[behind + 1])

    def _cut_pair(self, statement: Statement, end: int, before: Token, after: Token, next_: Token) -> None:
        if after.is_mark(";"):
            more = not next_.is_mark(".;")
            self._take(statement.predicate_at.start, next_.start if more else after.end)
        elif before.is_mark(";"):
            self._take(len(self.text[: before.start].rstrip(" ")), end)
        else:
            self._take(statement.subject_at.start, after.end)

    def _take(self, start: int, end: int) -> None:
        """Remove a range of text, and its lines if nothing else is on them."""
        line = self.text.rfind("\n", 0, start) + 1
        rest = self.text.find("\n", end)
        rest = len(self.text) if rest < 0 else rest + 1
        if not self.text[line:start].strip() and not self.text[end:rest].strip():
            start, end = line, rest
        self._put(start, end, "")

    def _put(self, start: int, end: int, text: str) -> None:
        self.text = self.text[:start] + text + self.text[end:]


def _number(literal: ox.Literal) -> float | None:
    try:
        return float(literal.value)
    except ValueError:
        return None
