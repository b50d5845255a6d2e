"""Finds the axioms by which facts that a run has read follow from the scene, instead of being stated in it."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path

from skillc.errors import ServiceError
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc.services.project.project import find_root
from skillc.services.reporting.files import inspect_path
from skillc.services.scene.rule_reasons import RuleReasons
from skillc_dsl.position import Position
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.world.state.labels.labelled import LabelledClass, LabelledFact, LabelledRelation


class RulePlaces:
    """The places of the axioms, by the ontologies of the library beside a scene as they are now."""

    def __init__(self, scene: str) -> None:
        """Find facts of a scene; none are found if the file or its library does not exist or cannot be read."""
        self._scene = scene

    def find(self, fact: LabelledFact) -> Position | None:
        """Return where the first axiom is stated from which a fact follows; None if it does not follow from one."""
        match fact:
            case LabelledClass(individual, cls, True):
                return self._place(individual.iri, RDF_TYPE, cls.iri)
            case LabelledRelation(subject, relation, object_, True) if subject is not None and object_ is not None:
                return self._place(subject.iri, relation.iri, object_.iri)
            case _:
                return None

    def _place(self, subject: str, predicate: str, object_: str) -> Position | None:
        if self._reasons is None:
            return None
        for each in self._reasons.find(subject):
            _, said, other = each.fact
            if (said.value, other.value) == (predicate, object_):
                return next(map(self._reasons.place, each.rules), None)
        return None

    @cached_property
    def _reasons(self) -> RuleReasons | None:
        path = Path(self._scene)
        folder = path.parent
        if inspect_path(path).kind != "file" or not (any(folder.glob("*.skill")) or find_root(folder)):
            return None
        try:
            files = find_library(folder)
            if not files.vocabularies:
                return None
            return RuleReasons(Document.read(path), compile_valid(files).vocabulary, files.vocabularies)
        except (ServiceError, SceneError, OSError):
            return None
