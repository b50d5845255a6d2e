"""Which terms, functions and skills each file declares, and under which IRIs."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from skillc_compiler.program.typed import ReadFile
from skillc_compiler.resolve.names import KINDS, Kind, bare_terms
from skillc_compiler.resolve.near import correction
from skillc_dsl import syntax as s
from skillc_rdf.vocabulary.types import Vocabulary

LIBRARIES = "https://w3id.org/skillc/library/"
TermDeclaration: TypeAlias = s.ClassDeclaration | s.RelationDeclaration | s.PropertyDeclaration
Bare: TypeAlias = dict[Kind, dict[str, tuple[str, ...]]]


@dataclass
class Declared:
    """What one file declares: bare names of terms with their IRIs, functions and skills."""

    terms: dict[Kind, dict[str, str]] = field(default_factory=lambda: {kind: {} for kind in KINDS})
    functions: set[str] = field(default_factory=set)
    skills: set[str] = field(default_factory=set)

    def names(self) -> set[str]:
        """Return every bare name the file declares."""
        return {*self.functions, *self.skills, *(name for table in self.terms.values() for name in table)}


def kind_of(declaration: TermDeclaration) -> Kind:
    """Return what kind of term is declared."""
    match declaration:
        case s.ClassDeclaration():
            return "class"
        case s.RelationDeclaration():
            return "relation"
        case s.PropertyDeclaration():
            return "property"


def namespace(library: str) -> str:
    """Return the namespace of the terms that a library declares."""
    return f"{LIBRARIES}{library}#"


def prefix(library: str, taken: Mapping[str, str]) -> str:
    """Return the prefix for a library's namespace: its name, unless another namespace has that prefix."""
    name = re.sub(r"\W", "_", library)
    return name if taken.get(name, namespace(library)) == namespace(library) else f"{name}_library"


def declare(files: Sequence[ReadFile], vocabulary: Vocabulary) -> dict[str, Declared]:
    """Return by path what each file declares.

    A term whose bare name is visible where it is declared is that term, with something added; else it is new. A
    qualified name says itself which term it is; where there is no such prefix, it counts as a bare one.
    """
    found: dict[str, Declared] = {}
    bare = bare_in(files, vocabulary)
    for unit in files:
        found[unit.file.path] = _declared_in(unit, bare[unit.file.path], found, vocabulary)
    return found


def prefixes_in(file: s.File, vocabulary: Vocabulary) -> dict[str, str]:
    """Return the prefixes that a file can write: those of all vocabularies and its own."""
    return {**vocabulary.prefixes, **{line.name.text: line.iri for line in file.header if isinstance(line, s.Prefix)}}


def bare_in(files: Sequence[ReadFile], vocabulary: Vocabulary) -> dict[str, Bare]:
    """Return by path what bare names mean in each file; it is the same where the same vocabularies are used."""
    uses = {unit.file.path: used(unit.file, vocabulary) for unit in files}
    terms = {prefixes: bare_terms(vocabulary, prefixes) for prefixes in set(uses.values())}
    return {path: terms[prefixes] for path, prefixes in uses.items()}


def used(file: s.File, vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the prefixes of the vocabularies that a file uses; for a misspelt one, the one that is meant."""
    names = (name for line in file.header if isinstance(line, s.Use) for name in line.vocabularies)
    return tuple(
        meant.text
        if name.text not in vocabulary.prefixes and (meant := correction(name, vocabulary.prefixes))
        else name.text
        for name in names
    )


def visible(bare: Bare, imported: Iterable[Declared]) -> Bare:
    """Return what bare names mean when the terms of other files are added."""
    merged: dict[Kind, dict[str, set[str]]] = {kind: defaultdict(set) for kind in KINDS}
    for kind in KINDS:
        for name, iris in bare[kind].items():
            merged[kind][name].update(iris)
        for declared in imported:
            for name, iri in declared.terms[kind].items():
                merged[kind][name].add(iri)
    return {kind: {name: tuple(sorted(iris)) for name, iris in merged[kind].items()} for kind in KINDS}


def _declared_in(unit: ReadFile, bare: Bare, others: Mapping[str, Declared], vocabulary: Vocabulary) -> Declared:
    known = visible(bare, (others[path] for _, path in unit.imports if path in others))
    prefixes = prefixes_in(unit.file, vocabulary)
    declared = Declared()
    for declaration in unit.file.declarations:
        match declaration:
            case s.ClassDeclaration() | s.RelationDeclaration() | s.PropertyDeclaration():
                kind, name = kind_of(declaration), declaration.name.text
                before, _, local = name.rpartition(":")
                if before in prefixes:
                    iri = prefixes[before] + local
                    declared.terms[kind][name] = vocabulary.aliases.get(iri, iri)
                else:
                    existing = known[kind].get(local, ())
                    iri = existing[0] if existing else namespace(unit.library) + local
                    declared.terms[kind] |= {name: iri, local: iri}
            case s.FunctionDeclaration():
                declared.functions.add(declaration.name.text)
            case s.SkillDeclaration():
                declared.skills.add(declaration.name.text)
            case _:
                pass
    return declared
