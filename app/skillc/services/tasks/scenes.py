"""Reads the scenes of a library's tasks: their files, individuals and diagnostics."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Set
from pathlib import Path
from typing import TypeAlias

import msgspec

from skillc.services.library.files import LibraryFiles
from skillc.services.reporting.files import inspect_path
from skillc.services.scene import diagnostics as scene_diagnostics
from skillc.services.scene.diagnostics import with_shown_path
from skillc.services.tasks.individuals import Individuals, classes_by_individual
from skillc.services.tasks.named_scenes import default_scene, resolve_scene, why_missing
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Test
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.spelling import did_you_mean
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.scene.load import LoadedScene, read_with_sheets
from skillc_runtime.scene.statements import iri_of

TERM_KINDS = ("class", "relation", "property", "type")


def find_missing_terms(program: Program) -> frozenset[str]:
    """Return the IRIs of terms that files of a program use and none declares, and of classes below such ones."""
    namespaces = {unit.file.path: unit.namespace for unit in program.files}
    unknown = [each.written for each in program.unknown if each.kind in TERM_KINDS]
    found = {namespaces[each.span.path] + local_name(each) for each in unknown if each.span.path in namespaces}
    places = {each.span for each in unknown}
    below = set[str]()
    for unit in program.files:  # a class is declared after those above it, or its order is reported
        for each in unit.file.declarations:
            if isinstance(each, s.ClassDeclaration) and any(
                parent.span in places or local_name(parent) in below for parent in each.parents
            ):
                below.add(local_name(each.name))
                found.add(unit.namespace + local_name(each.name))
    return frozenset(found)


def local_name(name: s.Name) -> str:
    """Return a name without its prefix."""
    return name.text.rpartition(":")[2]


def select_problems(scene: Outcome[LoadedScene | None], missing: Collection[str]) -> Iterator[Diagnostic]:
    """Yield the problems of a scene but those at a class or predicate that is one of the missing terms."""
    said = scene.value.said if scene.value is not None and missing else ()
    places = {with_shown_path(each.predicate_place) for each in said if each.predicate in missing}
    places |= {with_shown_path(each.object_place) for each in said if iri_of(each.object) in missing}
    for problem in scene.diagnostics:
        if places.isdisjoint((problem.span, *(label.span for label in problem.labels))):
            yield problem


ReadScene: TypeAlias = Callable[[Path, Vocabulary], Outcome[LoadedScene | None]]
"""Reads a scene file with the terms of a vocabulary; None, with diagnostics, if it cannot be read."""


class SceneTexts(msgspec.Struct, frozen=True):
    """Maps the paths of a library to files on disk and to displayable paths; the scene of tasks that name none.

    `is_symbolic` says whether tasks run in cells without bodies that name a back end, or none.
    """

    place: Callable[[str], Path]
    shown: Callable[[str], str]
    is_symbolic: Callable[[str | None], bool]
    default: Path | None = None

    @staticmethod
    def of(files: LibraryFiles) -> SceneTexts:
        """Return those of a library on disk."""
        default = default_scene(files.project) if files.project else None
        return SceneTexts(files.places.__getitem__, files.display_path, files.is_symbolic, default)


class TaskScenes(msgspec.Struct, frozen=True):
    """The scenes of tasks, and others: `files` by task, `valid` scenes without errors by file, and diagnostics.

    `individuals` are those in each task's scene, by task. `bodiless`: the tasks that run in cells without bodies.
    """

    files: Mapping[str, Path]
    valid: Mapping[Path, LoadedScene]
    individuals: Mapping[str, Individuals]
    problems: tuple[Diagnostic, ...]
    bodiless: frozenset[str] = frozenset()


def read_scene(path: Path, vocabulary: Vocabulary, text: str | None = None) -> Outcome[LoadedScene | None]:
    """Read a scene file, or `text` in its place."""
    try:
        document = Document.read(path) if text is None else Document.of(str(path), text)
        scene = read_with_sheets(document, vocabulary)
    except SceneError as error:
        return Outcome(None, tuple(scene_diagnostics.with_shown_paths(error.problems)))
    return Outcome(scene, tuple(scene_diagnostics.with_shown_paths(scene.problems)))


def read_task_scenes(
    program: Program, texts: SceneTexts, others: Collection[Path] = (), read: ReadScene = read_scene
) -> TaskScenes:
    """Read the scenes of a program's own tasks, or the `others` alone; `read` may be a cached `read_scene`."""
    written = list(_written(program))
    found = {task: resolve_scene(text.value, texts.place(text.span.path).parent) for task, text in written}
    files = {task: path for task, path in found.items() if path is not None}
    if texts.default is not None:
        files |= dict.fromkeys(_without_scene(program), texts.default)
    if others:
        chosen = {scene.resolve() for scene in others}
        files = {task: path for task, path in files.items() if path.resolve() in chosen}
    bodiless = find_bodiless(program, texts.is_symbolic)
    factual = _find_factual(program, files, bodiless, others)
    if texts.is_symbolic(None):
        factual |= {*others}
    without_bodies = msgspec.structs.replace(program.vocabulary, symbolic=True)
    scenes = {
        path: read(path, without_bodies if path in factual else program.vocabulary)
        for path in sorted({*files.values(), *others})
    }
    valid = {path: scene.value for path, scene in scenes.items() if scene.ok and scene.value}
    known = {path: classes_by_individual(scene.state, program.vocabulary) for path, scene in valid.items()}
    missing = (_missing(text, texts) for task, text in written if found[task] is None and not others)
    lacking = find_missing_terms(program)
    wrong = (problem for scene in scenes.values() for problem in select_problems(scene, lacking))
    individuals = {task: known[path] for task, path in files.items() if path in known}
    return TaskScenes(files, valid, individuals, tuple(dict.fromkeys((*missing, *wrong))), bodiless)


