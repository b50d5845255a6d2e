"""The scenes of a library's tasks: which files they are, who is in them, and what is wrong with them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeAlias

from skillc_compiler.library.skills import Task
from skillc_compiler.library.vocabulary import Vocabulary
from skillc_compiler.program.typed import Program
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Outcome, did_you_mean
from skillc_ontology import catalogue
from skillc_runtime.commands import _diagnostics
from skillc_runtime.commands._files import LibraryFiles
from skillc_runtime.commands._paths import look
from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.scene.load import Scene, scene_in
from skillc_runtime.world.state.world_state import WorldState

Individuals: TypeAlias = dict[str, list[str]]
"""The IRIs of a scene with their classes."""
Read: TypeAlias = Callable[[Path, Vocabulary], Outcome[Scene | None]]
"""Reads a scene in the words of a vocabulary, with what is wrong with it; None where there is no text."""


@dataclass(frozen=True, slots=True)
class Desk:
    """Where the files of a library are: its places on disk, and how diagnostics show them, both by path."""

    place: Callable[[str], Path]
    shown: Callable[[str], str]

    @staticmethod
    def of(files: LibraryFiles) -> Desk:
        """Return where the files of a library on disk are."""
        return Desk(files.places.__getitem__, files.shown)


@dataclass(frozen=True, slots=True)
class Populated:
    """Scenes that were read: those without errors by file, the files of those of tasks by task, and what is wrong.

    `individuals` are those of each task's scene.
    """

    of_tasks: Mapping[str, Path]
    sound: Mapping[Path, Scene]
    individuals: Mapping[str, Individuals]
    problems: tuple[Diagnostic, ...]


def read(path: Path, vocabulary: Vocabulary, text: str | None = None) -> Outcome[Scene | None]:
    """Read a scene file, or a text that stands for it."""
    try:
        document = Document.read(path) if text is None else Document(str(path), text)
        scene = scene_in(document, vocabulary)
    except SceneError as error:
        return Outcome(None, tuple(_diagnostics.with_shown_paths(error.problems)))
    return Outcome(scene, tuple(_diagnostics.with_shown_paths(scene.problems)))


def populated(program: Program, desk: Desk, others: Collection[Path] = (), read_by: Read = read) -> Populated:
    """Read the scenes of a program's own tasks, and others; `read_by` may remember what it read before."""
    written = list(_written(program))
    found = {task: path_of(text.value, desk.place(text.span.path).parent) for task, text in written}
    of_tasks = {task: path for task, path in found.items() if path is not None}
    scenes = {path: read_by(path, program.vocabulary) for path in sorted({*of_tasks.values(), *others})}
    sound = {path: scene.value for path, scene in scenes.items() if scene.ok and scene.value}
    people = {path: classes_of(scene.state, program.vocabulary) for path, scene in sound.items()}
    missing = (_absent(text, desk) for task, text in written if task not in of_tasks)
    wrong = (problem for scene in scenes.values() for problem in scene.diagnostics)
    individuals = {task: people[path] for task, path in of_tasks.items() if path in people}
    return Populated(of_tasks, sound, individuals, tuple(dict.fromkeys((*missing, *wrong))))


def scene_of(task: Task, files: LibraryFiles) -> Path | None:
    """Return the file of a compiled task's scene; None where there is no such file."""
    assert task.scene is not None
    return path_of(task.scene, files.places[task.source.path].parent)


def path_of(scene: str, beside: Path) -> Path | None:
    """Return the file of a scene, beside the task's file or shipped; None where there is no such file."""
    if look(beside / scene).kind == "file":
        return beside / scene
    try:
        return catalogue.scene(scene)
    except FileNotFoundError:
        return None


def classes_of(state: WorldState, vocabulary: Vocabulary) -> Individuals:
    """Return the individuals of a world with their classes, as a library knows them: the scene may have its own."""
    known = vocabulary.classes.keys()
    above = state.vocabulary.ancestors
    return {
        iri: sorted({each for cls in state.types(iri) for each in ({cls} if cls in known else above[cls] & known)})
        for iri in state.individuals
    }


def _written(program: Program) -> Iterator[tuple[str, s.Text]]:
    """Yield each task with its scene as written, those of the shelf left out."""
    for unit in program.files:
        for declaration in unit.file.declarations:
            if isinstance(declaration, s.TaskDeclaration) and declaration.scene and unit.library == program.name:
                yield declaration.name.text, declaration.scene


def why_absent(scene: str, beside: Path) -> str:
    """Return why there is no such file as that of a scene, after its name."""
    found = look(beside / scene)
    return "is neither beside this file nor shipped" if found.kind == "missing" else found.is_what


def _absent(scene: s.Text, desk: Desk) -> Diagnostic:
    """Return the problem of a scene that is not there, or that is there and no file."""
    beside = desk.place(scene.span.path).parent
    message = f'the scene "{scene.value}" {why_absent(scene.value, beside)}'
    span = replace(scene.span, path=desk.shown(scene.span.path))
    if look(beside / scene.value).kind != "missing":
        return Diagnostic("unreadable-scene", span, message)
    return Diagnostic("unknown-scene", span, message, did_you_mean(scene.value, catalogue.scenes()))
