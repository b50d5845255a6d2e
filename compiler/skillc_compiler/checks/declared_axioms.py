"""Axioms of declared terms that no individual can satisfy."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_rdf.vocabulary.types import Vocabulary, local_name

NAMES = ("impossible-class", "class-cycle", "impossible-relation")
NEEDS = Need.TEXT
READS = Reads.NEIGHBOURS


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield the problems of the terms that the library declares."""
    reported: set[frozenset[str]] = set()
    for unit in program.files:
        for declaration in unit.file.declarations:
            match declaration:
                case s.ClassDeclaration():
                    iri = _iri(program, unit.namespace, declaration.name.text)
                    yield from _class(program.vocabulary, declaration, iri, reported)
                case s.RelationDeclaration(traits=traits):
                    yield from _relation(declaration, {trait.kind: trait for trait in traits})
                case _:
                    pass


def _iri(program: Program, namespace: str, name: str) -> str:
    """Return the IRI of a declared class: of the library, or of the vocabulary whose class is extended."""
    before, _, local = name.rpartition(":")
    if before:
        iri = program.vocabulary.prefixes.get(before, "") + local
        return program.vocabulary.aliases.get(iri, iri)
    own = namespace + name
    return (
        own
        if own in program.vocabulary.classes
        else next((iri for iri in sorted(program.vocabulary.classes) if local_name(iri) == name), own)
    )


def _class(
    vocabulary: Vocabulary, declaration: s.ClassDeclaration, iri: str, reported: set[frozenset[str]]
) -> Iterator[Diagnostic]:
    above = vocabulary.ancestors.get(iri, frozenset())
    cycle = frozenset(other for other in above if other != iri and vocabulary.is_a(other, iri))
    if cycle or (iri in vocabulary.classes and iri in vocabulary.classes[iri].parents):
        if cycle | {iri} not in reported:
            reported.add(cycle | {iri})
            chain = "".join(f", by `{local_name(other)}`" for other in sorted(cycle))
            message = f"`{declaration.name.text}` is declared below itself{chain}"
            yield Diagnostic("class-cycle", declaration.name.span, message, "remove one of the parents")
        return
    for one, other in combinations(declaration.parents, 2):
        pair = [_parent(vocabulary, iri, name.text) for name in (one, other)]
        if all(pair) and vocabulary.disjoint(pair[0], pair[1]):
            message = f"nothing can be `{declaration.name.text}`: nothing is both `{one.text}` and `{other.text}`"
            labels = (Label(one.span, "the other one"),)
            help_ = "remove one of the two parents"
            yield Diagnostic("impossible-class", other.span, message, help_, labels=labels)


def _parent(vocabulary: Vocabulary, iri: str, name: str) -> str:
    term = vocabulary.classes.get(iri)
    local = name.rpartition(":")[2]
    return next((parent for parent in (term.parents if term else ()) if local_name(parent) == local), "")


def _relation(declaration: s.RelationDeclaration, traits: dict[str, s.Trait]) -> Iterator[Diagnostic]:
    if {"transitive", "functional"} <= traits.keys():
        yield Diagnostic(
            "impossible-relation",
            declaration.name.span,
            f"`{declaration.name.text}` cannot be both transitive and functional",
            help="remove one of the two, or declare a transitive relation above a functional one: `sub RELATION`",
            labels=tuple(Label(traits[kind].span, "this") for kind in ("transitive", "functional")),
        )
