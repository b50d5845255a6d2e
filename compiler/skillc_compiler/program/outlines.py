"""What other files can read of a file: its lines outside of bodies, and which skills the bodies call."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator

import msgspec

from skillc_compiler.program.typed import ParsedFile
from skillc_compiler.program.written import calls_of, skill_of
from skillc_dsl import syntax as s

TASK = ""
"""What stands for a task in the place of a skill."""


class BodyOutline(msgspec.Struct, frozen=True):
    """What an implementation of `skill`, or a TASK, runs.

    `selected` are the calls of one implementation, `Skill[name]`; `body` is the digest of the text with its place.
    """

    skill: str
    calls: frozenset[str]
    selected: frozenset[tuple[str, str]]
    body: str


class FileOutline(msgspec.Struct, frozen=True):
    """The outline of a file; `digest` is that of its lines outside of bodies, with their numbers.

    `described` and `implemented` are skills, `imports` paths; `adds_terms` if it changes what names mean in all files.
    """

    digest: str
    described: frozenset[str]
    implemented: frozenset[str]
    runs: tuple[BodyOutline, ...]
    imports: tuple[str, ...]
    adds_terms: bool
    has_tasks: bool

    @property
    def shown(self) -> tuple[object, ...]:
        """All that other files can read without running a body."""
        return self.digest, tuple((run.skill, run.calls, run.selected) for run in self.runs)


def outline_of(unit: ParsedFile) -> FileOutline:
    """Return the outline of a file."""
    file, lines = unit.file, unit.text.split("\n")
    terms = s.ClassDeclaration | s.RelationDeclaration | s.PropertyDeclaration
    return FileOutline(
        digest=_digest(_outside(lines, [body for each in file.declarations for body in _bodies(each)])),
        described=_skills(file, s.SkillDeclaration),
        implemented=_skills(file, s.ImplementationDeclaration),
        runs=tuple(_run(each, lines) for each in file.declarations if _bodies(each)),
        imports=tuple(path for _, path in unit.imports),
        adds_terms=any(isinstance(line, s.Prefix) for line in file.header)
        or any(isinstance(each, terms) for each in file.declarations),
        has_tasks=any(isinstance(each, s.TaskDeclaration) for each in file.declarations),
    )


def _skills(file: s.File, kind: type[s.Declaration]) -> frozenset[str]:
    return frozenset(skill_of(each) for each in file.declarations if isinstance(each, kind))


def _run(declaration: s.Declaration, lines: list[str]) -> BodyOutline:
    calls = list(calls_of(declaration))
    implementing = isinstance(declaration, s.ImplementationDeclaration)
    return BodyOutline(
        skill=skill_of(declaration) if implementing else TASK,
        calls=frozenset(call.skill.text for call in calls),
        selected=frozenset((call.skill.text, call.implementation.text) for call in calls if call.implementation),
        body=_digest(part for body in _bodies(declaration) for part in _inside(lines, body)),
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


def _outside(lines: list[str], bodies: Iterable[s.Body]) -> Iterator[str]:
    """Yield everything outside of bodies with its line, but neither empty lines nor comments that document nothing."""
    next_line, next_column = 1, 1
    for body in bodies:
        span = body.span
        yield from _numbered(lines, next_line, next_column, span.line, span.column)
        next_line, next_column = span.end_line, span.end_column
    yield from _numbered(lines, next_line, next_column, len(lines), len(lines[-1]) + 1)


def _numbered(lines: list[str], line: int, column: int, end_line: int, end_column: int) -> Iterator[str]:
    for number in range(line, end_line + 1):
        start = column - 1 if number == line else 0
        part = lines[number - 1][start : end_column - 1 if number == end_line else None].strip()
        if part and (not part.startswith("#") or part.startswith("##")):
            yield f"{number} {part}"


def _digest(parts: Iterable[str]) -> str:
    return hashlib.sha256("\n".join(parts).encode("utf-8", "surrogateescape")).hexdigest()
