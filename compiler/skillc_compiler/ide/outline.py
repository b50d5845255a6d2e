"""The outline of a file, as a tree of declarations, and the ranges that can be folded."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal, TypeAlias, assert_never

import msgspec

from skillc_dsl import syntax as s
from skillc_dsl.comments import find_comments
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.source import Source, Span

EntryKind: TypeAlias = Literal[
    "class",
    "relation",
    "property",
    "function",
    "skill",
    "implementation",
    "task",
    "test",
    "parameter",
    "condition",
    "let",
]


class OutlineEntry(msgspec.Struct, frozen=True):
    """A declaration: its name, detail and kind, its place and that of its name, and nested declarations."""

    name: str
    detail: str
    kind: EntryKind
    span: Span
    name_span: Span
    children: tuple[OutlineEntry, ...] = ()


class Fold(msgspec.Struct, frozen=True):
    """A range of lines that an editor can fold to the first one."""

    first: int
    last: int
    kind: Literal["region", "comment", "imports"] = "region"


def make_outline(file: s.File) -> tuple[OutlineEntry, ...]:
    """Return the outline of a file."""
    return tuple(_entry(declaration) for declaration in file.declarations)


def find_folds(source: Source, file: s.File) -> tuple[Fold, ...]:
    """Return the ranges that can be folded: blocks in braces, consecutive comments, and the header."""
    found = [*_braces(source), *_comments(source)]
    header = [line.span.line for line in file.header]
    if header and header[-1] > header[0]:
        found.append(Fold(header[0], header[-1], "imports"))
    return tuple(sorted(found, key=lambda fold: (fold.first, fold.last)))


def _entry(written: s.Declaration) -> OutlineEntry:
    match written:
        case s.ClassDeclaration(name=name, parents=parents, span=span):
            return OutlineEntry(name.text, _below(parents), "class", span, name.span)
        case s.RelationDeclaration(name=name, domain=domain, range=range_, span=span):
            return OutlineEntry(name.text, f"({domain.text}, {range_.text})", "relation", span, name.span)
        case s.PropertyDeclaration(name=name, domain=domain, span=span):
            return OutlineEntry(name.text, f"({domain.text})", "property", span, name.span)
        case s.FunctionDeclaration(name=name, parameters=parameters, span=span):
            return OutlineEntry(name.text, _head(parameters), "function", span, name.span)
        case s.SkillDeclaration(name=name, members=members, span=span):
            return OutlineEntry(name.text, "", "skill", span, name.span, tuple(_members(members)))
        case s.ImplementationDeclaration(name=name, skill=skill, members=members, span=span):
            return OutlineEntry(
                name.text, f"of {skill.text}", "implementation", span, name.span, tuple(_members(members))
            )
        case s.TaskDeclaration(name=name, parameters=parameters, scene=scene, span=span):
            detail = " ".join(filter(None, (_head(parameters) if parameters else "", scene.value if scene else "")))
            kind: EntryKind = "test" if isinstance(written, s.TestDeclaration) else "task"
            return OutlineEntry(name.text, detail, kind, span, name.span)
        case _:
            assert_never(written)


def _members(members: Iterable[s.SkillMember | s.ImplementationMember]) -> Iterator[OutlineEntry]:
    for member in members:
        match member:
            case s.Parameter(name=name, direction=direction, span=span):
                yield OutlineEntry(name.text, direction, "parameter", span, name.span)
            case s.Refinement(name=name, span=span):
                yield OutlineEntry(name.text, "refine", "parameter", span, name.span)
            case s.Requirement(label=s.Name(text=text, span=place), kind=kind, span=span):
                yield OutlineEntry(text, kind, "condition", span, place)
            case s.Output(name=name, span=span):
                yield OutlineEntry(name.text, "out", "parameter", span, name.span)
            case s.Let(name=name, span=span):
                yield OutlineEntry(name.text, "let", "let", span, name.span)
            case _:
                pass


def _head(parameters: tuple[s.HeadParameter, ...]) -> str:
    return f"({', '.join(parameter.name.text for parameter in parameters)})"


def _below(parents: tuple[s.Name, ...]) -> str:
    return f"< {', '.join(parent.text for parent in parents)}" if parents else ""


def _braces(source: Source) -> Iterator[Fold]:
    opened: list[int] = []
    for token in tokenize(source).value:
        if token.type == "LBRACE":
            opened.append(token.line or 1)
        elif token.type == "RBRACE" and opened:
            first = opened.pop()
            last = (token.line or 1) - 1
            if last > first:
                yield Fold(first, last)


def _comments(source: Source) -> Iterator[Fold]:
    lines = [comment.span.line for comment in find_comments(source) if comment.alone]
    first = 0
    for index, line in enumerate(lines):
        if index + 1 == len(lines) or lines[index + 1] != line + 1:
            if index > first:
                yield Fold(lines[first], line, "comment")
            first = index + 1
