"""The contents of the terms page: the part of the vocabulary that the library uses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeAlias, assert_never

import msgspec
from markupsafe import Markup

from skillc_compiler.emit.docs import prose
from skillc_compiler.emit.docs.linking import LinkWriter, make_anchor
from skillc_compiler.emit.docs.mentions import find_terms
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import (
    ClassTerm,
    FunctionTerm,
    PropertyTerm,
    RelationTerm,
    Vocabulary,
    local_name,
    value_name,
)

Term: TypeAlias = ClassTerm | RelationTerm | PropertyTerm | FunctionTerm


class TermEntry(msgspec.Struct, frozen=True):
    """A term: its anchor, name, facts, documentation, place of declaration, and the skills that use it."""

    anchor: str
    name: str
    iri: str
    facts: tuple[Markup, ...]
    comment: Markup
    place: Markup
    users: tuple[Markup, ...]


def shown_terms(library: SkillLibrary) -> frozenset[str]:
    """Return the library's own terms and those it mentions, with the classes that these refer to."""
    vocabulary = library.vocabulary
    known = {*vocabulary.classes, *vocabulary.relations, *vocabulary.properties, *vocabulary.functions}
    found = {name for name in known if name.startswith(library.namespace)}
    found |= {name for each in _speakers(library) for name in find_terms(each)}
    found |= {iri for name in found for iri in _classes_of(name, vocabulary)}
    found |= {iri for name in found for iri in vocabulary.ancestors.get(name, ())}
    return frozenset(found & known)


def term_groups(library: SkillLibrary, links: LinkWriter) -> tuple[tuple[str, tuple[TermEntry, ...]], ...]:
    """Return the terms by kind, each kind sorted by name."""
    vocabulary, users = library.vocabulary, _users(library)
    tables: tuple[tuple[str, Mapping[str, Term]], ...] = (
        ("Classes", vocabulary.classes),
        ("Relations", vocabulary.relations),
        ("Properties", vocabulary.properties),
        ("Functions", vocabulary.functions),
    )
    groups = []
    for title, table in tables:
        names = sorted(links.terms & table.keys(), key=lambda name: (local_name(name).lower(), name))
        entries = (_entry(name, table[name], users.get(name, frozenset()), links) for name in names)
        groups.append((title, tuple(entries)))
    return tuple(group for group in groups if group[1])


def _speakers(library: SkillLibrary) -> Iterator[msgspec.Struct]:
    yield from library.skills.values()
    yield from library.implementations.values()
    yield from library.tasks.values()


def _users(library: SkillLibrary) -> dict[str, frozenset[str]]:
    """Return the skills that mention each term."""
    found: dict[str, frozenset[str]] = {}
    for skill in library.skills.values():
        for name in frozenset[str]().union(*map(find_terms, (skill, *library.implementations_of(skill.name)))):
            found[name] = found.get(name, frozenset()) | {skill.name}
    return found


def _classes_of(name: str, vocabulary: Vocabulary) -> frozenset[str]:
    """Return the classes that a term's signature refers to."""
    if name in vocabulary.relations:
        signatures = vocabulary.relations[name].signatures
        return frozenset(iri for each in signatures for iri in (each.domain, each.range))
    if name in vocabulary.properties:
        return frozenset(vocabulary.properties[name].domains)
    return find_terms(vocabulary.functions[name]) if name in vocabulary.functions else frozenset()


def _entry(name: str, term: Term, users: frozenset[str], links: LinkWriter) -> TermEntry:
    return TermEntry(
        make_anchor(name, links.vocabulary),
        links.vocabulary.short(name),
        "" if isinstance(term, FunctionTerm) else name,
        tuple(_facts(term, links)),
        prose.line(term.comment),
        links.source(term.source) if term.source else Markup(""),
        tuple(links.skill(each) for each in sorted(users)),
    )


def _facts(term: Term, links: LinkWriter) -> Iterator[Markup]:
    match term:
        case ClassTerm():
            values = links.vocabulary.enumerations.get(term.iri, ())
            if values:
                yield Markup("one of {}").format(", ".join(map(value_name, values)))
            yield from (Markup("is a {}").format(links.term(iri)) for iri in term.parents)
            yield from (Markup("never a {}").format(links.term(iri)) for iri in term.disjoint)
        case RelationTerm():
            yield from _relation(term, links)
        case PropertyTerm():
            yield from (Markup("of {}").format(links.term(iri)) for iri in term.domains)
            yield links.type(term.type)
            if term.values:
                yield Markup("one of {}").format(", ".join(term.values))
            if term.computed_by:
                yield Markup("computed by <code>{}</code>").format(term.computed_by)
            if term.measure:
                yield Markup("judged from {}").format(links.term(term.measure))
            if term.threshold:
                yield Markup("needs {}").format(links.term(term.threshold))
        case FunctionTerm():
            parameters = (Markup("{}: {}").format(name, links.type(type_)) for name, type_ in term.parameters)
            yield Markup("({}) → {}").format(Markup(", ").join(parameters), links.type(term.result))
            yield Markup("<code>{}</code>").format(term.python)
        case _:
            assert_never(term)


def _relation(term: RelationTerm, links: LinkWriter) -> Iterator[Markup]:
    yield from (Markup("{} → {}").format(links.term(each.domain), links.term(each.range)) for each in term.signatures)
    yield from map(Markup, term.characteristics)
    yield from (Markup("implies {}").format(links.term(iri)) for iri in term.parents)
    if term.inverse:
        yield Markup("inverse of {}").format(links.term(term.inverse))
    definition = links.vocabulary.definitions.get(term.iri)
    if definition is not None:
        sides = f"{definition.subject.name} {local_name(term.iri)} {definition.object.name}"
        yield Markup("<code>{}</code> is defined as <code>{}</code>").format(sides, definition.text)
    elif term.computed_by:
        yield Markup("computed by <code>{}</code>").format(term.computed_by)
