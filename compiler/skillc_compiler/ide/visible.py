"""The names visible in one file, and what they refer to."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import msgspec

from skillc_compiler.program.program import ParsedFile, Program
from skillc_compiler.resolve.declaring.declarations import (
    Bare,
    FileDeclarations,
    bare_names_in,
    collect_declarations,
    merge_imported,
    prefixes_in,
)
from skillc_compiler.resolve.names import Kind
from skillc_dsl.query import Memo
from skillc_rdf.vocabulary.types import Vocabulary


class VisibleNames(msgspec.Struct, frozen=True):
    """The names visible in a file: bare names of terms with their IRIs, prefixes with namespaces, functions, skills."""

    bare: Bare
    prefixes: Mapping[str, str]
    functions: frozenset[str]
    skills: frozenset[str]
    vocabulary: Vocabulary

    def term(self, kind: Kind, text: str) -> str | None:
        """Return the IRI of the term that a bare or qualified name refers to, the first one if it is ambiguous."""
        if ":" not in text:
            return next(iter(self.bare[kind].get(text, ())), None)
        iri = self.iri(text)
        tables: Mapping[Kind, Collection[str]] = {
            "class": self.vocabulary.classes,
            "relation": self.vocabulary.relations,
            "property": self.vocabulary.properties,
        }
        return iri if iri in tables[kind] else None

    def read_term(self, text: str) -> str | None:
        """Return the IRI of what a name after a `.` or a `has` refers to: a property, or a functional relation."""
        return self.term("property", text) or self.term("relation", text)

    def iri(self, qualified: str) -> str | None:
        """Return the IRI of `prefix:name`, or None for an unknown prefix."""
        prefix, _, local = qualified.partition(":")
        if prefix not in self.prefixes:
            return None
        iri = self.prefixes[prefix] + local
        return self.vocabulary.aliases.get(iri, iri)

    def written(self, iri: str) -> str | None:
        """Return `prefix:name` for an IRI, or None if no prefix matches."""
        fitting = [(len(base), prefix) for prefix, base in self.prefixes.items() if iri.startswith(base)]
        return f"{max(fitting)[1]}:{iri[max(fitting)[0] :]}" if fitting else None


def find_visible(program: Program, base: Vocabulary) -> dict[str, VisibleNames]:
    """Return the visible names of each file by path; `base` is the vocabulary without the program's own terms."""
    bare = bare_names_in(program.files, base, Memo())
    declared = collect_declarations(program.files, base, bare)
    return {
        unit.file.path: _visible(unit, declared, bare[unit.file.path], program.vocabulary, base)
        for unit in program.files
    }


def _visible(
    unit: ParsedFile, declared: Mapping[str, FileDeclarations], bare: Bare, whole: Vocabulary, base: Vocabulary
) -> VisibleNames:
    here = [declared[unit.file.path], *(declared[path] for _, path in unit.imports if path in declared)]
    return VisibleNames(
        bare=merge_imported(bare, here, base.later_than(unit.edition)),
        prefixes=prefixes_in(unit.file, base),
        functions=frozenset(name for there in here for name in there.functions),
        skills=frozenset(name for there in here for name in there.skills),
        vocabulary=whole,
    )
