"""Duplicate declarations of a library."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, TypeAlias

from msgspec import structs

from skillc_compiler.program.program import ParsedFile
from skillc_compiler.program.spans import SpanIndex
from skillc_compiler.resolve.declaring.declarations import FileDeclarations
from skillc_compiler.resolve.names import KINDS
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span

_Problem: TypeAlias = tuple[str, str, Diagnostic]
"""The kind and the name of a declaration, and what is wrong with it."""


class UniqueDeclarations(NamedTuple):
    """The files with the first skill, implementation and task of each name, and the problems with the others.

    `twice` are the names of the terms, functions and skills with a problem: it is not clear which of the two is meant.
    """

    files: tuple[ParsedFile, ...]
    diagnostics: tuple[Diagnostic, ...]
    twice: frozenset[str]


def remove_duplicates(files: Sequence[ParsedFile], declared: Mapping[str, FileDeclarations]) -> UniqueDeclarations:
    """Keep the first skill, implementation and task of each name; report the others.

    Nothing is reported of a declaration with a syntax error, as a line that was typed twice may be all there is of it.
    Implementations that follow a second skill of a name in its file were written for it, so they are removed with it.
    Second declarations of terms and functions stay, as they add to the first.
    """
    first: dict[tuple[str, ...], Span] = {}
    problems: list[_Problem] = []
    broken = {name for unit in files for name in _incomplete(unit.file)}
    kept = []
    for unit in files:
        declarations = tuple(_first_declarations(unit.file, declared[unit.file.path], first, problems))
        kept.append(structs.replace(unit, file=structs.replace(unit.file, declarations=declarations)))
    found = (problem for _, _, problem in problems)
    whole = (each for each in found if broken.isdisjoint({each.span, *(label.span for label in each.labels)}))
    twice = frozenset(name for kind, name, _ in problems if kind not in ("implementation", "task"))
    return UniqueDeclarations(tuple(kept), tuple(whole), twice)


def _incomplete(file: s.File) -> Iterator[Span]:
    """Yield the names of the declarations with a syntax error."""
    errors = SpanIndex(error.span for error in file.errors)
    for declaration in file.declarations:
        if errors.any_on_lines_of(declaration.span):
            yield declaration.name.span


def _first_declarations(
    file: s.File, declared: FileDeclarations, first: dict[tuple[str, ...], Span], problems: list[_Problem]
) -> Iterator[s.Declaration]:
    """Yield the declarations that stay; the place of each is added to `first`."""
    second_skills: set[str] = set()
    for declaration in file.declarations:
        if isinstance(declaration, s.ImplementationDeclaration) and declaration.skill.text in second_skills:
            continue
        key, name = _identity(declaration, declared), declaration.name
        problems += ((key[0], name.text, problem) for problem in _other_kinds(key, name, first))
        if first.setdefault(key, name.span) == name.span:
            yield declaration
            continue
        problems.append((key[0], name.text, _problem(key[0], name, first[key])))
        match declaration:
            case s.SkillDeclaration():
                second_skills.add(name.text)
            case s.ImplementationDeclaration() | s.TaskDeclaration():
                pass
            case _:
                yield declaration


def _other_kinds(key: tuple[str, ...], name: s.Name, first: dict[tuple[str, ...], Span]) -> Iterator[Diagnostic]:
    """Yield a problem if a term has the name of a term of another kind."""
    kind, iri = key[0], key[1]
    if kind not in KINDS:
        return
    first.setdefault(("term", kind, iri), name.span)
    for other in KINDS:
        former = first.get(("term", other, iri))
        if other != kind and former is not None:
            message = f"`{name.text}` is already a {other}, so it cannot be a {kind}"
            labels = (Label(former, "first declared here"),)
            yield Diagnostic("duplicate-declaration", name.span, message, "choose another name", labels=labels)


def _problem(kind: str, name: s.Name, first: Span) -> Diagnostic:
    return Diagnostic(
        "duplicate-declaration",
        name.span,
        f"the {kind} `{name.text}` is declared twice",
        help="give one of them another name, or remove one",
        labels=(Label(first, "first declared here"),),
    )


def _identity(declaration: s.Declaration, declared: FileDeclarations) -> tuple[str, ...]:
    name = declaration.name.text
    match declaration:
        case s.ClassDeclaration():
            return ("class", declared.terms["class"][name])
        case s.RelationDeclaration(domain=domain, range=range_):
            return ("relation", declared.terms["relation"][name], domain.text, range_.text)
        case s.PropertyDeclaration(domain=domain):
            kind = "property" if name in declared.terms["property"] else "relation"
            return (kind, declared.terms[kind][name], domain.text)  # type: ignore[index]
        case s.FunctionDeclaration():
            return ("function", name)
        case s.SkillDeclaration():
            return ("skill", name)
        case s.ImplementationDeclaration(skill=skill):
            return ("implementation", skill.text, name)
        case s.TaskDeclaration():
            return ("task", name)
