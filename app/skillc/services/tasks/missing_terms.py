"""Leaves out the problems of scenes that follow from terms which the skills of the library lack, too."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from skillc.services.scene.diagnostics import with_shown_path
from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_runtime.scene.load import LoadedScene
from skillc_runtime.scene.statements import iri_of

TERM_KINDS = ("class", "relation", "property", "type")


def find_missing_terms(program: Program) -> frozenset[str]:
    """Return the IRIs that terms would have which files of a program use and none declares."""
    namespaces = {unit.file.path: unit.namespace for unit in program.files}
    unknown = (each for each in program.unknown if each.kind in TERM_KINDS)
    named = ((each.written.span.path, each.written.text.rpartition(":")[2]) for each in unknown)
    return frozenset(namespaces[path] + name for path, name in named if path in namespaces)


def select_problems(scene: Outcome[LoadedScene | None], missing: Collection[str]) -> Iterator[Diagnostic]:
    """Yield the problems of a scene but those at a class or predicate that is one of the missing terms."""
    said = scene.value.said if scene.value is not None and missing else ()
    places = {with_shown_path(each.predicate_place) for each in said if each.predicate in missing}
    places |= {with_shown_path(each.object_place) for each in said if iri_of(each.object) in missing}
    yield from (problem for problem in scene.diagnostics if problem.span not in places)
