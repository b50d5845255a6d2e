"""Finding, reading and compiling a skill library for the commands."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from pathlib import Path

import click

from skillc_compiler import pipeline
from skillc_compiler.library.skills import SkillLibrary, Task
from skillc_compiler.library.vocabulary import Vocabulary
from skillc_compiler.vocabulary.load import load
from skillc_dsl.diagnostics import Diagnostic, Outcome, did_you_mean
from skillc_dsl.encoding import decode
from skillc_dsl.source import Source, Span
from skillc_ontology import catalogue

SHIPPED = Path(str(files("skillc_skills")))


@dataclass(frozen=True, slots=True)
class LibraryFiles:
    """A library: `sources` under paths relative to `root`, `shelf` what may be imported besides, by name.

    `places` are the files of all of them on disk.
    """

    name: str
    root: Path
    sources: tuple[Source, ...]
    shelf: dict[str, Source]
    places: dict[str, Path]

    def shown(self, path: str) -> str:
        """Return a source's path as a user can open it from here; ontology files are below the ontology."""
        file, here = self.places.get(path, catalogue.ROOT / path), Path.cwd()
        return str(file.relative_to(here) if file.is_relative_to(here) else file)


def find(path: Path) -> LibraryFiles:
    """Read the library at a folder, the single file at `path` with its neighbours, or the shipped library of that name.

    UsageError for a path that is none of these, or that holds no `.skill` file.
    """
    if not path.exists() and (SHIPPED / path).is_dir():
        path = SHIPPED / path
    shelf = {file.name: (f"std/{file.name}", file) for file in (SHIPPED / "std").glob("*.skill")}
    shipped = (file.relative_to(SHIPPED).as_posix() for file in SHIPPED.glob("*/*.skill") if file.parent.name != "std")
    shelf |= {name: (name, SHIPPED / name) for name in shipped}
    if path.is_dir():
        sources = {file.relative_to(path).as_posix(): file for file in sorted(path.rglob("*.skill"))}
        if not sources:
            raise click.UsageError(f"there is no .skill file in {path}")
        return _files(path.resolve().name, path, sources, shelf)
    if path.is_file():
        if path.suffix != ".skill":
            raise click.UsageError(f"{path} is not a .skill file")
        neighbours = {file.name: (file.name, file) for file in path.parent.glob("*.skill") if file != path}
        return _files(path.resolve().parent.name, path.parent, {path.name: path}, shelf | neighbours)
    raise click.UsageError(f"there is no file or folder {path}")


def _files(name: str, root: Path, sources: dict[str, Path], shelf: dict[str, tuple[str, Path]]) -> LibraryFiles:
    return LibraryFiles(
        name,
        root,
        tuple(_read(file, shown) for shown, file in sources.items()),
        {wanted: _read(file, shown) for wanted, (shown, file) in sorted(shelf.items())},
        dict(shelf.values()) | sources,
    )


def compile_library(
    library: LibraryFiles, scenes: Mapping[str, Mapping[str, Sequence[str]]] | None = None
) -> Outcome[SkillLibrary]:
    """Compile, with the shipped ontology as vocabulary; diagnostics show paths as from here.

    `scenes` are the individuals that each task may name, with their classes; those of other tasks are not checked.
    """
    outcome = pipeline.compile(library.sources, vocabulary(), library.shelf, library.name, scenes or {})
    return Outcome(outcome.value, tuple(_relocate(d, library) for d in outcome.diagnostics))


@cache
def vocabulary() -> Vocabulary:
    """Load the shipped ontology."""
    outcome = load([Source(path, text) for path, text in catalogue.vocabulary_files()])
    if outcome.diagnostics:
        raise RuntimeError(f"the shipped ontology is broken: {outcome.diagnostics[0].message}")
    return outcome.value


def texts(library: LibraryFiles) -> dict[str, Source]:
    """Return every text that a diagnostic may point into, by the path it shows."""
    every: Iterable[Source] = (*library.sources, *library.shelf.values())
    return {library.shown(s.path): Source(library.shown(s.path), s.text) for s in every}


def find_task(reference: str) -> tuple[LibraryFiles, str]:
    """Split `LIBRARY:NAME`, or take a bare name as a task of the shipped wiping library."""
    path, colon, name = reference.rpartition(":")
    return find(Path(path) if colon else SHIPPED / "wiping"), name


def task_named(library: SkillLibrary, name: str) -> Task:
    """Return a task; UsageError lists those that exist."""
    if name not in library.tasks:
        hint = did_you_mean(name, library.tasks) or "it has none"
        elsewhere = "a task of another library is written LIBRARY:NAME"
        raise click.UsageError(f"there is no task `{name}` in {library.name}: {hint}; {elsewhere}")
    return library.tasks[name]


def _read(file: Path, name: str) -> Source:
    try:
        return decode(name, file.read_bytes())
    except OSError as error:
        raise click.UsageError(f"{file} cannot be read: {error.strerror}") from error


def _relocate(diagnostic: Diagnostic, library: LibraryFiles) -> Diagnostic:
    def moved(span: Span) -> Span:
        return replace(span, path=library.shown(span.path))

    return replace(
        diagnostic,
        span=moved(diagnostic.span),
        labels=tuple(replace(label, span=moved(label.span)) for label in diagnostic.labels),
        fix=replace(diagnostic.fix, span=moved(diagnostic.fix.span)) if diagnostic.fix else None,
    )
