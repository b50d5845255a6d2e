"""What an author writes instead of a name that a library once had."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from types import MappingProxyType

from skillc_compiler.program import name_notes
from skillc_compiler.program.typed import ParsedFile
from skillc_dsl.diagnostics import Diagnostic, Fix

FormerNames = Mapping[tuple[str, str], str]
"""The advice for each name, by its skill and the name; skills and functions belong to LIBRARY."""
NONE: FormerNames = MappingProxyType({})


def find_former_names(files: Iterable[ParsedFile]) -> FormerNames:
    """Return what the comments of files say about names that are no more."""
    return {(each.owner, each.name): each.advice for each in name_notes.find_former_names(files)}


def with_advice(problem: Diagnostic, advice: str) -> Diagnostic:
    """Return the problem with an unknown name with what to do about it; another name is a fix."""
    renamed = name_notes.RENAMED.match(advice)
    fix = Fix(problem.span, renamed[1], f"write `{renamed[1]}`", safe=False) if renamed else None
    return replace(problem, message=f"{problem.message} any more", help=advice, fix=fix)
