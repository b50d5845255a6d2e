"""Emits skills.ttl, the library as an OWL ontology.

A description is a class of capabilities and, with the same IRI, an individual with parameters and conditions. An
implementation is a defined class of invocations, so that a reasoner can order implementations by specificity and find
those that are applicable to an invocation.
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.emit.owl.skills import describe_implementation, describe_skill
from skillc_compiler.emit.owl.terms import describe_terms
from skillc_compiler.emit.owl.turtle import RDF_TYPE, IriNode, Object, format_turtle
from skillc_compiler.emit.owl.words import OWL, PREFIXES, RDFS, SKILLC
from skillc_model.skills import SkillLibrary

REPEATED = (
    "Terms of other vocabularies are repeated here as far as these skills need them, so that this file can be read by "
    "itself; what else is said of them stands where their namespaces are published."
)


def emit(library: SkillLibrary) -> dict[str, str]:
    """Return the ontology of the library's skills."""
    base = library.namespace
    ours = {**PREFIXES, "": base}
    theirs = {prefix: iri for prefix, iri in library.vocabulary.prefixes.items() if iri not in ours.values()}
    prefixes = {**theirs, **ours}
    return {"skills.ttl": format_turtle(prefixes, _statements(library))}


def _statements(library: SkillLibrary) -> Iterator[tuple[str, str, Object]]:
    ontology = library.namespace.removesuffix("#")
    yield ontology, RDF_TYPE, IriNode(f"{OWL}Ontology")
    yield ontology, f"{RDFS}label", library.name
    yield ontology, f"{RDFS}comment", REPEATED
    yield ontology, f"{SKILLC}sha256", library.hash
    for skill in library.skills.values():
        yield from describe_skill(skill, library)
        for each in library.implementations_of(skill.name):
            yield from describe_implementation(each, skill, library)
    yield from describe_terms(library)
