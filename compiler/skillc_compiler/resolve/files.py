"""Reads a library: its files, and the importable files that they import, each after its own imports."""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TypeAlias

from skillc_compiler.program.program import ParsedFile
from skillc_compiler.program.spelling import suggest_fix
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source
from skillc_dsl.spelling import did_you_mean

STANDARD_LIBRARY = "std"
LIBRARY_NAMESPACE = "https://w3id.org/skillc/library/"
NO_NAMESPACES: Mapping[str, str] = MappingProxyType({})
Parser: TypeAlias = Callable[[Source], Outcome[s.File]]


def read_sources(
    sources: Sequence[Source],
    importable: Mapping[str, Source],
    name: str,
    parsed_by: Parser = parse,
    namespaces: Mapping[str, str] = NO_NAMESPACES,
) -> Outcome[tuple[ParsedFile, ...]]:
    """Parse the sources and what they import; `importable` is keyed by file name, `name` is the library's.

    `namespaces` are those of the terms that libraries declare, by the name of the library, where they are not the
    usual ones. Importable files belong to the library whose name their path begins with, `std` or one of these, else
    to this one. `parsed_by` is the parser, which may cache its results.
    """
    reader = _Reader({source.path: source for source in sources}, importable, name, parsed_by, namespaces)
    for path in sorted(reader.own):
        reader.read(reader.own[path], name, ())
    return Outcome(tuple(reader.files.values()), tuple(reader.problems))


def library_namespace(library: str) -> str:
    """Return the usual namespace of the terms that a library declares."""
    return f"{LIBRARY_NAMESPACE}{library}#"


@dataclass
class _Reader:
    own: Mapping[str, Source]
    importable: Mapping[str, Source]
    name: str
    parse: Parser
    namespaces: Mapping[str, str]
    files: dict[str, ParsedFile] = field(default_factory=dict)
    problems: list[Diagnostic] = field(default_factory=list)

    def read(self, source: Source, library: str, importing: tuple[str, ...]) -> None:
        """Read a file after the files that it imports; `importing` is the chain of files that led here."""
        if source.path in self.files:
            return
        parsed = self.parse(source)
        self.problems.extend(parsed.diagnostics)
        imports = tuple(self._imports(parsed.value, library, (*importing, source.path)))
        namespace = self.namespaces.get(library) or library_namespace(library)
        self.files[source.path] = ParsedFile(parsed.value, library, namespace, source.text, imports, source.edition)

    def _imports(self, file: s.File, library: str, chain: tuple[str, ...]) -> Iterable[tuple[s.Import, str]]:
        for line in (h for h in file.header if isinstance(h, s.Import)):
            found = self._find(file.path, line.path.value, library) or self._meant(file, line, library)
            if found is None:
                continue
            if found[0].path in chain:
                self._cycle(line, chain[chain.index(found[0].path) :])
            else:
                self.read(*found, chain)
                yield line, found[0].path

    def _find(self, importer: str, wanted: str, library: str) -> tuple[Source, str] | None:
        relative = posixpath.normpath(posixpath.join(posixpath.dirname(importer), wanted))
        if importer not in self.own and posixpath.dirname(importer) and relative in self.importable:
            return self._importable(relative)  # files of another library import their neighbours there
        if library == self.name and relative in self.own:
            return self.own[relative], library
        return self._importable(wanted) if wanted in self.importable else None

    def _importable(self, wanted: str) -> tuple[Source, str]:
        found = self.importable[wanted]
        first, inside, _ = found.path.partition("/")
        return found, first if inside and first in {STANDARD_LIBRARY, *self.namespaces} else self.name

    def _meant(self, file: s.File, line: s.Import, library: str) -> tuple[Source, str] | None:
        """Report a missing file; return the one that is meant, if its name is close to that of one file only."""
        folder = posixpath.dirname(file.path)
        relative = [posixpath.relpath(p, folder or ".") for p in self.own] if library == self.name else []
        own = [name for name in relative if name != posixpath.basename(file.path)]
        candidates = [*own, *(name for name in self.importable if name != posixpath.basename(file.path))]
        wrong = line.path.value
        near = suggest_fix(s.Name(wrong, line.path.span), candidates)
        self.problems.append(
            Diagnostic(
                "unknown-import",
                line.path.span,
                f'there is no file "{wrong}" in {self._searched()}',
                help=did_you_mean(wrong, candidates)
                or did_you_mean(wrong, own)
                or "correct its name, or write the file",
                fix=near and near._replace(text=f'"{near.text}"'),
            )
        )
        return self._find(file.path, near.text, library) if near else None

    def _searched(self) -> str:
        """Return where imports are looked up."""
        others = sorted(self.namespaces.keys() - {self.name})
        return (
            f"this library, in `std`, or in {', '.join(f'`{name}`' for name in others)}"
            if others
            else ("this library or in `std`")
        )

    def _cycle(self, line: s.Import, chain: Sequence[str]) -> None:
        way = " imports ".join((*chain, chain[0]))
        self.problems.append(
            Diagnostic(
                "import-cycle",
                line.path.span,
                f"the imports form a cycle: {way}",
                help="move what both files need into a third file and import that from both",
            )
        )
