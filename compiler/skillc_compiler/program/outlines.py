"""What other files can read of a file: its lines outside of bodies, and which skills the bodies call."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Iterator, Sequence

import msgspec

from skillc_compiler.program.program import ParsedFile
from skillc_compiler.program.written import calls_of, skill_of
from skillc_dsl import syntax as s
from skillc_dsl.source import Span

TASK = ""
"""What stands for a task in the place of a skill."""
_SUPPRESSION = re.compile(r"#\s*allow\b")


class DeclarationOutline(msgspec.Struct, frozen=True):
    """The outline of a description of `skill`, of its implementation called `name`, or of a TASK.

    `first` and `last` are the numbers of its lines, `named_at` is the line and column of its name. `signature` is the
    digest of its text outside of bodies, `body` that of the bodies, both with their places; the file has the signatures
    of tasks. `selected` are the calls of one implementation, `Skill[name]`.
    """

    skill: str
    name: str
    first: int
    last: int
    named_at: tuple[int, int]
    signature: str
    calls: frozenset[str]
    selected: frozenset[tuple[str, str]]
    body: str

    @property
    def described(self) -> tuple[object, ...]:
        """All that is known of it but its bodies."""
        return self.first, self.last, self.named_at, self.signature


class FileOutline(msgspec.Struct, frozen=True):
    """The outline of a file; `digest` is that of its lines outside of skills, implementations and bodies.

    `imports` are paths; `adds_terms` if it changes what names mean in all files.
    """

    digest: str
    declared: tuple[DeclarationOutline, ...]
    imports: tuple[str, ...]
    adds_terms: bool

    @property
    def shown(self) -> tuple[object, ...]:
        """All that other files can read without reading a skill or an implementation that it names or may run."""
        return self.digest, tuple((each.skill, each.name, each.calls, each.selected) for each in self.declared)

    @property
    def named(self) -> Iterator[str]:
        """The skills that the file describes, implements or calls."""
        for each in self.declared:
            yield from each.calls if each.skill == TASK else (each.skill, *each.calls)


def outline_of(unit: ParsedFile) -> FileOutline:
    """Return the outline of a file."""
    file, lines = unit.file, unit.text.split("\n")
    terms = s.ClassDeclaration | s.RelationDeclaration | s.PropertyDeclaration
    spans = {each.name.span: _with_doc(each.span, lines) for each in file.declarations if skill_of(each)}
    apart = (span for each in file.declarations for span in _apart(each, spans))
    suppressions = (f"{number} {line}" for number, line in enumerate(lines, 1) if _SUPPRESSION.search(line))
    return FileOutline(
        digest=_digest((*_outside(lines, Span("", 1, 1, len(lines), len(lines[-1]) + 1), apart), *suppressions)),
        declared=tuple(
            _declared(each, spans.get(each.name.span), lines)
            for each in file.declarations
            if skill_of(each) or isinstance(each, s.TaskDeclaration)
        ),
        imports=tuple(path for _, path in unit.imports),
        adds_terms=any(isinstance(line, s.Prefix) for line in file.header)
        or any(isinstance(each, terms) for each in file.declarations),
    )


def _with_doc(span: Span, lines: Sequence[str]) -> Span:
    """Return the span of a declaration with the lines above that document it."""
    first = span.line
    while first > 1 and lines[first - 2].startswith("##"):
        first -= 1
    return span if first == span.line else span._replace(line=first, column=1)


def _apart(declaration: s.Declaration, spans: dict[Span, Span]) -> list[Span]:
    """Return the parts of a declaration that the digest of its file leaves out."""
    span = spans.get(declaration.name.span)
    return [body.span for body in _bodies(declaration)] if span is None else [span]


def _declared(declaration: s.Declaration, span: Span | None, lines: list[str]) -> DeclarationOutline:
    calls, bodies, whole = list(calls_of(declaration)), _bodies(declaration), span or declaration.span
    named = declaration.name.span
    return DeclarationOutline(
        skill=skill_of(declaration),
        name=declaration.name.text if isinstance(declaration, s.ImplementationDeclaration) else "",
        first=whole.line,
        last=whole.end_line,
        named_at=(named.line, named.column),
        signature=_digest(_outside(lines, span, [body.span for body in bodies])) if span else "",
        calls=frozenset(call.skill.text for call in calls),
        selected=frozenset((call.skill.text, call.implementation.text) for call in calls if call.implementation),
        body=_digest(part for body in bodies for part in _inside(lines, body)),
    )


def _bodies(declaration: s.Declaration) -> list[s.Body]:
    match declaration:
        case s.ImplementationDeclaration(members=members):
            return [member for member in members if isinstance(member, s.Body)]
        case s.TaskDeclaration(body=s.Body() as body):
            return [body]
    return []


def _inside(lines: list[str], body: s.Body) -> Iterator[str]:
    """Yield the lines of a body with their numbers; its first and last line are whole lines."""
    yield str(body.span.column)
    for number in range(body.span.line, body.span.end_line + 1):
        yield f"{number} {lines[number - 1]}"


def _outside(lines: list[str], whole: Span, parts: Iterable[Span]) -> Iterator[str]:
    """Yield what is in a span but not in parts of it, with its lines.

    Empty lines and comments that document nothing are left out.
    """
    next_line, next_column = whole.line, whole.column
    for part in parts:
        yield from _numbered(lines, next_line, next_column, part.line, part.column)
        next_line, next_column = part.end_line, part.end_column
    yield from _numbered(lines, next_line, next_column, whole.end_line, whole.end_column)


def _numbered(lines: list[str], line: int, column: int, end_line: int, end_column: int) -> Iterator[str]:
    for number in range(line, end_line + 1):
        start = column - 1 if number == line else 0
        part = lines[number - 1][start : end_column - 1 if number == end_line else None].strip()
        if part and (not part.startswith("#") or part.startswith("##")):
            yield f"{number} {part}"


def _digest(parts: Iterable[str]) -> str:
    return hashlib.sha256("\n".join(parts).encode("utf-8", "surrogateescape")).hexdigest()
