"""Converts scenes in other formats to Turtle, and leads what is reported about them back to their subjects."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import replace

import msgspec
import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source, Span
from skillc_rdf.formats.read import Content
from skillc_rdf.formats.subjects import SubjectFinder
from skillc_rdf.turtle.lines import Lines
from skillc_rdf.turtle.statements import Parsed, Statement

_PREFIX = re.compile(r"[A-Za-z](?:[\w.-]*[\w-])?", re.ASCII)


class Origin(msgspec.Struct, frozen=True):
    """The text that a document was converted from, its prefixes, and the subject of each line of the document."""

    source: Source
    prefixes: tuple[tuple[str, str], ...]
    subjects: tuple[str, ...]


def convert(source: Source, content: Content) -> tuple[str, Origin]:
    """Return the content of a text as Turtle, a statement a line, and where it comes from."""
    named = {name: iri for name, iri in content.prefixes.items() if _PREFIX.fullmatch(name)}
    head = [f"@prefix {name}: {ox.NamedNode(iri)} .\n" for name, iri in sorted(named.items())]
    triples = _with_numbered_nodes(content.triples)
    body = ox.serialize(triples, format=ox.RdfFormat.N_TRIPLES)
    assert body is not None
    named_subjects = (each.subject.value if isinstance(each.subject, ox.NamedNode) else "" for each in triples)
    subjects = (*("" for _ in head), *named_subjects)
    return "".join(head) + body.decode(), Origin(source, tuple(content.prefixes.items()), subjects)


class SubjectLines(Lines):
    """Converts offsets in a converted text to the span of the subject in the original one; its start if unknown."""

    def __init__(self, text: str, origin: Origin, base: str) -> None:
        super().__init__(origin.source.path, text)
        self._subjects = origin.subjects
        self._finder = SubjectFinder(origin.source, dict(origin.prefixes), base)
        self._found: dict[str, Span] = {"": Span(self.path, 1, 1, 1, 1)}
        self._at: dict[Span, list[str]] = {self._found[""]: [""]}

    def place(self, start: int, end: int) -> Span:
        """Return the span of the subject of the line at an offset."""
        return self.span(self.line(start))

    def span(self, line: int) -> Span:
        """Return the span of the subject of a line of the converted text."""
        subject = self._subjects[line - 1] if line <= len(self._subjects) else ""
        if subject not in self._found:
            self._found[subject] = self._finder.find(subject) or self._found[""]
            self._at.setdefault(self._found[subject], []).append(subject)
        return self._found[subject]

    def subject(self, span: Span) -> str:
        """Return the subject at a span that this object has given, empty if it is not known."""
        found = self._at.get(span, [])
        return found[0] if len(found) == 1 else ""


def lead_back(parsed: Parsed, text: str, origin: Origin, base: str) -> Parsed:
    """Return the statements of a converted text with the spans of their subjects in the original one."""
    lines = SubjectLines(text, origin, base)
    statements = tuple(each._replace(lines=lines) for each in parsed.statements)
    problems = tuple(replace(each, span=lines.span(each.span.line), fix=None) for each in parsed.problems)
    return Parsed(statements, parsed.prefixes, problems, parsed.doubtful)


def name_subjects(
    problems: Iterable[Diagnostic], said: Iterable[Statement], short: Callable[[str], str]
) -> list[Diagnostic]:
    """Return problems without fixes for converted texts; they name their subject, since they have no better place."""
    converted = {each.lines.path: each.lines for each in said if isinstance(each.lines, SubjectLines)}
    found = []
    for each in problems:
        lines = converted.get(each.span.path)
        subject = short(lines.subject(each.span)) if lines else ""
        message = f"{subject}: {each.message}" if subject and subject not in each.message else each.message
        found.append(replace(each, message=message, fix=None) if lines else each)
    return found


def _with_numbered_nodes(triples: Iterable[ox.Triple]) -> list[ox.Triple]:
    """Return triples whose blank nodes are numbered in order, so that the same text gives the same document."""
    numbers: dict[object, ox.BlankNode] = {}

    def numbered(node: object) -> object:
        return numbers.setdefault(node, ox.BlankNode(f"b{len(numbers)}")) if isinstance(node, ox.BlankNode) else node

    return [ox.Triple(numbered(s), p, numbered(o)) for s, p, o in triples]  # type: ignore[arg-type]
