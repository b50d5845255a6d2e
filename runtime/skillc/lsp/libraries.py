"""The libraries of the files that are open in the editor, each understood when somebody asks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote, urlsplit

from pygls.uris import from_fs_path, to_fs_path

from skillc.lsp import files
from skillc.lsp.files import Root
from skillc.lsp.scenes import SceneCache, find_problems
from skillc.services.libraries import vocabulary_with
from skillc_compiler.ide.analysis import Analysis, Library, analyse
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import normalise_text
from skillc_dsl.parsing import parser
from skillc_dsl.source import Source

if TYPE_CHECKING:
    from skillc.services.task_scenes import TaskScenes
    from skillc_compiler.resolve.individuals import Individuals

REMEMBERED_FILES = 1024

parse = lru_cache(REMEMBERED_FILES)(parser.parse)


@dataclass(frozen=True, slots=True)
class View:
    """A file in its library."""

    root: Root
    path: str
    analysis: Analysis


@dataclass
class Libraries:
    """What the editor has open, and what was understood of it; `folders` are the editor's folders."""

    folders: tuple[Path, ...] = ()
    buffers: dict[Path, str] = field(default_factory=dict)
    _uris: dict[Path, str] = field(default_factory=dict)
    _analyses: dict[Root, Analysis] = field(default_factory=dict)
    _sources: dict[Root, dict[str, Source]] = field(default_factory=dict)
    _vocabularies: dict[Root, tuple[Source, ...]] = field(default_factory=dict)
    _scene_cache: SceneCache = field(default_factory=SceneCache)
    _scenes: dict[Root, TaskScenes | None] = field(default_factory=dict)

    def write(self, uri: str, text: str) -> Path:
        """Take a file's text from the editor, and return its path."""
        file = self.file(uri)
        opened = file not in self.buffers
        self.buffers[file] = normalise_text(text)
        if opened or files.is_turtle(file):
            self.forget(file)
            return file
        for root, known in self._sources.items():
            if root.holds(file):
                path = file.relative_to(root.folder).as_posix()
                known[path] = Source(path, self.buffers[file])
                self._analyses.pop(root, None)
        return file

    def close(self, uri: str) -> Path:
        """Take a file's text from the disk again, and return its path."""
        file = self.file(uri)
        self.buffers.pop(file, None)
        self.forget(file)
        return file

    def forget(self, file: Path) -> None:
        """Read the libraries that a file belongs to, or a scene may belong to, again when they are asked for."""
        for root in [root for root in self._sources if root.holds(file) or file.suffix != ".skill"]:
            self._sources.pop(root)
            self._analyses.pop(root, None)

    def file(self, uri: str) -> Path:
        """Return the file of a URI; a text that is no file yet has a path of its own."""
        split = urlsplit(uri)
        name = to_fs_path(uri) if split.scheme == "file" else None
        file = Path(name) if name else Path("/", split.scheme, quote(split.path, safe=""))
        self._uris[file] = uri
        return file

    def uri(self, root: Root, path: str) -> str:
        """Return the URI of a path that a span has, as the editor itself writes it where it has one."""
        file = files.place(path, root)
        return self._uris.get(file) or from_fs_path(str(file)) or ""

    def view(self, uri: str) -> View:
        """Return a file with what is understood of its library now."""
        file = self.file(uri)
        root = files.root_of(file, self.folders)
        return View(root, file.relative_to(root.folder).as_posix(), self.analysis(root))

    def root(self, file: Path) -> Root:
        """Return the library of a file."""
        return files.root_of(file, self.folders)

    def analysis(self, root: Root) -> Analysis:
        """Return what is understood of a library now."""
        if root not in self._analyses:
            self._analyses[root] = self._analyse(root)
        return self._analyses[root]

    def roots(self) -> list[Root]:
        """Return every library that has a file open."""
        return sorted({self.root(file) for file in self.buffers}, key=lambda root: root.folder)

    def known(self) -> Iterator[tuple[Root, Analysis]]:
        """Yield every library that has a file open."""
        for root in self.roots():
            yield root, self.analysis(root)

    def texts(self, root: Root) -> Mapping[str, Source]:
        """Return the texts of a library by path, whether they can be understood or not."""
        return self._sources.get(root) or files.sources(root, self.buffers)

    def open_in(self, root: Root) -> frozenset[str]:
        """Return the URIs of the open files of a library."""
        return frozenset(self._uris[file] for file in self.buffers if self.root(file) == root)

    def problems_of_vocabularies(self, root: Root) -> Iterator[Diagnostic]:
        """Yield what is wrong with the vocabularies that stand in the folder of a library."""
        for problem in vocabulary_with(self._vocabularies.get(root, ())).diagnostics:
            if (root.folder / problem.span.path).is_file():
                yield problem

    def problems_of_scenes(self, root: Root) -> tuple[Diagnostic, ...]:
        """Return what is wrong with the scenes of a library's tasks, and what keeps the tasks from being done there."""
        analysis = self.analysis(root)
        return find_problems(self._scenes[root], analysis)

    def problems_around(self, root: Root) -> tuple[Diagnostic, ...]:
        """Return what is wrong in the vocabularies and scenes of a library."""
        return (*self.problems_of_vocabularies(root), *self.problems_of_scenes(root))

    def _analyse(self, root: Root) -> Analysis:
        """Analyse a library, and once more where the scenes of its tasks have other individuals than the last time."""
        if root not in self._sources:
            self._sources[root] = files.sources(root, self.buffers)
            self._vocabularies[root] = files.vocabularies(root)
        before = _individuals(self._scenes.get(root))
        terms = vocabulary_with(self._vocabularies[root]).value
        library = Library(root.folder.name, dict(self._sources[root]), files.importable(), terms, before)
        found = analyse(library, parse)
        scenes = self._scene_cache.read(found.program, library.vocabulary, root.folder, self.buffers)
        self._scenes[root] = scenes
        now = _individuals(scenes)
        return found if now == before else analyse(replace(library, scenes=now), parse)


def _individuals(scenes: TaskScenes | None) -> Mapping[str, Individuals]:
    return {} if scenes is None else scenes.individuals
