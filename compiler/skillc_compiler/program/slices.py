"""Which files an edit of skills and implementations concerns, and which have to be read to check these again."""

from __future__ import annotations

import hashlib
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cached_property, partial
from typing import TypeAlias

from skillc_compiler.program.outlines import DeclarationOutline, FileOutline, outline_of
from skillc_compiler.program.program import Program
from skillc_dsl import syntax as s
from skillc_dsl.query import Memo

Outlines: TypeAlias = Mapping[str, FileOutline]
"""The outlines of files, by path."""


def changed_skills(before: Outlines, now: Outlines) -> frozenset[str]:
    """Return the skills of the declarations that differ, TASK for tasks; the outlines show the same otherwise."""
    return frozenset(new.skill for _, old, new in _pairs(before, now) if old != new)


def changed_signatures(before: Outlines, now: Outlines) -> frozenset[str]:
    """Return the skills of the declarations that differ outside of bodies; the outlines show the same otherwise."""
    return frozenset(new.skill for _, old, new in _pairs(before, now) if old.described != new.described)


def changed_places(before: Outlines, now: Outlines) -> frozenset[tuple[str, int]]:
    """Return the lines, with their paths, of what differs outside of bodies.

    Not included are lines with the name of a declaration if it is where it was.
    """
    found: set[tuple[str, int]] = set()
    for path, old, new in _pairs(before, now):
        if old.described != new.described:
            found |= {(path, line) for line in range(old.first, old.last + 1)}
            found -= {(path, old.named_at[0])} if old.named_at == new.named_at else set()
    return frozenset(found)


def _pairs(before: Outlines, now: Outlines) -> Iterator[tuple[str, DeclarationOutline, DeclarationOutline]]:
    """Yield what was declared and what is declared, with its path, for the paths of `now`."""
    for path, new in now.items():
        yield from ((path, *pair) for pair in zip(before[path].declared, new.declared, strict=True))


class Dependencies:
    """Which skills and files of a library depend on which, by the outlines of its files."""

    def __init__(self, outlines: Outlines) -> None:
        self._outlines = outlines

    def callers(self, changed: Iterable[str]) -> frozenset[str]:
        """Return skills with those that may run them, directly or through others; TASK if a task is among these."""
        return frozenset(_reached(changed, self._callers))

    def concerned(self, skills: frozenset[str]) -> frozenset[str]:
        """Return the files that describe, implement or call one of the skills."""
        return frozenset(path for path, each in self._outlines.items() if not skills.isdisjoint(each.named))

    def needed(self, checked: Iterable[str]) -> frozenset[str]:
        """Return the files with all that the checks of some files read.

        They have the skills that these name or may run, all implementations of these, the declared terms, and what all
        of them import.
        """
        skills = _reached({skill for path in checked for skill in self._outlines[path].named}, self._called)
        files = {path for skill in skills for path in self._providers.get(skill, ())}
        return frozenset(_reached({*files, *self._with_terms, *checked}, self._imports))

    @cached_property
    def _imports(self) -> Mapping[str, Collection[str]]:
        return {path: each.imports for path, each in self._outlines.items()}

    @cached_property
    def _with_terms(self) -> frozenset[str]:
        return frozenset(path for path, each in self._outlines.items() if each.adds_terms)

    @cached_property
    def _called(self) -> Mapping[str, Collection[str]]:
        found: dict[str, set[str]] = defaultdict(set)
        for each in (each for outline in self._outlines.values() for each in outline.declared):
            found[each.skill] |= each.calls
        return found

    @cached_property
    def _callers(self) -> Mapping[str, Collection[str]]:
        found: dict[str, set[str]] = defaultdict(set)
        for skill, called in self._called.items():
            for each in called:
                found[each].add(skill)
        return found

    @cached_property
    def _providers(self) -> Mapping[str, Collection[str]]:
        """The files that describe or implement a skill."""
        found: dict[str, set[str]] = defaultdict(set)
        for path, each in self._outlines.items():
            for declared in each.declared:
                found[declared.skill].add(path)
        return found


def digest_reads(program: Program, memo: Memo) -> dict[str, str]:
    """Return, by path, the digest of all texts that the checks of a file read.

    Files for which something is read that is not clear are left out.
    """
    declared = (each for unit in program.files for each in unit.file.declarations)
    functions = [each.name.text for each in declared if isinstance(each, s.FunctionDeclaration)]
    if program.lost.twice or len(functions) > len(set(functions)):
        return {}  # of what is declared twice only one counts
    unclear = {each.written.span.path for each in program.unknown}
    unclear |= {unit.file.path for unit in program.files if unit.file.errors}
    texts = {
        unit.file.path: f"{unit.file.path} {len(unit.file.declarations)} {digest_text(unit.text)}"
        for unit in program.files
    }
    dependencies = Dependencies(outlines_of(program, memo))
    needed = ((path, dependencies.needed((path,))) for path in texts)
    return {
        path: digest_text("\n".join((path, *(texts[each] for each in sorted(read)))))
        for path, read in needed
        if read.isdisjoint(unclear)
    }


def outlines_of(program: Program, memo: Memo) -> dict[str, FileOutline]:
    """Return the outlines of all files of a program, by path."""
    return {each.file.path: memo.ask("outline", (each,), partial(outline_of, each)) for each in program.files}


def digest_text(text: str) -> str:
    """Return the digest of a text."""
    return hashlib.sha256(text.encode("utf-8", "surrogateescape")).hexdigest()


def _reached(start: Iterable[str], edges: Mapping[str, Collection[str]]) -> set[str]:
    """Return what is reached from `start`, which is included."""
    found = set(start)
    todo = [*found]
    while todo:
        more = [each for each in edges.get(todo.pop(), ()) if each not in found]
        found.update(more)
        todo += more
    return found
