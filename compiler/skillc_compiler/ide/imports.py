"""What a file does not see yet, and the edits of its header that make it visible."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Iterator, Mapping
from functools import cache

import msgspec

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.symbols import TermSymbol
from skillc_compiler.resolve.names import KINDS, Kind
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Fix
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import Vocabulary, local_name, namespace_of

STANDARD_LIBRARY = "std/"


class HiddenTerm(msgspec.Struct, frozen=True):
    """A term that a file does not see: how it is written once the file `imports` another or `uses` a vocabulary.

    Without both it is written with its prefix, since the bare names of its vocabulary would make others ambiguous.
    """

    written: str
    iri: str
    imports: str = ""
    uses: str = ""


def find_importable(analysis: Analysis, path: str) -> Iterator[tuple[s.SkillDeclaration | s.FunctionDeclaration, str]]:
    """Yield the skills and functions that are not visible in a file, each with the file to import.

    Those of the library come first, then those of `std` and of other libraries.
    """
    visible = analysis.visible.get(path)
    seen = {*visible.skills, *visible.functions} if visible else set()
    for file, imported in _files(analysis, path).items():
        for each in imported.declarations:
            if isinstance(each, s.SkillDeclaration | s.FunctionDeclaration) and each.name.text not in seen:
                seen.add(each.name.text)
                yield each, file


def find_hidden_terms(analysis: Analysis, path: str, kind: Kind) -> Iterator[HiddenTerm]:
    """Yield the terms of other files of the library and of vocabularies that a file does not see."""
    vocabulary, visible = analysis.program.vocabulary, analysis.visible[path]
    later = analysis.library.vocabulary.later_than(analysis.edition(path))
    prefixes = {base: prefix for prefix, base in analysis.library.vocabulary.prefixes.items()}
    collides = cache(lambda base: _collides(analysis, path, base))
    for iri in _terms(vocabulary, kind):
        name, base = local_name(iri), namespace_of(iri)
        if name in visible.bare[kind] or iri in later:
            continue
        homes = [each.span.path for each in analysis.index.declarations(TermSymbol(kind, iri))]
        if homes:
            yield HiddenTerm(name, iri, imports=_relative(homes[0], path))
        elif base in prefixes and collides(base):
            yield HiddenTerm(f"{prefixes[base]}:{name}", iri)
        elif base in prefixes:
            yield HiddenTerm(name, iri, uses=prefixes[base])


def make_import(analysis: Analysis, path: str, file: str) -> Fix:
    """Return the edit that adds an `import` line at the end of the header."""
    header = _header(analysis, path)
    line = header[-1].span.end_line + 1 if header else 1
    return Fix(Span(path, line, 1, line, 1), f'import "{file}"\n', f"import {file}")


def make_use(analysis: Analysis, path: str, prefix: str) -> Fix:
    """Return the edit that adds a vocabulary to the last `use` line, or adds such a line at the top."""
    used = [line.vocabularies[-1].span for line in _header(analysis, path) if isinstance(line, s.Use)]
    if not used:
        return Fix(Span(path, 1, 1, 1, 1), f"use {prefix}\n", f"use {prefix}")
    end = used[-1]
    return Fix(Span(path, end.end_line, end.end_column, end.end_line, end.end_column), f", {prefix}", f"use {prefix}")


def _header(analysis: Analysis, path: str) -> tuple[s.Use | s.Prefix | s.Import, ...]:
    return next((unit.file.header for unit in analysis.program.files if unit.file.path == path), ())


def _collides(analysis: Analysis, path: str, base: str) -> bool:
    """Whether a name that is written in a file would be ambiguous if the vocabulary with a namespace were used."""
    words = set(re.findall(r"\w+", analysis.texts.get(path, "")))
    for kind in KINDS:
        bare = analysis.visible[path].bare[kind]
        added = {local_name(iri) for iri in _terms(analysis.library.vocabulary, kind) if iri.startswith(base)}
        if any(name in words and name in bare for name in added):
            return True
    return False


def _terms(vocabulary: Vocabulary, kind: Kind) -> Iterator[str]:
    tables: Mapping[Kind, Collection[str]] = {
        "class": vocabulary.classes,
        "relation": vocabulary.relations,
        "property": vocabulary.properties,
    }
    return iter(tables[kind])


def _relative(file: str, path: str) -> str:
    return posixpath.relpath(file, posixpath.dirname(path) or ".")


def _files(analysis: Analysis, path: str) -> Mapping[str, s.File]:
    """Return the importable files by the text of their `import`, those of the library first."""
    own = {
        _relative(unit.file.path, path): unit.file
        for unit in analysis.program.files
        if unit.file.path in analysis.library.sources and unit.file.path != path
    }
    shipped = analysis.library.importable.items()
    standard_first = sorted(shipped, key=lambda item: not item[1].path.startswith(STANDARD_LIBRARY))
    return {**own, **{name: analysis.parsed_by(text).value for name, text in standard_first if name not in own}}
