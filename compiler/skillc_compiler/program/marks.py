"""Which parts of a program are erroneous, so that nothing is said of them that may only follow from another error.

Marks flow over declarations: from a file to the names it lacks, from a skill to its implementations, from both to their
callers and tasks, and from a term of the vocabulary to whatever mentions it.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Mapping
from enum import IntEnum
from functools import cached_property

from skillc_compiler.program.program import Program
from skillc_compiler.program.spans import DisjointSpans, SpanIndex
from skillc_compiler.program.unknown import LIBRARY
from skillc_compiler.program.written import calls_of, names_declared_in, skill_of
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span

_WORD = re.compile(r"[\w-]+")
_TERMS = (s.ClassDeclaration, s.RelationDeclaration, s.PropertyDeclaration, s.FunctionDeclaration)
_TERM_KEYWORDS = frozenset(("class", "enum", "relation", "property", "function"))


class Need(IntEnum):
    """What has to be free of errors for a check to be right, in the order in which checks run.

    TEXT: the syntax of the line. NAMES: the lines that the problem is about, and the declarations of terms in them;
    the declarations there are complete. TYPES: also the types in those lines. DECLARATION: all of the declarations.
    BODY: also the skills that they implement and call. PROGRAM: all skills, and what they achieve.
    """

    TEXT = 0
    NAMES = 1
    TYPES = 2
    DECLARATION = 3
    BODY = 4
    PROGRAM = 5


class Marks:
    """The erroneous parts of a program, given the errors that are known so far."""

    def __init__(self, program: Program, errors: Iterable[Diagnostic]) -> None:
        self._program = program
        self._declarations = [d for unit in program.files for d in unit.file.declarations]
        self._enclosing = DisjointSpans(d.span for d in self._declarations)
        self._syntax = [error.span for unit in program.files for error in unit.file.errors]
        self._places = [*self._syntax, *(unknown.written.span for unknown in program.unknown)]
        self._places += [error.span for error in errors if error.severity == "error"]

    def add(self, errors: Iterable[Diagnostic]) -> None:
        """Mark the places of further errors, and of their confirmed causes; warnings mark nothing."""
        for error in errors:
            if error.severity == "error":
                self._places += (error.span, *(label.span for label in error.labels if label.is_cause))
        for name in ("_index", "_erroneous", "_terms", "_unsound", "_tainted"):
            self.__dict__.pop(name, None)

    def is_erroneous(self, declaration: Span) -> bool:
        """Whether there is an error on the lines of a declaration."""
        return self._index.any_on_lines_of(declaration)

    def blames_broken(self, problem: Diagnostic) -> bool:
        """Whether a problem points to a declaration that has a syntax error, so that part of it may be missing."""
        return any(self._enclosing.enclosing(label.span) in self._broken for label in problem.labels)

    def allow(self, need: Need, problem: Diagnostic) -> bool:
        """Whether a problem is independent of the known errors, if it was found by a check with this need."""
        places = (problem.span, *(label.span for label in problem.labels))
        if any(error.line == problem.span.line and error.path == problem.span.path for error in self._syntax):
            return False
        if not self._places or need == Need.TEXT:
            return True
        if problem.span in self._meant or any(self._is_unclear(place) for place in places):
            return False
        declarations = {self._enclosing.enclosing(place) for place in places}
        match need:
            case Need.DECLARATION:
                return declarations.isdisjoint(self._erroneous)
            case Need.BODY:
                return not any(self._is_tainted(place) for place in places)
            case Need.PROGRAM:
                return self._is_whole
        return True

    def _is_unclear(self, place: Span) -> bool:
        """Whether a place has an error itself, is in an incomplete declaration, or mentions what has an error."""
        if self._index.any_on_lines_of(place) or place.path in self._program.lost.headers:
            return True
        return self._enclosing.enclosing(place) in self._incomplete or self._mentions_terms(place)

    def _is_tainted(self, place: Span) -> bool:
        declaration = self._enclosing.enclosing(place)
        if declaration is None:
            return any(error.path == place.path for error in self._name_errors)
        return declaration in self._tainted

    @cached_property
    def _name_errors(self) -> list[Span]:
        return [*self._syntax, *(unknown.written.span for unknown in self._program.unknown)]

    @cached_property
    def _is_whole(self) -> bool:
        """Whether all skills, their implementations and callers are known, and the terms in their posts."""
        lost, skills = self._program.lost, self._program.skills
        if self._syntax or lost.headers or lost.twice:
            return False
        posts = SpanIndex(each.written.span for each in self._program.unknown)
        described = (r for skill in skills.values() for r in skill.requirements if r.says_what_comes)
        named = {*self._skills.values(), *(name for called in self._calls.values() for name in called)}
        return named <= skills.keys() and not any(posts.any_inside(post.span) for post in described)

    @cached_property
    def _index(self) -> SpanIndex:
        return SpanIndex(self._places)

    @cached_property
    def _broken(self) -> frozenset[Span]:
        """The declarations with a syntax error."""
        errors = SpanIndex(self._syntax)
        return frozenset(d.span for d in self._declarations if errors.any_on_lines_of(d.span))

    @cached_property
    def _incomplete(self) -> frozenset[Span]:
        """The declarations with a syntax error, or of a skill that is declared twice, and their implementations."""
        broken, kind = self._broken, s.SkillDeclaration
        skills = {d.name.text for d in self._declarations if isinstance(d, kind) and d.span in broken}
        skills |= self._program.lost.twice
        of = (d.span for d in self._declarations if skill_of(d) in skills)
        return frozenset({*broken, *of})

    @cached_property
    def _meant(self) -> frozenset[Span]:
        """The declared names that unknown names probably mean, so that they may be used."""
        meant = {name for unknown in self._program.unknown for name in unknown.close}
        names = (name for d in self._declarations for name in names_declared_in(d)) if meant else ()
        return frozenset(name.span for name in names if name.text in meant)

    @cached_property
    def _erroneous(self) -> frozenset[Span]:
        found = {d.span for d in self._declarations if self.is_erroneous(d.span)}
        lacking = {each.owner for each in self._program.unknown if each.owner != LIBRARY and not each.is_misspelt}
        found |= {span for span, skill in self._skills.items() if skill in lacking}
        return frozenset(found | self._incomplete)

    @cached_property
    def _terms(self) -> frozenset[str]:
        """The terms whose declarations have an error or were dropped, and those that are declared by means of them."""
        terms = [d for d in self._declarations if isinstance(d, _TERMS)]
        found = {d.name.text for d in terms if d.span in self._erroneous}
        dropped = (error for unit in self._program.files for error in unit.file.errors)
        found |= {error.name for error in dropped if error.keyword in _TERM_KEYWORDS}
        while found:
            more = {d.name.text for d in terms if not found.isdisjoint(_WORD.findall(self._lines_of(d.span)))}
            if more <= found:
                break
            found |= more
        return frozenset(found)

    @cached_property
    def _unsound(self) -> frozenset[str]:
        """The skills whose description, or that of a skill that their implementations call, has an error."""
        callers: dict[str, list[str]] = defaultdict(list)
        for declaration, called in self._calls.items():
            for name in called:
                callers[name].append(self._skills.get(declaration, ""))
        todo = [self._skills[span] for span in self._erroneous & self._described]
        todo += [self._skills[span] for span in self._described if self._mentions_terms(span)]
        todo += [name for unknown in self._program.unknown if unknown.owner == LIBRARY for name in unknown.close]
        if self._program.lost.declarations:
            todo += [name for name, known in self._program.implementations_of.items() if not known]
        found = set(todo)
        while todo:
            more = {*callers[todo.pop()]} - found
            found |= more
            todo += more
        return frozenset(found)

    @cached_property
    def _tainted(self) -> frozenset[Span]:
        """The declarations that have an error, mention such a term, describe, implement or call an unsound skill."""
        found = {span for span in self._all if span in self._erroneous or self._mentions_terms(span)}
        found |= {span for span, skill in self._skills.items() if skill in self._unsound}
        found |= {span for span, called in self._calls.items() if not self._unsound.isdisjoint(called)}
        wrong = {self._skills[span] for span in found & self._skills.keys()}
        return frozenset(found | {span for span in self._described if self._skills[span] in wrong})

    @cached_property
    def _all(self) -> list[Span]:
        return [d.span for d in self._declarations]

    @cached_property
    def _skills(self) -> Mapping[Span, str]:
        """The skill that a declaration describes or implements."""
        return {d.span: skill for d in self._declarations if (skill := skill_of(d))}

    @cached_property
    def _described(self) -> frozenset[Span]:
        return frozenset(d.span for d in self._declarations if isinstance(d, s.SkillDeclaration))

    @cached_property
    def _calls(self) -> Mapping[Span, frozenset[str]]:
        """The skills that each declaration calls."""
        return {d.span: frozenset(call.skill.text for call in calls_of(d)) for d in self._declarations}

    @cached_property
    def _texts(self) -> Mapping[str, list[str]]:
        return {unit.file.path: unit.text.split("\n") for unit in self._program.files}

    def _mentions_terms(self, span: Span) -> bool:
        return bool(self._terms) and not self._terms.isdisjoint(_WORD.findall(self._lines_of(span)))

    def _lines_of(self, span: Span) -> str:
        return "\n".join(self._texts.get(span.path, [])[span.line - 1 : span.end_line])
