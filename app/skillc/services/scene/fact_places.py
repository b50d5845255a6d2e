"""Finds where a scene states the facts that a run has read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property
from pathlib import Path
from typing import TypeAlias

import pyoxigraph as ox

from skillc.services.reporting.files import inspect_path
from skillc_dsl.position import Position
from skillc_ontology.catalogue import ROOT, sheet_files
from skillc_rdf.turtle.parser import parse
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.world.state.labels.labelled import (
    LabelledClass,
    LabelledFact,
    LabelledIdentity,
    LabelledProperty,
    LabelledRelation,
)

Statements: TypeAlias = dict[str, list[Statement]]
"""Statements by the IRI of their subjects."""


class FactPlaces:
    """The places of facts in a scene in Turtle and in the data sheets. Files are read when they are first needed."""

    def __init__(self, scene: str) -> None:
        """Find facts in a scene; none are found if the file does not exist or cannot be read."""
        self._scene = scene

    def find(self, fact: LabelledFact) -> Position | None:
        """Return where a fact is stated, or one between the same individuals that implies it; None if nowhere."""
        match fact:
            case LabelledProperty(individual, property_):
                return next(self._stated(individual.iri, property_.iri, None), None)
            case LabelledRelation(subject, relation, object_, holds):
                if not holds or subject is None or object_ is None:
                    return None
                tried = (
                    (subject.iri, relation.iri, object_.iri),
                    (subject.iri, None, object_.iri),
                    (object_.iri, None, subject.iri),
                )
                return next((place for each in tried for place in self._stated(*each)), None)
            case LabelledClass(individual, _, holds):
                return next(self._stated(individual.iri, RDF_TYPE, None), None) if holds else None
            case LabelledIdentity():
                return None

    def _stated(self, subject: str, predicate: str | None, object_: str | None) -> Iterator[Position]:
        """Yield the places of the objects of statements, those of the scene first."""
        for each in self._about(subject):
            if predicate in (None, each.predicate) and object_ in (None, _iri(each.object)):
                at = each.object_place
                yield Position(at.path, at.line, at.column)

    def _about(self, subject: str) -> Iterator[Statement]:
        yield from self._scene_statements.get(subject, ())
        yield from self._sheet_statements.get(subject, ())

    @cached_property
    def _scene_statements(self) -> Statements:
        path = Path(self._scene)
        if path.suffix != ".ttl" or inspect_path(path).kind != "file":
            return {}
        try:
            return _by_subject([(_name_file(path), path.read_text(encoding="utf-8"))])
        except (OSError, UnicodeDecodeError):
            return {}

    @cached_property
    def _sheet_statements(self) -> Statements:
        turtle = ((Path(name), text) for name, text in sheet_files() if name.endswith(".ttl"))
        return _by_subject((_name_file(path), text) for path, text in turtle)


def _name_file(path: Path) -> str:
    """Return a file as users name it: a shipped scene by its name, others relative to the current folder if below."""
    if path.parent == ROOT / "scenes":
        return path.name
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path)


def _by_subject(files: Iterable[tuple[str, str]]) -> Statements:
    """Return the statements of files, each a path and its text, as far as they can be read."""
    found: Statements = {}
    for path, text in files:
        for each in parse(path, text, base="file:///x").statements:
            found.setdefault(_iri(each.subject), []).append(each)
    return found


def _iri(node: object) -> str:
    return node.value if isinstance(node, ox.NamedNode) else ""
