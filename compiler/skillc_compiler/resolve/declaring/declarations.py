"""The terms, functions and skills that each file declares, and their IRIs."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import partial
from typing import TypeAlias

from skillc_compiler.program.program import ParsedFile
from skillc_compiler.program.spelling import suggest_fix
from skillc_compiler.resolve.names import KINDS, Kind, bare_terms
from skillc_compiler.resolve.type_names import BUILT_IN, is_built_in
from skillc_dsl import syntax as s
from skillc_dsl.query import Memo
from skillc_rdf.vocabulary.types import Vocabulary

TermDeclaration: TypeAlias = s.ClassDeclaration | s.RelationDeclaration | s.PropertyDeclaration
Bare: TypeAlias = dict[Kind, dict[str, tuple[str, ...]]]


@dataclass
class FileDeclarations:
    """The declarations of one file: bare names of terms with their IRIs, functions and skills."""

    terms: dict[Kind, dict[str, str]] = field(default_factory=lambda: {kind: {} for kind in KINDS})
    functions: set[str] = field(default_factory=set)
    skills: set[str] = field(default_factory=set)
    hidden: set[str] = field(default_factory=set)
    """The terms of vocabularies before which terms of the file go, as they have their names and cannot extend them."""

    def names(self) -> set[str]:
        """Return every bare name that the file declares."""
        return {*self.functions, *self.skills, *(name for table in self.terms.values() for name in table)}


def term_kind(declaration: TermDeclaration, is_class: Callable[[str], bool]) -> Kind:
    """Return the kind of a declared term: a property whose type is a class is a functional relation."""
    match declaration:
        case s.ClassDeclaration():
            return "class"
        case s.RelationDeclaration():
            return "relation"
        case s.PropertyDeclaration(type=s.Name(text=text)) if is_class(text) and not is_built_in(text, True):
            return "relation"
        case s.PropertyDeclaration():
            return "property"


def library_prefix(library: str, namespace: str, taken: Mapping[str, str]) -> str:
    """Return the prefix of a library's namespace: its name, unless another namespace has that prefix."""
    name = re.sub(r"\W", "_", library)
    return name if taken.get(name, namespace) == namespace else f"{name}_library"


def collect_declarations(
    files: Sequence[ParsedFile], vocabulary: Vocabulary, bare: Mapping[str, Bare]
) -> dict[str, FileDeclarations]:
    """Return the declarations of each file, by path; `bare` are the terms of the vocabulary that bare names denote.

    A term whose bare name is visible where it is declared is that term, with additions; otherwise, or if it cannot be
    added to that term, it is new. A qualified name determines the term; if its prefix is unknown, it counts as a bare
    name.
    """
    found: dict[str, FileDeclarations] = {}
    for unit in files:
        found[unit.file.path] = _declarations_in(unit, bare[unit.file.path], found, vocabulary)
    return found


def prefixes_in(file: s.File, vocabulary: Vocabulary) -> dict[str, str]:
    """Return the prefixes that a file can use: those of all vocabularies and its own."""
    return {**vocabulary.prefixes, **{line.name.text: line.iri for line in file.header if isinstance(line, s.Prefix)}}


def bare_names_in(files: Sequence[ParsedFile], vocabulary: Vocabulary, memo: Memo) -> dict[str, Bare]:
    """Return, by path, the terms that bare names denote; files with the same vocabularies and edition share them."""
    uses = {unit.file.path: (used_vocabularies(unit.file, vocabulary), unit.edition) for unit in files}
    return {
        path: memo.ask("bare names", (vocabulary,), partial(bare_terms, vocabulary, *used), name=used)
        for path, used in uses.items()
    }


def used_vocabularies(file: s.File, vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the prefixes of the vocabularies that a file uses; a misspelt one is corrected."""
    names = (name for line in file.header if isinstance(line, s.Use) for name in line.vocabularies)
    return tuple(
        meant.text
        if name.text not in vocabulary.prefixes and (meant := suggest_fix(name, vocabulary.prefixes))
        else name.text
        for name in names
    )


def merge_imported(bare: Bare, imported: Iterable[FileDeclarations], later: Set[str] = frozenset()) -> Bare:
    """Return the terms that bare names denote when those of other files are added, which go before `later` terms."""
    added = [declared for declared in imported if any(declared.terms.values())]
    hidden = later | {iri for declared in added for iri in declared.hidden}
    return {kind: _merge(bare[kind], [each.terms[kind] for each in added], hidden) for kind in KINDS} if added else bare


def cannot_extend(written: TermDeclaration, iri: str, vocabulary: Vocabulary) -> bool:
    """Whether a declaration is certainly not an addition to this term of a vocabulary.

    It is none if it has another type, if its values are listed, or if it is defined by a condition.
    """
    match written:
        case s.ClassDeclaration(values=values):
            return bool(values) and iri in vocabulary.classes and iri not in vocabulary.enumerations
        case s.RelationDeclaration(definition=definition):
            return definition is not None and iri in vocabulary.relations
        case s.PropertyDeclaration(type=s.Name(text=text)) if iri in vocabulary.properties:
            return BUILT_IN.get(text, vocabulary.properties[iri].type) != vocabulary.properties[iri].type
        case s.PropertyDeclaration():
            return False


def _merge(
    bare: Mapping[str, tuple[str, ...]], added: Sequence[Mapping[str, str]], later: Set[str]
) -> dict[str, tuple[str, ...]]:
    new: dict[str, set[str]] = defaultdict(set)
    for terms in added:
        for name, iri in terms.items():
            new[name].add(iri)
    known = {name: [iri for iri in bare.get(name, ()) if iri not in later] for name in new}
    return {**bare, **{name: tuple(sorted({*known[name], *iris})) for name, iris in new.items()}}


def _declarations_in(
    unit: ParsedFile, bare: Bare, others: Mapping[str, FileDeclarations], vocabulary: Vocabulary
) -> FileDeclarations:
    later = vocabulary.later_than(unit.edition)
    known = merge_imported(bare, (others[path] for _, path in unit.imports if path in others), later)
    prefixes = prefixes_in(unit.file, vocabulary)
    declared = FileDeclarations()
    classes = {each.name.text for each in unit.file.declarations if isinstance(each, s.ClassDeclaration)}

    def is_class(text: str) -> bool:
        before, _, local = text.rpartition(":")
        return (
            text in classes
            or (prefixes[before] + local in vocabulary.classes if before in prefixes else False)
            or (text in known["class"])
        )

    for declaration in unit.file.declarations:
        match declaration:
            case s.ClassDeclaration() | s.RelationDeclaration() | s.PropertyDeclaration():
                kind, name = term_kind(declaration, is_class), declaration.name.text
                before, _, local = name.rpartition(":")
                if before in prefixes:
                    iri = prefixes[before] + local
                    declared.terms[kind][name] = vocabulary.aliases.get(iri, iri)
                else:
                    visible = {iri for iri in known[kind].get(local, ()) if iri not in later}
                    foreign = {iri for iri in visible if cannot_extend(declaration, iri, vocabulary)}
                    declared.hidden |= foreign
                    iri = min(visible - foreign, default=unit.namespace + local)
                    declared.terms[kind] |= {name: iri, local: iri}
            case s.FunctionDeclaration():
                declared.functions.add(declaration.name.text)
            case s.SkillDeclaration():
                declared.skills.add(declaration.name.text)
            case _:
                pass
    return declared
