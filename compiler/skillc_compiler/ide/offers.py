"""Candidates for completion: each function yields those for one kind of place, the most likely first."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal, TypeAlias

import msgspec

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.cursor_context import CursorContext
from skillc_compiler.ide.descriptions import format_parameter
from skillc_compiler.ide.imports import find_hidden_terms, find_importable
from skillc_compiler.ide.term_pages import (
    AGGREGATE_FORMS,
    FAILURE,
    describe_aggregate,
    format_bare_type,
    format_function_head,
)
from skillc_compiler.program.typed import Parameter
from skillc_compiler.program.types import BOOL, INT, UNKNOWN, Measure, Thing, Type, describe_type, fits, type_of
from skillc_compiler.resolve.names import Kind
from skillc_compiler.resolve.references import ExpectedType
from skillc_compiler.resolve.type_names import BUILT_IN
from skillc_dsl import syntax as s
from skillc_dsl.units import DIMENSIONS
from skillc_rdf.vocabulary.types import THING, PropertyTerm, RelationTerm, Vocabulary, local_name, value_name

OfferKind: TypeAlias = Literal[
    "keyword", "class", "type", "relation", "property", "function", "skill", "implementation", "parameter", "variable",
    "label", "individual", "value", "unit", "vocabulary", "file", "diagnostic",
]  # fmt: skip


class Offer(msgspec.Struct, frozen=True):
    """A candidate: the text to show and, if it differs, the text to insert. Lower ranks are shown first.

    `imports` is the file that must be imported for it, `uses` the vocabulary that must be used, empty if none.
    """

    text: str
    kind: OfferKind
    detail: str = ""
    documentation: str = ""
    written: str = ""
    rank: int = 0
    imports: str = ""
    uses: str = ""

    @property
    def inserted(self) -> str:
        """The text to insert."""
        return self.written or self.text


def offer_classes(around: CursorContext, below: Type = UNKNOWN) -> Iterator[Offer]:
    """Offer the classes that fit a type, bare names before qualified names."""
    vocabulary = around.visible.vocabulary
    for text, iri in _terms(around, "class"):
        if iri in vocabulary.classes and fits(vocabulary, Thing(iri), below):
            parents = ", ".join(local_name(parent) for parent in vocabulary.classes[iri].parents)
            detail = f"< {parents}" if parents else ""
            yield Offer(text, "class", detail, vocabulary.classes[iri].comment)


def offer_built_in_types() -> Iterator[Offer]:
    """Offer the types that are not classes: the dimensions and the other built-in types."""
    return (Offer(name, "type", "built in", rank=1) for name in sorted(BUILT_IN))


def offer_dimensions() -> Iterator[Offer]:
    """Offer the dimensions that a vector can have."""
    return (Offer(name, "type", "dimension") for name in sorted(DIMENSIONS))


def offer_relations(around: CursorContext, subject: Type) -> Iterator[Offer]:
    """Offer the relations that a subject of this type can have."""
    vocabulary = around.visible.vocabulary
    for text, iri in _terms(around, "relation"):
        term = vocabulary.relations.get(iri)
        if term and any(fits(vocabulary, subject, Thing(signature.domain)) for signature in term.signatures):
            yield Offer(text, "relation", _signatures(term), term.comment)


def offer_all_relations(around: CursorContext) -> Iterator[Offer]:
    """Offer every relation."""
    return offer_relations(around, UNKNOWN)


def offer_properties(around: CursorContext, of: Type) -> Iterator[Offer]:
    """Offer the properties that an individual of this type can have, with their dimensions, and its one relations."""
    for text, term in _properties_of(around, of):
        yield Offer(text, "property", format_bare_type(term.type), term.comment, rank=_generality(term))
    vocabulary = around.visible.vocabulary
    for text, iri in _terms(around, "relation"):
        relation = vocabulary.relations.get(iri)
        if relation and relation.functional:
            ranges = {x.range for x in relation.signatures if fits(vocabulary, of, Thing(x.domain))}
            if ranges:
                yield Offer(text, "relation", " or ".join(sorted(map(local_name, ranges))), relation.comment, rank=1)


def offer_constants(around: CursorContext, wanted: ExpectedType) -> Iterator[Offer]:
    """Offer values of the wanted type that are the same everywhere: those of an enumeration or a property, `true`."""
    vocabulary = around.visible.vocabulary
    closed = wanted.type.cls if isinstance(wanted.type, Thing) else None
    for value in vocabulary.enumerations.get(closed or "", ()):
        yield Offer(value_name(value), "value", describe_type(wanted.type))
    yield from (Offer(text, "value", "a value of the property") for text in wanted.values)
    if wanted.type in (BOOL, UNKNOWN):
        yield from (Offer(text, "keyword", rank=0 if wanted.type == BOOL else 5) for text in ("true", "false"))


def offer_values(around: CursorContext, wanted: ExpectedType) -> Iterator[Offer]:
    """Offer values of the wanted type: constants, local names, their properties, functions, individuals."""
    vocabulary = around.visible.vocabulary
    yield from offer_constants(around, wanted)
    for name, kind in around.locals.items():
        if fits(vocabulary, kind, wanted.type) and not wanted.values:
            yield Offer(name, "variable", describe_type(kind), rank=1)
    for name in sorted(around.visible.functions):
        function = vocabulary.functions[name]
        if fits(vocabulary, type_of(function.result), wanted.type) and not wanted.values:
            yield Offer(
                name, "function", format_function_head(function).removeprefix("function "), function.comment, rank=3
            )
    if not wanted.values and (wanted.type in (INT, UNKNOWN) or isinstance(wanted.type, Measure)):
        for name, form in AGGREGATE_FORMS.items():
            if name != "count" or fits(vocabulary, INT, wanted.type):
                yield Offer(name, "function", form.removeprefix(name), describe_aggregate(name), rank=4)
    yield from offer_individuals(around, wanted.type)
    if wanted.type != UNKNOWN and not wanted.values and not isinstance(wanted.type, Thing):
        yield from _read_properties(around, wanted.type)


def offer_individuals(around: CursorContext, wanted: Type) -> Iterator[Offer]:
    """Offer the individuals of the task's scene that have the wanted type."""
    for iri, cls in sorted(around.individuals.items()):
        text = around.visible.written(iri)
        if text and fits(around.visible.vocabulary, Thing(cls), wanted):
            yield Offer(text, "individual", describe_type(Thing(cls)), rank=2)


