"""The individuals in the scenes of a library's tasks, read anew only when a scene or the library's terms change."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import msgspec

from skillc_compiler.library.vocabulary import Vocabulary
from skillc_compiler.program import Program
from skillc_compiler.resolve.individuals import Individuals
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, did_you_mean
from skillc_ontology import catalogue


@dataclass(frozen=True, slots=True)
class Populated:
    """The individuals of each task's scene, and what is wrong with the scenes that do not ship with skillc."""

    individuals: Mapping[str, Individuals]
    problems: tuple[Diagnostic, ...] = ()


@dataclass
class Scenes:
    """Remembers what stands in scene files."""

    _read: dict[tuple[Path, int, bytes], tuple[Individuals, tuple[Diagnostic, ...]]] = field(default_factory=dict)

    def of(self, program: Program, base: Vocabulary, folder: Path) -> Populated:
        """Return the scenes of a program's tasks; of a file that is no scene no individuals are known."""
        terms = _own_terms(program.vocabulary, base)
        individuals: dict[str, Individuals] = {}
        problems: dict[Diagnostic, None] = {}
        for task, written in _scenes_of(program):
            file = path_of(written.value, (folder / written.span.path).parent)
            if file is None:
                problems[_unknown(written)] = None
                continue
            found, wrong = self._scene(file, program.vocabulary, terms)
            problems |= dict.fromkeys(wrong)
            if found:
                individuals[task] = found
        return Populated(individuals, tuple(problems))

    def _scene(self, file: Path, vocabulary: Vocabulary, terms: bytes) -> tuple[Individuals, tuple[Diagnostic, ...]]:
        try:
            key = (file, file.stat().st_mtime_ns, terms)
        except OSError:
            return {}, ()
        if key not in self._read:
            self._read = {other: found for other, found in self._read.items() if other[0] != file}
            self._read[key] = _scene(file, vocabulary)
        return self._read[key]


def path_of(scene: str, beside: Path) -> Path | None:
    """Return the file of a scene beside a library's file, or shipped; None where there is none."""
    if (beside / scene).is_file():
        return beside / scene
    try:
        return catalogue.scene(scene)
    except FileNotFoundError:
        return None


def _scenes_of(program: Program) -> Iterator[tuple[str, s.Text]]:
    """Yield each task with its scene as written, those of the shelf left out."""
    for unit in program.files:
        for declaration in unit.file.declarations:
            if isinstance(declaration, s.TaskDeclaration) and declaration.scene and unit.library == program.name:
                yield declaration.name.text, declaration.scene


def _unknown(scene: s.Text) -> Diagnostic:
    message = f'the scene "{scene.value}" is neither beside this file nor shipped'
    return Diagnostic("unknown-scene", scene.span, message, did_you_mean(scene.value, catalogue.scenes()))


def _scene(file: Path, vocabulary: Vocabulary) -> tuple[Individuals, tuple[Diagnostic, ...]]:
    """Read a scene. The world model is imported only here: libraries without tasks do not wait for it."""
    from skillc_runtime.commands._diagnostics import of_problems
    from skillc_runtime.world.documents import SceneError
    from skillc_runtime.world.scene import read_scene

    try:
        scene = read_scene(file, vocabulary)
    except SceneError as error:
        return {}, tuple(of_problems(error.problems))
    own = (problem for problem in scene.problems if problem.place.path == str(file))
    shipped = catalogue.ROOT in file.parents
    known = {iri: sorted(scene.state.types(iri)) for iri in scene.state.individuals} if scene.ok else {}
    return known, () if shipped else tuple(of_problems(own))


def _own_terms(vocabulary: Vocabulary, base: Vocabulary) -> bytes:
    """Return what the library adds to the vocabulary, whatever the lines it stands in."""
    pairs = ((vocabulary.classes, base.classes), (vocabulary.relations, base.relations))
    tables: tuple[tuple[Mapping[str, msgspec.Struct], Mapping[str, msgspec.Struct]], ...] = pairs
    own = [term for mine, theirs in tables for iri, term in mine.items() if theirs.get(iri) != term]
    own += [term for iri, term in vocabulary.properties.items() if base.properties.get(iri) != term]
    return msgspec.json.encode([msgspec.structs.replace(term, source=None) for term in own])
