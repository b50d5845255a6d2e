"""Caches the diagnostics of checks; nothing heavy is imported here.

The key of an entry is the digest of everything that it depends on, so an outdated entry is never found.
"""

from __future__ import annotations

import hashlib
import os
import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

from skillc.services.library.files import LibraryFiles
from skillc_dsl import cache as files
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import read_file
from skillc_dsl.rendering import json
from skillc_dsl.source import Source
from skillc_ontology.catalogue import user_models

PACKAGES = (
    *("skillc_dsl", "skillc_ontology", "skillc_rdf", "skillc_model", "skillc_compiler", "skillc_skills"),
    *("skillc_runtime", "skillc"),
)
_SCENE = re.compile(r'scene\s+"([^"\n]+)"')
_PYTHON = re.compile(r'python\s+"([\w.]+):(\w+)"')
_MOST = 500
"""The most entries in the cache; beyond it the older half is deleted."""


class CheckCacheEntry(NamedTuple):
    """The cache entry of a library, checked with `scene` or without; `digest` is its key.

    `around` is the digest of everything but the texts of the library's own files.
    """

    library: LibraryFiles
    scene: Path | None
    around: str
    digest: str

    @staticmethod
    def of(library: LibraryFiles, scene: Path | None) -> CheckCacheEntry:
        """Return the entry for the current state of all inputs."""
        around = compute_digest(library, scene)
        return CheckCacheEntry(library, scene, around, _with_texts(around, library))

    def is_current(self) -> bool:
        """Whether no input has changed since the entry was made."""
        return compute_digest(self.library, self.scene) == self.around

    def load(self) -> tuple[Diagnostic, ...] | None:
        """Return the cached diagnostics, None if there is no entry."""
        path = self._path()
        body = files.load(path) if path else None
        return None if body is None else json.read(body.decode())

    def store(self, found: Sequence[Diagnostic]) -> None:
        """Store diagnostics."""
        path = self._path()
        if path is not None:
            files.store(path, json.render(found, {}).encode())
            files.delete_oldest(path.parent, _MOST, _MOST // 2)

    def _path(self) -> Path | None:
        folder = files.cache_folder()
        return folder / "checks" / self.digest if folder else None


def compute_digest(library: LibraryFiles, scene: Path | None) -> str:
    """Return the digest of everything that a check depends on but the texts of the library's own files.

    That is where these are, what they can import, the scene checked with them, the scenes that tasks name, the user's
    models, what checks read of the Python that it names, the current folder, skillc itself and the installed
    packages.
    """
    return digest_parts((installation_digest(), *_inputs(library, scene)))


def _with_texts(around: str, library: LibraryFiles) -> str:
    return digest_parts((around, *(source.text for source in library.sources)))


def digest_parts(parts: Iterable[str | bytes]) -> str:
    """Return the digest of texts and bytes, which depends on where each ends."""
    digest = hashlib.sha256()
    for part in parts:
        content = part if isinstance(part, bytes) else part.encode("utf-8", "surrogateescape")
        digest.update(b"%d:" % len(content) + content)
    return digest.hexdigest()


@cache
def installation_digest() -> bytes:
    """Return the digest of the state of skillc, Python and the installed packages when this process first looked.

    That is the code that it runs, mostly, whatever is installed meanwhile.
    """
    return hashlib.sha256("\n".join(describe_installation()).encode("utf-8", "surrogateescape")).digest()


def describe_installation() -> Iterator[str]:
    """Yield texts that identify the state of skillc, Python and the installed packages.

    What is read of the Python in projects is part of the inputs of their libraries.
    """
    yield sys.version
    for folder in filter(os.path.isdir, sys.path):
        if os.path.isfile(os.path.join(folder, "skillc.toml")):  # noqa: PTH113, PTH118
            continue
        yield f"{folder} {os.stat(folder).st_mtime_ns}"  # noqa: PTH116
    for package in PACKAGES:
        yield from _states(import_module(package).__path__[0])


def named_scenes(library: LibraryFiles) -> Iterator[Path]:
    """Yield the paths, existing or not, of the scenes that the tasks of a library and its manifest name."""
    for source in (*library.sources, *library.importable.values()):
        for name in _SCENE.findall(source.text):
            yield library.places[source.path].parent / name
    if library.project:
        manifest = library.project.manifest
        for named in (manifest.scene, *(each.scene for each in manifest.tasks.values())):
            if named is not None:
                yield library.project.root / named


def _inputs(library: LibraryFiles, scene: Path | None) -> Iterator[str | bytes]:
    """Yield everything that a check depends on other than the installation and the texts of the library's own files."""
    yield from (os.getcwd(), library.name, str(library.root), library.backend or "")  # noqa: PTH109
    yield from (f"{name} {namespace}" for name, namespace in sorted(library.namespaces.items()))
    if library.project:
        yield library.project.source.text
    for source in library.sources:
        yield from (source.path, str(library.places[source.path]), str(source.edition))
    for source in library.importable.values():
        yield from (source.path, str(library.places[source.path]), str(source.edition), source.text)
    for source in library.vocabularies:
        yield from (source.path, source.text)
    for path in (*named_scenes(library), *([scene] if scene else []), *user_models()):
        yield from _file(path)
    yield from _python((*library.sources, *library.importable.values()))


def _file(path: Path) -> Iterator[str | bytes]:
    """Yield a file's path and content, or the kind of error on reading it."""
    yield str(path)
    try:
        yield read_file(path)
    except (OSError, ValueError) as error:
        yield type(error).__name__


def _python(sources: Iterable[Source]) -> Iterator[str]:
    """Yield what checks read of the Python that the sources name, without that of skillc."""
    named = {target for source in sources for target in _PYTHON.findall(source.text)}
    foreign = sorted(target for target in named if target[0].partition(".")[0] not in PACKAGES)
    if not foreign:
        return
    from skillc_compiler.python.targets import Targets

    targets = Targets()
    yield from digest_modules(module for module, _ in foreign)
    for module, name in foreign:
        yield from (
            module,
            name,
            repr(targets.read(module, name)),
            *sorted(targets.method_returns(module, name, "tick")),
        )


def digest_modules(modules: Iterable[str]) -> Iterator[str]:
    """Yield the path and digest of each file of the packages of Python modules, without importing them."""
    from skillc_compiler.python.modules import Modules

    found = Modules()
    for package in sorted({module.partition(".")[0] for module in modules} - {*PACKAGES}):
        top = found[package].file
        inside = sorted(top.parent.rglob("*.py")) if isinstance(top, Path) and top.name == "__init__.py" else [top]
        for file in inside:
            if isinstance(file, Path):
                yield f"{file} {hashlib.sha256(read_file(file)).hexdigest()}"


def _states(folder: str) -> list[str]:
    """Return path, size and modification time of every file below a folder, without compiled Python, in order."""
    found, folders = [], [folder]
    while folders:
        with os.scandir(folders.pop()) as entries:
            inside = [(each, each.is_dir()) for each in entries]
        folders += [each.path for each, is_folder in inside if is_folder and each.name != "__pycache__"]
        states = ((each.path, each.stat()) for each, is_folder in inside if not is_folder)
        found += [f"{path} {state.st_size} {state.st_mtime_ns}" for path, state in states]
    return sorted(found)