def offer_arguments(analysis: Analysis, around: CursorContext, callee: str, passed: Iterable[str]) -> Iterator[Offer]:
    """Offer the parameters that are not passed yet, also as shorthand for a local name of the right type."""
    skill = analysis.program.skills.get(callee)
    taken = set(passed)
    for parameter in skill.parameters if skill else ():
        if parameter.direction == "out" or parameter.name in taken:
            continue
        line, rank = format_parameter(analysis, parameter), _need(parameter)
        known = around.locals.get(parameter.name)
        if known is not None and fits(around.visible.vocabulary, known, parameter.type):
            yield Offer(parameter.name, "parameter", line, parameter.doc, rank=rank)
        yield Offer(f"{parameter.name}:", "parameter", line, parameter.doc, f"{parameter.name}: ", rank + 1)


def offer_skills(analysis: Analysis, around: CursorContext, scoped: bool = False) -> Iterator[Offer]:
    """Offer the skills that can be called here, or those that can be used in `with`."""
    for name in sorted(around.visible.skills):
        skill = analysis.program.skills.get(name)
        if skill and (not scoped or "scoped" in skill.flags):
            takes = ", ".join(p.name for p in skill.parameters if p.direction == "in")
            yield Offer(name, "skill", f"({takes})", skill.doc, rank=1)


def offer_unimported_skills(analysis: Analysis, path: str, scoped: bool = False) -> Iterator[Offer]:
    """Offer the skills of files that are not imported yet."""
    for skill, file in find_importable(analysis, path):
        if not isinstance(skill, s.SkillDeclaration):
            continue
        flags = [member.flag for member in skill.members if isinstance(member, s.Flag)]
        if not scoped or "scoped" in flags:
            yield Offer(skill.name.text, "skill", f"import {file}", skill.doc, rank=7, imports=file)


def offer_outcomes(analysis: Analysis, skill: str) -> Iterator[Offer]:
    """Offer the labels of what can come of a skill."""
    found = analysis.program.skills.get(skill)
    for requirement in found.requirements if found else ():
        if requirement.kind == "outcome" and requirement.label is not None:
            yield Offer(requirement.label.text, "label", requirement.text)


