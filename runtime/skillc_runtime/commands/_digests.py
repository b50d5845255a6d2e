"""Digests of everything that a check depends on: what has the same digest has the same problems."""

from __future__ import annotations

import hashlib
import os
import re
import sys
from collections.abc import Iterable, Iterator
from importlib import import_module
from pathlib import Path

from skillc_dsl.encoding import read_file
from skillc_dsl.source import Source
from skillc_ontology.catalogue import own_models
from skillc_runtime.commands._files import LibraryFiles

PACKAGES = ("skillc_dsl", "skillc_ontology", "skillc_compiler", "skillc_runtime", "skillc_skills")
_SCENE = re.compile(r'\bscene\s+"([^"\n]+)"')
_PYTHON = re.compile(r'\bpython\s+"([\w.]+):(\w+)"')


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
    for source in (*library.sources, *library.shelf.values()):
        for name in _SCENE.findall(source.text):
            yield library.places[source.path].parent / name


def _inputs(library: LibraryFiles, scene: Path | None) -> Iterator[str | bytes]:
    """Yield everything that a verdict depends on besides skillc."""
    yield from (os.getcwd(), library.name, str(library.root))  # noqa: PTH109
    for source in (*library.sources, *library.shelf.values()):
        yield from (source.path, str(library.places[source.path]), source.text)
    for source in library.vocabularies:
        yield from (source.path, source.text)
    for path in (*scenes_of(library), *([scene] if scene else []), *own_models()):
        yield from _file(path)
    yield from _python((*library.sources, *library.shelf.values()))


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
    from skillc_compiler.python.reading import read

    for module, name in foreign:
        yield from (module, name, repr(read(module, name)))


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
