"""The vocabulary of a program: the loaded one with the terms and functions that the library declares."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from skillc_compiler.program.program import ParsedFile
from skillc_compiler.resolve.declaring.declarations import FileDeclarations, library_prefix, term_kind
from skillc_compiler.resolve.declaring.redeclared import (
    another_thing,
    contradiction,
    not_only_defined,
    report_redeclared,
)
from skillc_compiler.resolve.names import Kind, Names
from skillc_compiler.resolve.type_names import BUILT_IN, UNRESOLVED_TYPE, resolve_bounds, resolve_type
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_rdf.vocabulary.types import (
    THING,
    ClassTerm,
    ClassType,
    FunctionTerm,
    PropertyTerm,
    RelationTerm,
    Signature,
    ValueType,
    Vocabulary,
    value_iri,
)


def extend_vocabulary(
    vocabulary: Vocabulary,
    files: Sequence[ParsedFile],
    declared: Mapping[str, FileDeclarations],
    names: Mapping[str, Names],
) -> Vocabulary:
    """Return the vocabulary with everything that the files declare; problems are added to the files' names.

    It does not say with which edition terms came, as names are looked up by then.
    """
    classes, relations = dict(vocabulary.classes), dict(vocabulary.relations)
    properties, functions = dict(vocabulary.properties), dict(vocabulary.functions)
    defined = set[str]()
    enumerations = dict(vocabulary.enumerations)
    for unit in files:
        here, look_up = declared[unit.file.path], names[unit.file.path]
        look_up.problems += [*report_redeclared(unit, here, look_up, vocabulary)]
        for declaration in unit.file.declarations:
            match declaration:
                case s.ClassDeclaration():
                    iri = _declared_iri("class", declaration.name, here, look_up)
                    term = _class(declaration, iri, classes.get(iri), look_up)
                    if iri == THING:
                        look_up.problems.append(another_thing(declaration.name))
                    else:
                        classes[iri] = term
                    if declaration.values:
                        enumerations.setdefault(iri, _values(declaration, iri, look_up))
                case s.RelationDeclaration():
                    iri = _declared_iri("relation", declaration.name, here, look_up)
                    if iri in relations and (iri in defined or declaration.definition is not None):
                        look_up.problems.append(not_only_defined(declaration.name, relations[iri], vocabulary))
                    defined |= {iri} if declaration.definition is not None else set()
                    former = relations.get(iri) if iri not in defined else None  # what is defined has one signature
                    relations[iri] = _relation(declaration, iri, former, look_up)
                case s.PropertyDeclaration() if term_kind(declaration, look_up.is_class) == "relation":
                    iri = _declared_iri("relation", declaration.name, here, look_up)
                    relations[iri] = _link(declaration, iri, relations.get(iri), look_up)
                case s.PropertyDeclaration():
                    iri = _declared_iri("property", declaration.name, here, look_up)
                    properties[iri] = _property(declaration, iri, properties.get(iri), look_up)
                case s.FunctionDeclaration():
                    functions.setdefault(declaration.name.text, _function(declaration, look_up))
                case _:
                    pass
    return msgspec.structs.replace(
        vocabulary,
        prefixes=_prefixes(vocabulary, files, declared),
        since={},
        classes=classes,
        relations=_complete_inverses(relations),
        properties=properties,
        functions=functions,
        enumerations=enumerations,
    )


def _declared_iri(kind: Kind, name: s.Name, here: FileDeclarations, names: Names) -> str:
    """Return the IRI under which a term is declared; report an unknown prefix."""
    if ":" in name.text:
        names.look_up_individual(name)
    return here.terms[kind][name.text]


def _class(written: s.ClassDeclaration, iri: str, old: ClassTerm | None, names: Names) -> ClassTerm:
    parents = _resolve_classes(names, written.parents)
    disjoint = _resolve_classes(names, written.disjoint)
    if old is None:
        return ClassTerm(iri=iri, parents=parents, disjoint=disjoint, comment=written.doc, source=written.span.start)
    return msgspec.structs.replace(old, parents=_union(old.parents, parents), disjoint=_union(old.disjoint, disjoint))


def _relation(written: s.RelationDeclaration, iri: str, old: RelationTerm | None, names: Names) -> RelationTerm:
    domain, range_ = names.look_up_term("class", written.domain), names.look_up_term("class", written.range)
    signatures = (Signature(domain, range_),) if domain and range_ else ()
    traits = {trait.kind: trait for trait in written.traits}
    others = {kind: names.look_up_term("relation", t.name) for kind, t in traits.items() if t.name is not None}
    term = old or RelationTerm(iri=iri, signatures=(), comment=written.doc, source=written.span.start)
    parent = others.get("sub")
    return msgspec.structs.replace(
        term,
        signatures=tuple(dict.fromkeys((*term.signatures, *signatures))),
        parents=_union(term.parents, (parent,) if parent else ()),
        inverse=others.get("inverse") or term.inverse,
        functional=term.functional or "functional" in traits,
        symmetric=term.symmetric or "symmetric" in traits,
        transitive=term.transitive or "transitive" in traits,
    )


def _values(written: s.ClassDeclaration, iri: str, names: Names) -> tuple[str, ...]:
    """Return the individuals of an enumeration; one that is named twice is reported."""
    first: dict[str, s.Name] = {}
    for name in written.values:
        former = first.setdefault(name.text, name)
        if former is not name:
            message = f"`{name.text}` is twice in `{written.name.text}`"
            labels = (Label(former.span, "first named here"),)
            names.problems.append(Diagnostic("duplicate-declaration", name.span, message, "remove one", labels=labels))
    return tuple(value_iri(iri, name) for name in first)


def _link(written: s.PropertyDeclaration, iri: str, old: RelationTerm | None, names: Names) -> RelationTerm:
    """Return the relation for a property whose values are things: it leads to one of them."""
    domain, range_ = names.look_up_term("class", written.domain), resolve_type(names, written.type)
    signatures = (Signature(domain, range_.iri),) if domain and isinstance(range_, ClassType) else ()
    term = old or RelationTerm(iri=iri, signatures=(), comment=written.doc, source=written.span.start)
    both = tuple(dict.fromkeys((*term.signatures, *signatures)))
    return msgspec.structs.replace(term, signatures=both, functional=True)


def _property(written: s.PropertyDeclaration, iri: str, old: PropertyTerm | None, names: Names) -> PropertyTerm:
    domain = names.look_up_term("class", written.domain)
    domains = (domain,) if domain else ()
    declared = _type_of_property(written, names)
    bounds = resolve_bounds(written.range, declared, names)
    if old is None:
        return PropertyTerm(
            iri=iri, domains=domains, type=declared, bounds=bounds, comment=written.doc, source=written.span.start
        )
    if old.type != declared != UNRESOLVED_TYPE:
        names.problems.append(contradiction(written, old, names))
    return msgspec.structs.replace(old, domains=_union(old.domains, domains), bounds=old.bounds or bounds)


def _type_of_property(written: s.PropertyDeclaration, names: Names) -> ValueType:
    """Return the type; a `Message` is read where it is written, so that no property has one."""
    declared = resolve_type(names, written.type)
    if declared != BUILT_IN["Message"]:
        return declared
    message, help_ = "a `Message` is what is passed to a skill or a function", "write `Text`"
    fix = Fix(written.type.span, "Text", help_)
    names.problems.append(Diagnostic("unknown-type", written.type.span, message, help_, fix=fix))
    return BUILT_IN["Text"]


def _function(written: s.FunctionDeclaration, names: Names) -> FunctionTerm:
    report_repeated(written.parameters, names)
    return FunctionTerm(
        name=written.name.text,
        parameters=tuple((p.name.text, resolve_type(names, p.type)) for p in written.parameters),
        result=resolve_type(names, written.result),
        python=written.python.value,
        comment=written.doc,
        source=written.span.start,
    )


def report_repeated(parameters: Sequence[s.HeadParameter], names: Names) -> None:
    """Report the parameters of a function or task that have the name of an earlier one."""
    first: dict[str, s.Name] = {}
    for name in (parameter.name for parameter in parameters):
        former = first.setdefault(name.text, name)
        if former is not name:
            message = f"the parameter `{name.text}` is declared twice"
            labels = (Label(former.span, "first declared here"),)
            help_ = "give it another name, or remove one"
            names.problems.append(Diagnostic("duplicate-parameter", name.span, message, help_, labels=labels))


def _complete_inverses(relations: Mapping[str, RelationTerm]) -> dict[str, RelationTerm]:
    """Return the relations with `inverse` set on both if it was only stated for one."""
    stated = {term.inverse: iri for iri, term in relations.items() if term.inverse}
    return {
        iri: term if term.inverse or iri not in stated else msgspec.structs.replace(term, inverse=stated[iri])
        for iri, term in relations.items()
    }


def _prefixes(
    vocabulary: Vocabulary, files: Sequence[ParsedFile], declared: Mapping[str, FileDeclarations]
) -> dict[str, str]:
    prefixes = dict(vocabulary.prefixes)
    for unit in files:
        terms = declared[unit.file.path].terms.values()
        if any(iri.startswith(unit.namespace) for table in terms for iri in table.values()):
            prefixes[library_prefix(unit.library, unit.namespace, vocabulary.prefixes)] = unit.namespace
        for line in unit.file.header:
            if isinstance(line, s.Prefix):
                prefixes.setdefault(line.name.text, line.iri)
    return dict(sorted(prefixes.items()))


def _resolve_classes(names: Names, written: Sequence[s.Name]) -> tuple[str, ...]:
    return tuple(iri for name in written if (iri := names.look_up_term("class", name)))


def _union(one: tuple[str, ...], other: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys((*one, *other)))
