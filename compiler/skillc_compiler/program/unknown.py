"""Names that could not be resolved, as data: the diagnostics are made later, one for each missing declaration."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from math import inf
from typing import Literal, TypeAlias

import msgspec
from msgspec import structs

from skillc_compiler.program.spans import DisjointSpans
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Label
from skillc_dsl.source import Span
from skillc_dsl.spelling import alike_names, close_names, did_you_mean

UnknownKind: TypeAlias = Literal[
    "class", "relation", "property", "type", "prefix", "individual", "value",
    "function", "skill", "implementation", "parameter", "argument", "outcome",
]  # fmt: skip
MOST_COMPARED = 50_000
"""So many candidates are compared with the unknown names of a library; the later ones of a flood have no suggestion."""
LIBRARY = ""
"""The owner of names that a library declares outside of skills."""


class HeaderLine(msgspec.Struct, frozen=True):
    """A line that is missing at the top of a file: `use NAME`, `import "NAME"`, `prefix NAME` (with the IRI)."""

    keyword: str
    name: str


class UnknownName(msgspec.Struct, frozen=True, dict=True):
    """A name without a declaration, and the kind of what it should be the name of.

    `candidates` could stand in its place; `otherwise` is the help if none is close. `owner` is the skill or `task NAME`
    that should declare it, LIBRARY, or None if there is nothing to declare. `line` is what its file lacks, if that is
    known. `passed` if it is the name of an argument, `repeats` if it may be meant where another name is declared a
    second time.
    """

    kind: UnknownKind
    written: s.Name
    message: str
    candidates: tuple[str, ...] = ()
    otherwise: str = ""
    labels: tuple[Label, ...] = ()
    owner: str | None = None
    line: HeaderLine | None = None
    passed: bool = False
    repeats: bool = False

    @property
    def diagnostic(self) -> str:
        """The name of the problem."""
        return f"unknown-{self.kind}"

    @cached_property
    def close(self) -> tuple[str, ...]:
        """The candidates that are probably meant, the closest first."""
        return () if self.line else close_names(self.written.text, self.candidates)

    @cached_property
    def is_misspelt(self) -> bool:
        """Whether a candidate is spelt almost like it, so that nothing else has to be missing."""
        return bool(not self.line and alike_names(self.written.text, self.candidates))

    @cached_property
    def help(self) -> str:
        """What to write instead."""
        if self.line or (self.kind == "prefix" and not self.close):  # authors choose prefixes: others are no help
            return self.otherwise
        return did_you_mean(self.written.text, self.candidates) or self.otherwise


def limit_candidates(names: Iterable[UnknownName]) -> Iterator[UnknownName]:
    """Yield the names; once MOST_COMPARED candidates have been given to different names, others have none."""
    left, given = MOST_COMPARED, set[tuple[str | None, str, str]]()
    for each in names:
        key = each.owner, each.kind, each.written.text
        if key not in given and left >= len(each.candidates):
            left -= len(each.candidates)
            given.add(key)
        yield each if key in given else structs.replace(each, candidates=())


class LostNames(msgspec.Struct, frozen=True):
    """What other errors may have removed: names by skill and of the library, and lines from the headers of files.

    `declarations` are the files of which whole declarations may be missing; `twice` are the names that are declared
    more than once. `nameless` has the keywords of declarations of the library that may have another name, empty where
    the keyword may be another one, too.
    """

    names: Mapping[str, frozenset[str]] = msgspec.field(default_factory=dict)
    headers: frozenset[str] = frozenset()
    declarations: frozenset[str] = frozenset()
    twice: frozenset[str] = frozenset()
    nameless: tuple[str, ...] = ()

    def explains(self, unknown: UnknownName) -> bool:
        """Whether errors have removed a name, or may have removed the line that makes it visible."""
        if unknown.owner is None:
            return False
        if (unknown.passed and unknown.owner in self.twice) or (unknown.repeats and not unknown.close):
            return True
        text = unknown.written.text.rpartition(":")[2]
        lost = (self.names.get(owner, frozenset()) for owner in (unknown.owner, LIBRARY))
        if any(text in names or unknown.written.text in names for names in lost):
            return True
        if self.may_be_renamed(unknown) or unknown.is_misspelt:
            return False
        if unknown.owner != LIBRARY:
            return unknown.owner in self.names
        return unknown.written.span.path in self.headers

    def may_be_renamed(self, unknown: UnknownName) -> bool:
        """Whether one of the `nameless` declarations, or of those that are there `twice`, may be that of a name."""
        if unknown.is_misspelt or unknown.kind == "value":
            return False
        if unknown.owner != LIBRARY:
            return unknown.kind == "implementation" and bool(self.declarations)
        path = unknown.written.span.path
        is_lost = unknown.line is None or path in self.declarations
        return path not in self.headers and is_lost and bool(self.declarations or self.twice)


def find_lost(files: Sequence[s.File]) -> LostNames:
    """Return what syntax errors of the files may have removed, and the implementations of skills that do not exist.

    A task with a syntax error may be meant as a skill.
    """
    names: dict[str, set[str]] = defaultdict(set)
    declarations = [declaration for file in files for declaration in file.declarations]
    skills = {each.name.text for each in declarations if isinstance(each, s.SkillDeclaration)}
    ways = (each for each in declarations if isinstance(each, s.ImplementationDeclaration))
    names[LIBRARY] |= {each.name.text for each in ways if each.skill.text not in skills}
    headers: set[str] = set()
    outside: set[str] = set()
    broken: set[str] = set()
    wrong, dropped = 0, list[str]()
    for file in files:
        spans = DisjointSpans(each.span for each in file.declarations)
        owners: dict[Span | None, s.Declaration] = {each.span: each for each in file.declarations}
        header = _header_lines(file)
        for error in file.errors:
            owner = owners.get(spans.first_on_line_of(error.span))
            match owner:
                case s.SkillDeclaration(name=name) | s.ImplementationDeclaration(skill=name):
                    names[name.text] |= error.names
                case s.TaskDeclaration(name=name):
                    names[f"task {name.text}"] |= error.names
                    broken.add(name.text)
                case None if error.span.line in header:
                    headers.add(file.path)
                case _:
                    pass
            if owner is None:
                outside.add(file.path)
                wrong += error.keyword is None
                dropped += () if error.keyword is None else (error.keyword,)
                names[LIBRARY] |= error.names
    names[LIBRARY] = (names[LIBRARY] - skills) | broken
    return LostNames(
        {owner: frozenset(found) for owner, found in names.items()},
        frozenset(headers),
        frozenset(outside),
        nameless=(*dropped, *([""] * (wrong - len(dropped)))),  # each drop has a syntax error beside it
    )


def _header_lines(file: s.File) -> set[int]:
    """Return the lines with errors above all declarations, except those of declarations that were dropped."""
    first = min((each.span.line for each in file.declarations), default=inf)
    dropped = {each.span.line for each in file.errors if each.keyword}
    return {each.span.line for each in file.errors if each.span.line < first} - dropped