def find_bodiless(program: Program, is_symbolic: Callable[[str | None], bool]) -> frozenset[str]:
    """Return the names of the tasks that run in cells without bodies, without those of tests, which always do."""
    tasks = (each for each in program.tasks if not isinstance(each, Test))
    return frozenset(each.name for each in tasks if is_symbolic(each.backend.text if each.backend else None))


def _find_factual(
    program: Program, files: Mapping[str, Path], bodiless: Set[str], others: Collection[Path]
) -> frozenset[Path]:
    """Return the scenes of which nothing spatial is asked: all that runs in them runs in cells without bodies.

    A scene that is among the `others` is asked for itself, whatever tests are in it.
    """
    tests = {each.name for each in program.tasks if isinstance(each, Test)}
    spatial = {path for name, path in files.items() if name not in tests | bodiless}
    only_tested = {path for name, path in files.items() if name in tests} if not others else set()
    return frozenset({path for name, path in files.items() if name in bodiless} | only_tested) - spatial


def _without_scene(program: Program) -> Iterator[str]:
    """Yield the names of the library's own tasks that name no scene."""
    for unit in program.files:
        for declaration in unit.file.declarations:
            if isinstance(declaration, s.TaskDeclaration) and not declaration.scene and unit.library == program.name:
                yield declaration.name.text


def _written(program: Program) -> Iterator[tuple[str, s.Text]]:
    """Yield the name of each of the library's own tasks with its scene as written."""
    for unit in program.files:
        for declaration in unit.file.declarations:
            if isinstance(declaration, s.TaskDeclaration) and declaration.scene and unit.library == program.name:
                yield declaration.name.text, declaration.scene


def _missing(scene: s.Text, texts: SceneTexts) -> Diagnostic:
    """Return the diagnostic of a scene that does not exist or is not a file."""
    beside = texts.place(scene.span.path).parent
    message = f'the scene "{scene.value}" {why_missing(scene.value, beside)}'
    span = scene.span._replace(path=texts.shown(scene.span.path))
    if inspect_path(beside / scene.value).kind != "missing":
        return Diagnostic("unreadable-scene", span, message)
    known = (*catalogue.scene_names(), *(file.name for file in beside.glob("*.ttl")))
    return Diagnostic("unknown-scene", span, message, did_you_mean(scene.value, known))
