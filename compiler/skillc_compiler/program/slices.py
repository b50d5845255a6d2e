"""Which files an edit of bodies concerns, and which files have to be read to check them again."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cached_property

from skillc_compiler.program.outlines import FileOutline


def changed_skills(before: Mapping[str, FileOutline], now: Mapping[str, FileOutline]) -> frozenset[str]:
    """Return the skills of the bodies that differ, TASK for those of tasks; the outlines show the same otherwise."""
    pairs = (pair for path, new in now.items() for pair in zip(before[path].runs, new.runs, strict=True))
    return frozenset(new.skill for old, new in pairs if old.body != new.body)


class Dependencies:
    """Which skills and files of a library depend on which, by the outlines of its files."""

    def __init__(self, outlines: Mapping[str, FileOutline]) -> None:
        self._outlines = outlines

    def callers(self, changed: Iterable[str]) -> frozenset[str]:
        """Return skills with those that may run them, directly or through others; TASK if a task is among these."""
        return frozenset(_reached(changed, self._callers))

    def concerned(self, skills: frozenset[str]) -> frozenset[str]:
        """Return the files that describe, implement or call one of the skills."""
        return frozenset(path for path, each in self._outlines.items() if not skills.isdisjoint(_named(each)))

    def needed(self, checked: Iterable[str]) -> frozenset[str]:
        """Return the files with all that the checks of some files read.

        They have the skills that these name or may run, all implementations of these, the declared terms, and what all
        of them import.
        """
        skills = _reached({skill for path in checked for skill in _named(self._outlines[path])}, self._called)
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
        for run in (run for each in self._outlines.values() for run in each.runs):
            found[run.skill] |= run.calls
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
            for skill in each.described | each.implemented:
                found[skill].add(path)
        return found


def _reached(start: Iterable[str], edges: Mapping[str, Collection[str]]) -> set[str]:
    """Return what is reached from `start`, which is included."""
    found = set(start)
    todo = [*found]
    while todo:
        more = [each for each in edges.get(todo.pop(), ()) if each not in found]
        found.update(more)
        todo += more
    return found


def _named(outline: FileOutline) -> Iterator[str]:
    """Yield the skills that a file describes, implements or calls."""
    yield from outline.described
    yield from outline.implemented
    for run in outline.runs:
        yield from run.calls
