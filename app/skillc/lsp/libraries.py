"""The libraries of the files that are open in the editor, analysed lazily."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote, urlsplit

from pygls.uris import from_fs_path, to_fs_path

from skillc.lsp import files
from skillc.lsp.files import Root
from skillc.lsp.project_texts import read_names
from skillc.lsp.scenes import find_choices, find_problems, read_scenes, read_text
from skillc.services.library.files import LibraryFiles, edition_of
from skillc.services.library.libraries import load_vocabulary_with
from skillc.services.project.project import MANIFEST
from skillc_compiler.ide.analysis import Analysis, AnalysisInput, analyse
from skillc_compiler.ide.annotations.hints import Choices
from skillc_compiler.ide.project_names import ProjectNames
from skillc_compiler.resolve.files import Parser
from skillc_dsl.diagnostics import Diagnostic, Fix, Outcome
from skillc_dsl.edits import apply_fixes
from skillc_dsl.encoding import normalise_text
from skillc_dsl.parsing.reparse import parse_with
from skillc_dsl.query import Memo
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.conflicts import judge_conflicts

if TYPE_CHECKING:
    from skillc.services.tasks.scenes import TaskScenes
    from skillc_compiler.resolve.individuals import Individuals


@dataclass(frozen=True, slots=True)
class FileView:
    """A file in its library."""

    root: Root
    path: str
    analysis: Analysis


@dataclass
class Libraries:
    """The open files (`buffers`) and folders of the editor, with cached analyses of their libraries."""

    folders: tuple[Path, ...] = ()
    buffers: dict[Path, str] = field(default_factory=dict)
    _uris: dict[Path, str] = field(default_factory=dict)
    _analyses: dict[Root, Analysis] = field(default_factory=dict)
    _memos: dict[Root, Memo] = field(default_factory=dict)
    _sources: dict[Root, dict[str, Source]] = field(default_factory=dict)
    _vocabularies: dict[Root, tuple[Source, ...]] = field(default_factory=dict)
    _surroundings: dict[Root, Outcome[LibraryFiles]] = field(default_factory=dict)
    _scenes: dict[Root, TaskScenes | None] = field(default_factory=dict)

    def write(self, uri: str, text: str) -> Path:
        """Store the editor's text of a file, and return its path."""
        file = self.file(uri)
        opened = file not in self.buffers
        self.buffers[file] = normalise_text(text)
        if opened:
            self.forget(file)
            return file
        if files.is_rdf(file):
            self._analyses.clear()
            return file
        for root, known in self._sources.items():
            if root.holds(file):
                path = file.relative_to(root.folder).as_posix()
                known[path] = files.read_source(file, path, self.buffers, self._edition(root))
                self._analyses.pop(root, None)
        return file

    def close(self, uri: str) -> Path:
        """Use a file's text on disk again, and return its path."""
        file = self.file(uri)
        self.buffers.pop(file, None)
        self.forget(file)
        return file

    def forget(self, file: Path) -> None:
        """Discard what is cached of the libraries that a file belongs to, or that a scene may belong to."""
        for root in [root for root in self._sources if root.holds(file) or file.suffix != ".skill"]:
            self._sources.pop(root)
            self._analyses.pop(root, None)
            self._surroundings.pop(root, None)

    def file(self, uri: str) -> Path:
        """Return the path of a URI; an unsaved text gets a path of its own."""
        split = urlsplit(uri)
        name = to_fs_path(uri) if split.scheme == "file" else None
        file = Path(name) if name else Path("/", split.scheme, quote(split.path, safe=""))
        self._uris[file] = uri
        return file

    def uri(self, root: Root, path: str) -> str:
        """Return the URI of a span's path, as the editor writes it if the editor has sent it."""
        file = self.find_file(root, path)
        return self._uris.get(file) or from_fs_path(str(file)) or ""

    def find_file(self, root: Root, path: str) -> Path:
        """Return the file of a span's path."""
        if path in self._sources.get(root, ()):
            return root.folder / path
        return files.find_file(path, root, self._around(root).value.places)

    def view(self, uri: str) -> FileView:
        """Return a file with the current analysis of its library."""
        file = self.file(uri)
        root = files.find_root(file, self.folders)
        return FileView(root, file.relative_to(root.folder).as_posix(), self.analysis(root))

    def root(self, file: Path) -> Root:
        """Return the library of a file."""
        return files.find_root(file, self.folders)

    def analysis(self, root: Root) -> Analysis:
        """Return the current analysis of a library."""
        if root not in self._analyses:
            self._analyses[root] = self._analyse(root)
        return self._analyses[root]

    def roots(self) -> list[Root]:
        """Return the roots of all libraries with open files."""
        return sorted({self.root(file) for file in self.buffers}, key=lambda root: root.folder)

    def known(self) -> Iterator[tuple[Root, Analysis]]:
        """Yield the root and analysis of each library with open files."""
        for root in self.roots():
            yield root, self.analysis(root)

    def texts(self, root: Root) -> Mapping[str, Source]:
        """Return the texts of a library by path, without analysing them."""
        return self._sources.get(root) or files.read_sources(root, self.buffers, self._edition(root))

    def parser(self, root: Root) -> Parser:
        """Return the parser of a library's files, which knows their last texts."""
        return partial(parse_with, self._memos.setdefault(root, Memo()))

    def open_in(self, root: Root) -> frozenset[str]:
        """Return the URIs of the open files of a library."""
        return frozenset(self._uris[file] for file in self.buffers if self.root(file) == root)

    def problems_of_vocabularies(self, root: Root) -> Iterator[Diagnostic]:
        """Yield the diagnostics of the vocabularies in a library's folder."""
        found = load_vocabulary_with(self._vocabularies.get(root, ())).diagnostics
        program = self.analysis(root).program
        for problem in judge_conflicts(found, program.vocabulary, program.terms):
            if (root.folder / problem.span.path).is_file():
                yield problem

    def problems_of_scenes(self, root: Root) -> tuple[Diagnostic, ...]:
        """Return the diagnostics of the scenes of a library's tasks, and of the tasks in them."""
        analysis = self.analysis(root)
        return find_problems(self._scenes[root], analysis, self._memos[root])

    def problems_around(self, root: Root) -> tuple[Diagnostic, ...]:
        """Return the diagnostics of the vocabularies and scenes of a library."""
        of_scenes = self.problems_of_scenes(root)
        return (*self.problems_of_vocabularies(root), *of_scenes, *self._around(root).diagnostics)

    def choices(self, view: FileView, lines: range) -> Choices:
        """Return how the calls in the tasks and tests of some lines of a file go in their scenes."""
        return find_choices(self._scenes[view.root], view.analysis, view.path, lines)

    def names(self, file: Path) -> tuple[Root, ProjectNames]:
        """Return the library that a file belongs to, with the names in all texts of its project.

        That of a scene without skills beside or above it is the first open one whose folder it is in.
        """
        root = self.root(file)
        if files.is_rdf(file) and not self.texts(root):
            root = next((each for each in self.roots() if each.folder in file.parents), root)
        analysis = self.analysis(root)
        return root, read_names(analysis, root, self._around(root).value, self._scenes[root], self.buffers)

    def after(self, root: Root, edits: Iterable[Fix]) -> Iterator[Diagnostic]:
        """Yield the diagnostics of a library after edits of its files but the manifest, and those around it."""
        changed = Libraries(self.folders, dict(self.buffers))
        for path, group in groupby(sorted(edits, key=lambda each: each.span.path), key=lambda each: each.span.path):
            file = self.find_file(root, path)
            if file.name != MANIFEST:
                changed.buffers[file] = apply_fixes(read_text(file, self.buffers), group)
        yield from changed.problems(root)

    def problems(self, root: Root) -> tuple[Diagnostic, ...]:
        """Return the diagnostics of a library, and those around it."""
        return (*self.analysis(root).problems, *self.problems_around(root))

    def is_symbolic(self, root: Root) -> Callable[[str | None], bool]:
        """Return whether tasks of a library run in cells without bodies that name a back end, or none."""
        return self._around(root).value.is_symbolic

    def _around(self, root: Root) -> Outcome[LibraryFiles]:
        """Return what a library may import, with the diagnostics of its manifest."""
        if root not in self._surroundings:
            self._surroundings[root] = files.read_surroundings(root)
        return self._surroundings[root]

    def _edition(self, root: Root) -> int:
        """Return the edition that a library is written in."""
        return edition_of(root.folder, self._around(root).value.project)

    def _analyse(self, root: Root) -> Analysis:
        """Analyse a library; again if the individuals in its tasks' scenes have changed since the last analysis."""
        if root not in self._sources:
            self._sources[root] = files.read_sources(root, self.buffers, self._edition(root))
            self._vocabularies[root] = files.read_own_vocabularies(root, self._around(root).value, self.buffers)
        before = _individuals(self._scenes.get(root))
        terms = load_vocabulary_with(self._vocabularies[root]).value
        around = self._around(root).value
        sources = dict(self._sources[root])
        library = AnalysisInput(around.name, sources, around.importable, terms, before, around.namespaces)
        memo = self._memos.setdefault(root, Memo())
        parse = self.parser(root)
        found = analyse(library, parse, memo)
        scenes = read_scenes(found.program, library.vocabulary, around, root.folder, self.buffers, memo)
        self._scenes[root] = scenes
        now = _individuals(scenes)
        return found if now == before else analyse(replace(library, scenes=now), parse, memo)


def _individuals(scenes: TaskScenes | None) -> Mapping[str, Individuals]:
    return {} if scenes is None else scenes.individuals
