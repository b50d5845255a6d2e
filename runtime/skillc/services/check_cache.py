"""What checks found before, so that nothing is done twice; nothing heavy is imported here.

An entry is stored under the digest of everything that it depends on, so that one that no longer holds is never found.
"""

from __future__ import annotations

import hashlib
import os
import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from skillc.services.library_files import LibraryFiles
from skillc_dsl import cache
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import read_file
from skillc_dsl.rendering import json
from skillc_dsl.source import Source
from skillc_ontology.catalogue import own_models

PACKAGES = ("skillc_dsl", "skillc_ontology", "skillc_compiler", "skillc_runtime", "skillc_skills", "skillc")
_SCENE = re.compile(r'\bscene\s+"([^"\n]+)"')
_PYTHON = re.compile(r'\bpython\s+"([\w.]+):(\w+)"')
_MOST = 500
"""Entries that are kept; of more, the older half is deleted."""


@dataclass(frozen=True, slots=True)
class CheckCacheEntry:
    """A library, with a scene or without, as it was when its `digest` was taken."""

    library: LibraryFiles
    scene: Path | None
    digest: str

    @staticmethod
    def of(library: LibraryFiles, scene: Path | None) -> CheckCacheEntry:
        """Take the digest of how things are now."""
        return CheckCacheEntry(library, scene, digest_of(library, scene))

    def load(self) -> tuple[Diagnostic, ...] | None:
        """Return what was found before; None if it was never checked like this."""
        path = self._path()
        body = cache.load(path) if path else None
        return None if body is None else json.read(body.decode())

    def store(self, found: Sequence[Diagnostic]) -> None:
        """Store what was found, unless something has changed meanwhile, so that nobody knows what was checked."""
        path = self._path()
        if path is not None and digest_of(self.library, self.scene) == self.digest:
            cache.store(path, json.render(found, {}).encode())
            cache.delete_oldest(path.parent, _MOST, _MOST // 2)

    def _path(self) -> Path | None:
        folder = cache.cache_folder()
        return folder / "checks" / self.digest if folder else None


def digest_of(library: LibraryFiles, scene: Path | None) -> str:
    """Return the digest of a library as it was read, of a scene to be checked with it, and of all else that counts.

    That is the scenes the library names, models of the user's, what the Python it names takes, the folder from which
    paths are shown, and skillc itself with what is installed beside it.
    """
    digest = hashlib.sha256()
    for part in (*installation(), *_inputs(library, scene)):
        content = part if isinstance(part, bytes) else part.encode("utf-8", "surrogateescape")
        digest.update(b"%d:" % len(content) + content)
    return digest.hexdigest()


def installation() -> Iterator[str]:
    """Yield what tells one state of skillc, Python and the installed packages from another."""
    yield sys.version
    for folder in filter(os.path.isdir, sys.path):
        yield f"{folder} {os.stat(folder).st_mtime_ns}"  # noqa: PTH116
    for package in PACKAGES:
        yield from sorted(_states(import_module(package).__path__[0]))


def scenes_of(library: LibraryFiles) -> Iterator[Path]:
    """Yield the files beside those of a library that its tasks may name as their scenes; some may not be there."""
    for source in (*library.sources, *library.importable.values()):
        for name in _SCENE.findall(source.text):
            yield library.places[source.path].parent / name


def _inputs(library: LibraryFiles, scene: Path | None) -> Iterator[str | bytes]:
    """Yield everything that a check depends on besides skillc."""
    yield from (os.getcwd(), library.name, str(library.root))  # noqa: PTH109
    for source in (*library.sources, *library.importable.values()):
        yield from (source.path, str(library.places[source.path]), source.text)
    for source in library.vocabularies:
        yield from (source.path, source.text)
    for path in (*scenes_of(library), *([scene] if scene else []), *own_models()):
        yield from _file(path)
    yield from _python((*library.sources, *library.importable.values()))


def _file(path: Path) -> Iterator[str | bytes]:
    """Yield a file's content, or that it cannot be read."""
    yield str(path)
    try:
        yield read_file(path)
    except (OSError, ValueError) as error:
        yield type(error).__name__


def _python(sources: Iterable[Source]) -> Iterator[str]:
    """Yield what the Python that is named takes, as far as it is not skillc's own."""
    named = {target for source in sources for target in _PYTHON.findall(source.text)}
    foreign = sorted(target for target in named if target[0].partition(".")[0] not in PACKAGES)
    if not foreign:
        return
    from skillc_compiler.python.targets import read_target

    for module, name in foreign:
        yield from (module, name, repr(read_target(module, name)))


def _states(folder: str) -> Iterator[str]:
    """Yield name, size and time of change of every file below a folder but compiled Python."""
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.name == "__pycache__":
                continue
            if entry.is_dir():
                yield from _states(entry.path)
            else:
                state = entry.stat()
                yield f"{entry.path} {state.st_size} {state.st_mtime_ns}"