def offer_uncertain_skills(analysis: Analysis, around: CursorContext) -> Iterator[Offer]:
    """Offer the skills that have outcomes."""
    for offer in offer_skills(analysis, around):
        if any(offer_outcomes(analysis, offer.text)):
            yield offer


def offer_parts_of_failure() -> Iterator[Offer]:
    """Offer what is told of a failure."""
    return (Offer(name, "property", "Text", about) for name, about in FAILURE.items())


def offer_unimported_functions(analysis: Analysis, path: str, wanted: ExpectedType) -> Iterator[Offer]:
    """Offer the functions of files that are not imported yet, whose results are of the wanted built-in type."""
    for function, file in find_importable(analysis, path):
        if isinstance(function, s.FunctionDeclaration) and isinstance(function.result, s.Name) and not wanted.values:
            result = BUILT_IN.get(function.result.text)
            if result is not None and fits(analysis.program.vocabulary, type_of(result), wanted.type):
                yield Offer(function.name.text, "function", f"import {file}", function.doc, rank=7, imports=file)


def offer_hidden_terms(analysis: Analysis, path: str, kind: Kind, of: Type = UNKNOWN) -> Iterator[Offer]:
    """Offer the terms that a file does not see yet: classes below a type, relations and properties that it can have."""
    vocabulary = analysis.program.vocabulary
    for hidden in find_hidden_terms(analysis, path, kind):
        comment, homes = _about(vocabulary, kind, hidden.iri)
        if not any(fits(vocabulary, *((home, of) if kind == "class" else (of, home))) for home in homes):
            continue
        how = f"import {hidden.imports}" if hidden.imports else f"use {hidden.uses}" if hidden.uses else ""
        yield Offer(hidden.written, kind, how, comment, rank=8, imports=hidden.imports, uses=hidden.uses)


def _about(vocabulary: Vocabulary, kind: Kind, iri: str) -> tuple[str, tuple[Type, ...]]:
    """Return the documentation of a term, and the type that it is, or those that can have it."""
    if kind == "class":
        return vocabulary.classes[iri].comment, (Thing(iri),)
    if kind == "relation":
        relation = vocabulary.relations[iri]
        return relation.comment, tuple(Thing(each.domain) for each in relation.signatures)
    return vocabulary.properties[iri].comment, tuple(map(Thing, vocabulary.properties[iri].domains))


def offer_parameters(analysis: Analysis, of: Iterable[Parameter]) -> Iterator[Offer]:
    """Offer parameters."""
    return (Offer(p.name, "parameter", format_parameter(analysis, p), p.doc) for p in of)


def _need(parameter: Parameter) -> int:
    return {"in": 0, "opt": 2, "infer": 4, "out": 6}[parameter.direction]


def _terms(around: CursorContext, kind: Kind) -> Iterator[tuple[str, str]]:
    """Yield the visible terms of a kind with their IRIs, qualified if the bare name is ambiguous."""
    for text, iris in sorted(around.visible.bare[kind].items()):
        if len(iris) == 1:
            yield text, iris[0]
        else:
            yield from ((around.visible.written(iri) or text, iri) for iri in iris)


def _properties_of(around: CursorContext, of: Type) -> Iterator[tuple[str, PropertyTerm]]:
    vocabulary = around.visible.vocabulary
    for text, iri in _terms(around, "property"):
        term = vocabulary.properties.get(iri)
        if term and any(fits(vocabulary, of, Thing(domain)) for domain in term.domains):
            yield text, term


def _read_properties(around: CursorContext, wanted: Type) -> Iterator[Offer]:
    """Offer the properties of local individuals whose values have the wanted type."""
    for name, kind in around.locals.items():
        if not isinstance(kind, Thing):
            continue
        for text, term in _properties_of(around, kind):
            if fits(around.visible.vocabulary, type_of(term.type), wanted):
                yield Offer(
                    f"{name}.{text}", "property", format_bare_type(term.type), term.comment, rank=4 + _generality(term)
                )


def _generality(term: PropertyTerm) -> int:
    """Return the rank of a property: 0 if it has a domain, 3 if every individual can have it."""
    return 3 if THING in term.domains else 0


def _signatures(term: RelationTerm) -> str:
    return ", ".join(f"({local_name(x.domain)}, {local_name(x.range)})" for x in term.signatures)
