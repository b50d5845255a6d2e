"""Checks again whenever a file of the libraries or a scene changes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from datetime import datetime
from pathlib import Path
from typing import NoReturn, TypeAlias

from skillc.errors import DiagnosticsError, RequestError
from skillc.services.check.checking import CheckRequest, CheckResult, Memos, check_sources, read_libraries
from skillc.services.library.check_inputs import named_scenes
from skillc.services.library.files import SHIPPED, LibraryFiles
from skillc.services.reporting.reporter import Reporter
from skillc_ontology import catalogue

_ENDINGS = (".skill", *catalogue.ENDINGS, ".py", ".toml", ".lock")
_PAUSE_MS = 300
"""How often folders are polled for their existence, in ms."""
Folders: TypeAlias = frozenset[tuple[Path, int]]
"""Folders with their inodes, which change when a folder is deleted and created again."""
Show: TypeAlias = Callable[[CheckResult], None]


def watch_sources(request: CheckRequest, show: Show, reporter: Reporter) -> NoReturn:
    """Check and show the result after each change, for ever; changes during a check lead to another one.

    RequestError if there is nothing to check at first.
    """
    memos: Memos = {}
    watch_folders(_roots(request, read_libraries(request)), lambda: _check(request, show, reporter, memos), reporter)


def watch_folders(wanted: tuple[Path, ...], work: Callable[[], tuple[Path, ...]], reporter: Reporter) -> NoReturn:
    """Call `work` after each change of a file in folders, for ever; it returns those to watch, none for the same."""
    while True:
        folders = _present(wanted)
        changes = _changes(folders)
        next(changes)
        while folders == _folders(wanted):
            wanted = work() or wanted
            if folders == _folders(wanted):
                reporter.say("waiting for changes; press Ctrl-C to stop")
                _await(changes, folders, wanted)
        if not _folders(wanted):
            reporter.say("the files were removed; waiting until they are back")


def _changes(folders: Folders) -> Iterator[object]:
    """Yield the changes below folders, or nothing after each pause."""
    from watchfiles import watch

    return watch(  # wait ends: after each pause, so that the caller can look at the folders
        *(path for path, _ in folders),
        watch_filter=lambda _, path: path.endswith(_ENDINGS),
        rust_timeout=_PAUSE_MS,
        yield_on_timeout=True,
    )


def _await(changes: Iterator[object], folders: Folders, wanted: Sequence[Path]) -> None:
    """Wait for a change of a file, or until a wanted folder is removed or created."""
    for change in changes:
        if change or folders != _folders(wanted):
            return


def _present(wanted: Sequence[Path]) -> Folders:
    """Return the existing folders, waiting until there is one."""
    while not (folders := _folders(wanted)):  # wait ends: when a folder is there, or with Ctrl-C
        time.sleep(_PAUSE_MS / 1000)
    return folders


def _folders(paths: Sequence[Path]) -> Folders:
    found = ((path, _number(path)) for path in paths)
    return frozenset((path, number) for path, number in found if number is not None)


def _number(path: Path) -> int | None:
    try:
        return path.stat().st_ino if path.is_dir() else None
    except OSError:
        return None


def _check(request: CheckRequest, show: Show, reporter: Reporter, memos: Memos) -> tuple[Path, ...]:
    """Check, show the result and the time it took; return the folders of all files, none if unreadable."""
    reporter.say(f"[{datetime.now():%H:%M:%S}] checking")
    start = time.perf_counter()
    try:
        libraries = read_libraries(request)
        result = check_sources(request, libraries, memos)
    except DiagnosticsError as error:
        show(CheckResult(tuple(error.diagnostics), dict(error.texts)))
        return ()
    except RequestError as error:
        reporter.say(f"error: {error}")
        return ()
    show(result)
    reporter.say(f"in {time.perf_counter() - start:.2f} s")
    return _roots(request, libraries)


def _roots(request: CheckRequest, libraries: Sequence[LibraryFiles]) -> tuple[Path, ...]:
    scenes = (request.scene.parent,) if request.scene else ()
    return tuple(dict.fromkeys((*list_folders(libraries), *scenes)))


def list_folders(libraries: Sequence[LibraryFiles]) -> tuple[Path, ...]:
    """Return the folders of libraries and of their scenes, without shipped scenes."""
    files = (scene for library in libraries for scene in named_scenes(library))
    scenes = {scene.parent for scene in files if not scene.is_relative_to(SHIPPED)}
    return tuple(dict.fromkeys((*(library.root for library in libraries), *sorted(scenes))))
