"""What is said of terms that are declared although a vocabulary, or another declaration, has a term of their name."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.program import ParsedFile
from skillc_compiler.program.types import describe_type, type_of
from skillc_compiler.resolve.declaring.declarations import FileDeclarations, term_kind
from skillc_compiler.resolve.names import Kind, Names
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import ClassTerm, PropertyTerm, RelationTerm, Vocabulary, local_name


def report_redeclared(
    unit: ParsedFile, here: FileDeclarations, look_up: Names, vocabulary: Vocabulary
) -> Iterator[Diagnostic]:
    """Report the first declaration of each bare name that a term of a vocabulary has: it adds to that, or hides it.

    What can only be a new term, such as an enumeration, hides another one without a word.
    """
    reported: set[str] = set()
    hidden = {(look_up.kind_of(iri), local_name(iri)): iri for iri in here.hidden}
    for declaration in unit.file.declarations:
        if not isinstance(declaration, s.ClassDeclaration | s.RelationDeclaration | s.PropertyDeclaration):
            continue
        name, kind = declaration.name, term_kind(declaration, look_up.is_class)
        table = {"class": vocabulary.classes, "relation": vocabulary.relations, "property": vocabulary.properties}
        iri = here.terms[kind][name.text]
        old: ClassTerm | RelationTerm | PropertyTerm | None = table[kind].get(hidden.get((kind, name.text), iri))  # type: ignore[attr-defined]
        if old is None or ":" in name.text or old.iri in reported:
            continue
        reported.add(old.iri)
        if old.iri == iri:
            yield _extends(name, kind, old, vocabulary)
        elif isinstance(old, PropertyTerm):
            yield _hides(name, old, vocabulary)


def _extends(
    name: s.Name, kind: Kind, old: ClassTerm | RelationTerm | PropertyTerm, vocabulary: Vocabulary
) -> Diagnostic:
    short = vocabulary.short(old.iri)
    return Diagnostic(
        "redeclared-term",
        name.span,
        f"`{name.text}` is already a {kind}, `{short}`: this extends it instead of declaring a new one",
        help=f"choose another name, or write `{kind} {short}` if you mean to add to that one",
        severity="warning",
        labels=_declared_at(old),
    )


def _hides(name: s.Name, old: PropertyTerm, vocabulary: Vocabulary) -> Diagnostic:
    short, type_ = vocabulary.short(old.iri), describe_type(type_of(old.type))
    return Diagnostic(
        "redeclared-term",
        name.span,
        f"`{name.text}` is already a property, `{short}`, {type_}: with another type this is a new one of the library",
        help=f"write `{short}` where that one is meant, or choose another name",
        severity="warning",
        labels=_declared_at(old),
    )


def _declared_at(term: ClassTerm | RelationTerm | PropertyTerm) -> tuple[Label, ...]:
    place = term.source
    return (Label(Span(place.path, place.line, 1, place.line, 2), "declared here"),) if place else ()


def another_thing(name: s.Name) -> Diagnostic:
    return Diagnostic(
        "redeclared-term",
        name.span,
        f"`{name.text}` is already the class of all things, `owl:Thing`, to which nothing can be added",
        help="choose another name",
    )


def not_only_defined(name: s.Name, old: RelationTerm, vocabulary: Vocabulary) -> Diagnostic:
    return Diagnostic(
        "contradicting-declaration",
        name.span,
        f"`{vocabulary.short(old.iri)}` is declared elsewhere: a relation that is defined has one declaration",
        help="give the relation another name, or make one condition of both with `or`",
        labels=_declared_at(old),
    )


def contradiction(written: s.PropertyDeclaration, old: PropertyTerm, names: Names) -> Diagnostic:
    return Diagnostic(
        "contradicting-declaration",
        written.type.span,
        f"`{names.vocabulary.short(old.iri)}` is already declared with another type",
        help="give the property the same type here, or another name",
        labels=_declared_at(old),
    )
