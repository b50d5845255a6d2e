"""`skillc check --watch`: checks again whenever a file of the library or a scene changes, until Ctrl-C."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from datetime import datetime
from pathlib import Path
from typing import NoReturn

import click

from skillc_runtime.commands import _check_runs, _telling
from skillc_runtime.commands._check_runs import Job
from skillc_runtime.commands._digests import scenes_of
from skillc_runtime.commands._files import SHIPPED, LibraryFiles

_ENDINGS = (".skill", ".ttl", ".py")
_PAUSE_MS = 300
"""How often is looked whether a folder is gone, or back."""
Folders = frozenset[tuple[Path, int]]
"""Folders with their number on the disk, which is another one when a folder is made anew."""


def run(job: Job) -> int:
    """Check, wait for a change, and so on; return 0 on Ctrl-C. UsageError without the package that watches files."""
    try:
        import watchfiles  # noqa: F401
    except ImportError as error:
        raise click.UsageError("--watch needs the package watchfiles: pip install 'skillc[editor]'") from error
    try:
        _watch(job)
    except KeyboardInterrupt:
        click.echo(err=True)
        return 0


def _watch(job: Job) -> NoReturn:
    """Check and wait for ever; what changes during a check is noticed after it."""
    wanted = _roots(job, _check_runs.libraries(job))
    while True:
        folders = _present(wanted)
        changes = _changes(folders)
        next(changes)
        while folders == _folders(wanted):
            wanted = _check(job) or wanted
            if folders == _folders(wanted):
                click.echo("waiting for a change; Ctrl-C ends", err=True)
                _await(changes, folders, wanted)
        if not _folders(wanted):
            click.echo("nothing is there any more; waiting until it is back", err=True)


def _changes(folders: Folders) -> Iterator[object]:
    """Yield the changes below folders, or nothing after each pause."""
    from watchfiles import watch

    return watch(
        *(path for path, _ in folders),
        watch_filter=lambda _, path: path.endswith(_ENDINGS),
        rust_timeout=_PAUSE_MS,
        yield_on_timeout=True,
    )


def _await(changes: Iterator[object], folders: Folders, wanted: Sequence[Path]) -> None:
    """Wait for a change, or until a wanted folder is another one, gone or back."""
    for change in changes:
        if change or folders != _folders(wanted):
            return


def _present(wanted: Sequence[Path]) -> Folders:
    """Return the folders that there are, as soon as there is one."""
    while not (folders := _folders(wanted)):
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


def _check(job: Job) -> tuple[Path, ...]:
    """Print what is found now, with the time it took; return the folders of all files, none if they cannot be read."""
    click.echo(f"[{datetime.now():%H:%M:%S}] checking", err=True)
    start = time.perf_counter()
    try:
        libraries = _check_runs.libraries(job)
        found, texts = _check_runs.found_in_all(job, libraries)
    except click.UsageError as error:
        click.echo(f"error: {error.message}", err=True)
        return ()
    _telling.show(found, texts, job.form)
    click.echo(f"in {time.perf_counter() - start:.2f} s", err=True)
    return _roots(job, libraries)


def _roots(job: Job, libraries: Sequence[LibraryFiles]) -> tuple[Path, ...]:
    """Return the folders of libraries and of their scenes, the shipped ones left out."""
    files = (scene for library in libraries for scene in scenes_of(library))
    scenes = {scene.parent for scene in files if not scene.is_relative_to(SHIPPED)}
    if job.scene:
        scenes.add(job.scene.parent)
    return tuple(dict.fromkeys((*(library.root for library in libraries), *sorted(scenes))))
