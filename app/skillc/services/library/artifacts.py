"""Writes the artifacts of a library, and its HTML reference."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from skillc.errors import DiagnosticsError, ServiceError
from skillc.services.library import libraries
from skillc.services.library.bodiless import is_bodiless, without_unasked
from skillc.services.library.files import LibraryFiles, find_library, source_texts
from skillc.services.reporting.reporter import Reporter
from skillc_compiler.emit.artifacts import make_artifacts
from skillc_compiler.emit.headers import is_generated
from skillc_compiler.emit.write import EmitError, write
from skillc_compiler.program.program import ParsedFile
from skillc_compiler.resolve.files import read_sources
from skillc_model.declared import act_as_declared
from skillc_model.skills import SkillLibrary


def write_artifacts(path: Path, output: Path, reporter: Reporter) -> tuple[Path, ...]:
    """Compile the library at `path` into a folder and return the files written.

    Where no task has bodies, skills act as declared. RequestError, DiagnosticsError or ServiceError if it cannot be
    compiled or written; with errors nothing is written.
    """
    files = find_library(path)
    library = compile_and_report(files, reporter)
    bodiless = is_bodiless(_list_backends(library), files.is_symbolic)
    return _write(make_artifacts(act_as_declared(library) if bodiless else library), output)


def write_reference(path: Path, output: Path, reporter: Reporter) -> Path:
    """Write the HTML reference of a library into a folder and return its first page; errors as `write_artifacts`."""
    from skillc_compiler.emit.docs.site import MARK, make_site

    files = find_library(path)
    library = compile_and_report(files, reporter)
    _write(make_site(library, parse_files(files)), output, lambda text: MARK in text.partition("\n")[0])
    return output / "index.html"


def compile_and_report(files: LibraryFiles, reporter: Reporter) -> SkillLibrary:
    """Compile a library and report its warnings. DiagnosticsError if it has errors."""
    outcome = libraries.compile_library(files)
    shown = without_unasked(outcome.diagnostics, _list_backends(outcome.value), files.is_symbolic)
    if not outcome.ok:
        raise DiagnosticsError(shown, source_texts(files))
    reporter.show(shown, source_texts(files))
    return outcome.value


def _list_backends(library: SkillLibrary) -> Iterator[str | None]:
    return (each.backend for each in library.tasks.values())


def parse_files(files: LibraryFiles) -> tuple[ParsedFile, ...]:
    """Return the parsed files of a library and of its imports."""
    return read_sources(files.sources, files.importable, files.name, namespaces=files.namespaces).value


def _write(texts: Mapping[str, str], output: Path, is_own: Callable[[str], bool] = is_generated) -> tuple[Path, ...]:
    try:
        return write(texts, output, is_own)
    except EmitError as error:
        raise ServiceError(str(error)) from error
