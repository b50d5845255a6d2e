"""Which files an edit of bodies concerns, and which files have to be read to check them again."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from skillc_compiler.program.outlines import Outline, Run


def changed_skills(before: Mapping[str, Outline], now: Mapping[str, Outline]) -> frozenset[str]:
    """Return the skills of the bodies that differ, TASK for those of tasks; the outlines show the same otherwise."""
    pairs = (pair for path, new in now.items() for pair in zip(before[path].runs, new.runs, strict=True))
    return frozenset(new.skill for old, new in pairs if old.body != new.body)


def depending_skills(outlines: Mapping[str, Outline], changed: Iterable[str]) -> frozenset[str]:
    """Return skills with those that may run them, directly or through others; TASK if a task is among these."""
    found = set(changed)
    runs = list(_runs(outlines.values()))
    while more := {run.skill for run in runs if not found.isdisjoint(run.calls)} - found:
        found |= more
    return frozenset(found)


def concerned_files(outlines: Mapping[str, Outline], skills: frozenset[str]) -> frozenset[str]:
    """Return the files that describe, implement or call one of the skills."""
    return frozenset(path for path, outline in outlines.items() if not skills.isdisjoint(_named(outline)))


def needed_files(outlines: Mapping[str, Outline], checked: frozenset[str]) -> frozenset[str]:
    """Return the files with all that the checks of some files read.

    They have the skills that these name or may run, all implementations of these, the declared terms, and what all of
    them import.
    """
    skills = {skill for path in checked for skill in _named(outlines[path])}
    runs = list(_runs(outlines.values()))
    while more := {skill for run in runs if run.skill in skills for skill in run.calls} - skills:
        skills |= more
    found = {path for path, each in outlines.items() if each.adds_terms or not skills.isdisjoint(_provided(each))}
    todo = [*(found | checked)]
    found |= checked
    while todo:
        imported = set(outlines[todo.pop()].imports) - found
        found |= imported
        todo += imported
    return frozenset(found)


def _runs(outlines: Iterable[Outline]) -> Iterator[Run]:
    return (run for outline in outlines for run in outline.runs)


def _provided(outline: Outline) -> Iterator[str]:
    """Yield the skills that a file describes or implements."""
    yield from outline.described
    yield from outline.implemented


def _named(outline: Outline) -> Iterator[str]:
    yield from _provided(outline)
    for run in outline.runs:
        yield from run.calls
