"""Checks skills and scenes, with cached results for unchanged files.

Nothing heavy is imported unless something has to be checked.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple, TypeAlias, cast

from skillc.errors import DiagnosticsError, RequestError
from skillc.services.library.answer_store import AnswerStore
from skillc.services.library.check_inputs import CHECK, CheckInputs
from skillc.services.library.files import LibraryFiles, read_single_file, source_texts
from skillc.services.library.libraries_below import find_libraries
from skillc.services.reporting.reporter import find_texts, sort_diagnostics
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.garbage import gc_disabled
from skillc_dsl.query import Memo
from skillc_dsl.source import Source

STDIN = Path("-")
Memos: TypeAlias = dict[Path, Memo]
"""The last analysis of each library, by its folder."""


class StdinFile(NamedTuple):
    """The text from the standard input, and the path of the file that it stands for, None for no file."""

    path: Path | None
    content: bytes


class CheckRequest(NamedTuple):
    """The paths to check, with `scene` or without; `-` among the paths is `stdin`.

    With `cache`, unchanged libraries are not checked again. `backend` is where tasks will run, None for that of their
    project.
    """

    paths: tuple[Path, ...]
    scene: Path | None = None
    stdin: StdinFile | None = None
    cache: bool = True
    backend: str | None = None


class CheckResult(NamedTuple):
    """The diagnostics, each once and sorted by span, and the texts that they point into, by path."""

    diagnostics: tuple[Diagnostic, ...]
    texts: dict[str, Source]


def read_libraries(request: CheckRequest) -> list[LibraryFiles]:
    """Read the libraries at the paths and below them. RequestError for a path without a library."""
    found: list[LibraryFiles] = []
    for path in request.paths:
        found += [_from_stdin(request.stdin)] if path == STDIN else find_libraries(path)
    return [each._replace(backend=request.backend) for each in found]


def check_sources(request: CheckRequest, libraries: Iterable[LibraryFiles], memos: Memos | None = None) -> CheckResult:
    """Return the diagnostics of libraries that were read for a request, perhaps with changed texts.

    `memos` has the last analysis of each library in this process.
    """
    found: list[Diagnostic] = []
    texts: dict[str, Source] = {}
    for library in libraries:
        own = (*check_with_cache(request, library, memos), *_problems_of_project(library))
        found += own
        texts |= source_texts(library) if own else {}
    ordered = sort_diagnostics(found)
    return CheckResult(ordered, find_texts(ordered, texts))


def check_with_cache(
    request: CheckRequest, library: LibraryFiles, memos: Memos | None = None
) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of a library, from the store if nothing has changed."""
    inputs, store = CheckInputs.of(library, request.scene), AnswerStore() if request.cache else None
    known = store.load(CHECK, (inputs.digest,)) if store else None
    return _check(inputs, memos, store) if known is None else cast(tuple[Diagnostic, ...], known)


def _check(inputs: CheckInputs, memos: Memos | None, store: AnswerStore | None) -> tuple[Diagnostic, ...]:
    from skillc.services.check.known_checks import check_with

    memo = Memo() if memos is None else memos.setdefault(inputs.library.root, Memo())
    with gc_disabled():
        return check_with(memo, store, inputs)


def check_paths(request: CheckRequest) -> CheckResult:
    """Read the libraries at the paths and return their diagnostics, or those of a manifest that has errors."""
    try:
        libraries = read_libraries(request)
    except DiagnosticsError as error:
        return CheckResult(tuple(error.diagnostics), dict(error.texts))
    return check_sources(request, libraries)


def _problems_of_project(library: LibraryFiles) -> tuple[Diagnostic, ...]:
    if library.project is None:
        return ()
    from skillc.services.check.project_checks import check_project

    return tuple(check_project(library.project, library))


def _from_stdin(stdin: StdinFile | None) -> LibraryFiles:
    assert stdin is not None
    if stdin.path is not None and stdin.path.suffix != ".skill":
        raise RequestError(f"{stdin.path} is not a .skill file")
    return read_single_file(*stdin)
