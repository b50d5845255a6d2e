"""What checks depend on, as digests; nothing heavy is imported here."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import msgspec

from skillc.services.library.answer_store import PACKAGES, digest_parts
from skillc.services.library.files import LibraryFiles
from skillc_dsl.encoding import read_file
from skillc_dsl.source import Source
from skillc_ontology.catalogue import user_models

if TYPE_CHECKING:
    from skillc_runtime.scene.load import LoadedScene

CHECK = "check"
"""The query whose answer is what a check finds."""
_SCENE = re.compile(r'scene\s+"([^"\n]+)"')
_BACKEND = re.compile(r"\bbackend\s+\w")
_PYTHON = re.compile(r'python\s+"([\w.]+):(\w+)"')


class CheckInputs(NamedTuple):
    """Everything that a check of a library depends on, with `scene` or without, as `digest`.

    `around` is the digest of everything but the texts of the library's own files.
    """

    library: LibraryFiles
    scene: Path | None
    around: str
    digest: str

    @staticmethod
    def of(library: LibraryFiles, scene: Path | None) -> CheckInputs:
        """Return the current state of all inputs."""
        around = compute_digest(library, scene)
        return CheckInputs(library, scene, around, _with_texts(around, library))

    def are_current(self) -> bool:
        """Whether no input has changed since."""
        return compute_digest(self.library, self.scene) == self.around


def digest_texts(library: LibraryFiles) -> str:
    """Return the digest of everything that compiling a library depends on, wherever it is and whatever scenes it has.

    That is its texts, what they can import, and what is read of the Python that they name.
    """
    own = (source.text for source in library.sources)
    return digest_parts((*_named_texts(library), *own))


def compute_digest(library: LibraryFiles, scene: Path | None) -> str:
    """Return the digest of everything that a check depends on but the texts of the library's own files.

    That is where these are, what they can import, the scene checked with them, the scenes that tasks name, the user's
    models, the back ends that are installed if tasks name one, what checks read of the Python that it names, and the
    current folder.
    """
    return digest_parts(_inputs(library, scene))


def _with_texts(around: str, library: LibraryFiles) -> str:
    return digest_parts((around, *(source.text for source in library.sources)))


def describe_scene(scene: LoadedScene) -> Iterator[str | bytes]:
    """Yield the terms, statements and models that what is found in a scene depends on."""
    yield encode_meaning(scene.state.vocabulary)
    for each in scene.said:
        yield f"{each.subject} {each.predicate} {each.object}"
    yield from describe_models()


def describe_models() -> Iterator[str | bytes]:
    """Yield the user's models of devices."""
    for model in user_models():
        yield str(model)
        yield model.read_bytes()


def encode_meaning(item: object) -> bytes:
    """Return structs as bytes that do not depend on where they stand in files."""
    return msgspec.json.encode(_without_positions(msgspec.to_builtins(item)), order="deterministic")


def _without_positions(item: object) -> object:
    match item:
        case {"path": str(), "line": int(), "column": int()}:
            return None
        case dict():
            return {name: _without_positions(each) for name, each in item.items()}
        case list() | tuple():
            return [_without_positions(each) for each in item]
        case _:
            return item


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
    """Yield everything that a check depends on but the texts of the library's own files."""
    yield from (os.getcwd(), str(library.root), library.backend or "")  # noqa: PTH109
    if library.project:
        yield library.project.source.text
    for source in (*library.sources, *library.importable.values()):
        yield str(library.places[source.path])
    for path in (*named_scenes(library), *([scene] if scene else []), *user_models()):
        yield from _file(path)
    if any(_BACKEND.search(source.text) for source in library.sources):
        from skillc.services.project.backends import list_backends

        yield from list_backends()
    yield from _named_texts(library)


def _named_texts(library: LibraryFiles) -> Iterator[str]:
    """Yield what a library can import and the names of its own files, with what is read of Python."""
    yield library.name
    yield from (f"{name} {namespace}" for name, namespace in sorted(library.namespaces.items()))
    for source in library.sources:
        yield from (source.path, str(source.edition))
    for source in (*library.importable.values(), *library.vocabularies):
        yield from (source.path, str(source.edition), source.text)
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
