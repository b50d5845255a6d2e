"""Writes what was learned into the texts of implementations, as refinements with their evidence in comments."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from skillc.errors import RequestError, ServiceError
from skillc.services.check.fixing import FileChange
from skillc.services.learning.parameters import Learnable, read_learnable_sources
from skillc.services.library.files import SHIPPED, LibraryFiles
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source
from skillc_dsl.syntax.declarations import ImplementationDeclaration
from skillc_dsl.syntax.members import Refinement
from skillc_model.skills import SkillLibrary
from skillc_runtime.evaluation.trials.settings import Setting, apply_settings

MARK = "# Learned "
"""How the first line of the evidence begins; the comment lines below it belong to it."""
_HEAD = re.compile(r"\{\s*(#.*)?$")


@dataclass(frozen=True, slots=True)
class LearnedValue:
    """A value of a parameter, in the unit of its author."""

    of: Learnable
    value: float

    @property
    def text(self) -> str:
        """The value as it is written."""
        return self.of.write(self.value)

    @property
    def setting(self) -> Setting:
        """The setting that was tried."""
        return self.of.set_to(self.value)


def change_texts(
    files: LibraryFiles, library: SkillLibrary, learned: Sequence[LearnedValue], evidence: Sequence[str]
) -> tuple[FileChange, ...]:
    """Return the changes of files with which a library has learned values; nothing is written.

    `evidence` are lines for the comment above the values. The changed library is compiled: ServiceError if it has an
    error, or if a value in it is not the one that was tried.
    """
    sources = read_learnable_sources(files)
    changed: dict[str, str] = {}
    for path, values in groupby(sorted(learned, key=lambda each: each.of.path), key=lambda each: each.of.path):
        text = sources[path].text
        for name, own in groupby(values, key=lambda each: each.of.implementation):
            text = _refine(sources[path]._replace(text=text), name, list(own), evidence)
        changed[path] = _keep_formatted(sources[path], text)
    _check(files, library, changed, [each.setting for each in learned])
    return tuple(
        FileChange(files.places[path], files.display_path(path), sources[path].text, text)
        for path, text in changed.items()
        if text != sources[path].text
    )


def require_own(changes: Sequence[FileChange]) -> None:
    """Raise RequestError if a change is one of a shipped library."""
    for each in changes:
        if each.path.resolve().is_relative_to(SHIPPED):
            raise RequestError(
                f"{each.shown} is shipped with skillc and cannot be changed; copy the library of the task"
            )


def _refine(source: Source, implementation: str, values: Sequence[LearnedValue], evidence: Sequence[str]) -> str:
    """Return the text of a file with refinements in an implementation: below those that are there, or on top."""
    declared = _find(source, implementation)
    lines = source.text.split("\n")
    refined = {each.name.text: each for each in declared.members if isinstance(each, Refinement)}
    edits: dict[int, list[str]] = {}
    for number in _old_evidence(lines, declared):
        edits[number] = []
    new: list[str] = []
    for each in values:
        if (member := refined.get(each.of.parameter)) is not None:
            edits[member.span.line - 1] = []
            new.append(f"    {_with_default(lines, member, each)}")
        else:
            new.append(f"    refine {each.of.parameter}: {each.of.type} = {each.text}")
    kept = [each for each in refined.values() if each.name.text not in {value.of.parameter for value in values}]
    last = max((each.span.end_line for each in kept), default=_head_line(lines, declared)) - 1
    comment = [f"    {line}" for line in evidence]
    edits[last] = [*edits.get(last, [lines[last]]), *comment, *new]
    return "\n".join(part for number, line in enumerate(lines) for part in edits.get(number, [line]))


def _find(source: Source, implementation: str) -> ImplementationDeclaration:
    skill, _, name = implementation.partition(".")
    for declared in parse(source).value.declarations:
        if isinstance(declared, ImplementationDeclaration) and (declared.skill.text, declared.name.text) == (
            skill,
            name,
        ):
            return declared
    raise ServiceError(f"the implementation `{name}` of `{skill}` is not in {source.path} any more")


def _head_line(lines: Sequence[str], declared: ImplementationDeclaration) -> int:
    """Return the number of the line with the opening brace. ServiceError if members stand in the same line."""
    number = declared.span.line
    while not _HEAD.search(lines[number - 1]):
        if number >= declared.span.end_line:
            raise ServiceError(f"line {declared.span.line}: format the file first, with `skillc fmt`")
        number += 1
    return number


def _old_evidence(lines: Sequence[str], declared: ImplementationDeclaration) -> Iterator[int]:
    """Yield the indices of the lines of evidence of what was learned before."""
    inside = False
    for number in range(declared.span.line, declared.span.end_line):
        text = lines[number].strip()
        inside = text.startswith(MARK) or (inside and text.startswith("# "))
        if inside:
            yield number


def _with_default(lines: Sequence[str], member: Refinement, learned: LearnedValue) -> str:
    """Return a refinement in one line, with another default."""
    if member.span.end_line != member.span.line:
        raise ServiceError(f"line {member.span.line}: format the file first, with `skillc fmt`")
    line = lines[member.span.line - 1]
    after = member.type.span.end_column - 1
    rest = "" if member.range is None else line[member.range.span.column - 1 : member.range.span.end_column - 1]
    if rest and not rest.startswith("range"):
        rest = f"range {rest}"
    return f"{line[member.span.column - 1 : after]} = {learned.text}  {rest}".rstrip()


def _keep_formatted(before: Source, text: str) -> str:
    """Return a changed text, formatted if it was so before."""
    if format_source(before).value != before.text:
        return text
    return format_source(before._replace(text=text)).value


def _check(files: LibraryFiles, library: SkillLibrary, changed: Mapping[str, str], settings: Sequence[Setting]) -> None:
    """Compile the changed library, and compare it with the one that was tried."""
    from skillc.services.library.libraries import compile_library

    def replace(source: Source) -> Source:
        return source._replace(text=changed.get(source.path, source.text))

    after = files._replace(
        sources=tuple(map(replace, files.sources)),
        importable={name: replace(source) for name, source in files.importable.items()},
    )
    outcome = compile_library(after)
    if not outcome.ok:
        problem = next(each for each in outcome.diagnostics if each.severity == "error")
        raise ServiceError(f"what was learned cannot be written: {problem.span.path}: {problem.message}")
    tried = apply_settings(library, settings)
    for setting in settings:
        wanted, found = (
            next(
                each.default
                for each in of.implementations[setting.implementation].parameters
                if each.name == setting.parameter
            )
            for of in (tried, outcome.value)
        )
        if wanted != found:
            raise ServiceError(
                f"`{setting.parameter}` of {setting.implementation} would be {found}, tried was {wanted}"
            )
