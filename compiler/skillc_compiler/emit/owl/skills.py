"""Descriptions and implementations as OWL statements."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal as OneOf

from skillc_compiler.emit.owl.turtle import RDF_TYPE, AnonymousNode, IriNode, ListNode, Object
from skillc_compiler.emit.owl.values import convert_value, type_statements
from skillc_compiler.emit.owl.words import (
    ARGUMENT,
    CAPABILITY,
    CSS,
    INVOCATION,
    INVOKES,
    OWL,
    RDFS,
    SKILLC,
    SKIROS,
)
from skillc_dsl.position import Position
from skillc_model.conditions import (
    Compare,
    Condition,
    HasProperty,
    Holds,
    IsA,
    Literal,
    Not,
    PropertyOf,
    Same,
    Term,
    Variable,
)
from skillc_model.format_condition import format_condition
from skillc_model.format_type import SI_UNITS
from skillc_model.skills import (
    Implementation,
    Outcome,
    Parameter,
    PausePolicy,
    Post,
    Primitive,
    Requirement,
    Skill,
    SkillLibrary,
)
from skillc_rdf.vocabulary.types import ClassType, NumberType

Statement = tuple[str, str, Object]
BOUND = ("in", "infer")
"""Directions of the parameters that every invocation binds."""
CONDITIONS = {
    "pre": (f"{SKIROS}hasPreCondition", f"{SKIROS}PreCondition"),
    "hold": (f"{SKIROS}hasHoldCondition", f"{SKILLC}HoldCondition"),
    "post": (f"{SKIROS}hasPostCondition", f"{SKIROS}PostCondition"),
    "possible": (f"{SKILLC}hasPossibleCondition", f"{SKILLC}PossibleCondition"),
    "outcome": (f"{SKILLC}hasOutcomeCondition", f"{SKILLC}OutcomeCondition"),
}
"""The relation of a skill to its conditions of a kind, and their class."""


def describe_skill(skill: Skill, library: SkillLibrary) -> Iterator[Statement]:
    """Yield the statements of a description: a class of capabilities, an individual with parameters and conditions."""
    iri = f"{library.namespace}{skill.name}"
    yield iri, RDF_TYPE, IriNode(f"{OWL}Class")
    yield iri, RDF_TYPE, IriNode(f"{SKIROS}Skill")
    yield iri, f"{RDFS}subClassOf", IriNode(CAPABILITY)
    yield from _named(iri, skill.name, skill.doc, skill.source)
    if skill.duration:
        yield iri, f"{SKILLC}duration", convert_value(skill.duration, NumberType("Time"), library.vocabulary)
        yield iri, f"{SKILLC}durationUnit", SI_UNITS["Time"]
    if skill.cost:
        yield iri, f"{SKILLC}cost", convert_value(skill.cost, NumberType("Number"), library.vocabulary)
    if skill.pause != PausePolicy():
        yield iri, f"{SKILLC}pause", skill.pause.where
    if skill.pause.keep_s is not None:
        yield iri, f"{SKILLC}keep", skill.pause.keep_s
        yield iri, f"{SKILLC}keepUnit", SI_UNITS["Time"]
    for parameter in skill.parameters:
        yield from _parameter(iri, parameter, library)
    for sensed in skill.senses:
        yield iri, f"{SKILLC}senses", format_condition(sensed, library.vocabulary)
    kinds = (("pre", skill.pre), ("hold", skill.hold), ("post", skill.post), ("possible", skill.possible))
    for kind, listed in (*kinds, ("outcome", skill.outcomes)):
        for each in listed:
            yield from _condition(iri, kind, each, skill, library)


def describe_implementation(each: Implementation, skill: Skill, library: SkillLibrary) -> Iterator[Statement]:
    """Yield the statements of an implementation: the class of invocations with arguments of its refined types."""
    base = f"{library.namespace}{skill.name}"
    iri = f"{base}.{each.name}"
    yield iri, RDF_TYPE, IriNode(f"{OWL}Class")
    yield iri, f"{OWL}equivalentClass", _invocations(base, each.parameters)
    yield from _named(iri, f"{skill.name}[{each.name}]", each.doc, each.source)
    yield iri, f"{SKILLC}implements", IriNode(base)
    yield iri, f"{SKILLC}rank", skill.implementations.index(each.name) + 1
    if each.prefer:
        yield iri, f"{SKILLC}preference", float(each.prefer)
    if isinstance(each.body, Primitive):
        yield iri, f"{SKILLC}python", each.body.python
    for kind, own, described in (("pre", each.pre, skill.pre), ("hold", each.hold, skill.hold)):
        for requirement in (own_one for own_one in own if own_one not in described):
            yield from _condition(iri, kind, requirement, skill, library, base)


def _invocations(base: str, parameters: Sequence[Parameter]) -> AnonymousNode:
    arguments = [
        _restriction(f"{base}.argument.{each.name}", "some" if each.direction in BOUND else "all", cls)
        for each in sorted(parameters, key=lambda each: each.name)
        if (cls := _argument_class(each))
    ]
    parts = ListNode((IriNode(INVOCATION), _restriction(INVOKES, "some", base), *arguments))
    return AnonymousNode(((RDF_TYPE, IriNode(f"{OWL}Class")), (f"{OWL}intersectionOf", parts)))


def _argument_class(parameter: Parameter) -> str | None:
    """Return the class of a parameter whose values are individuals; None for other types and for outputs."""
    return parameter.type.iri if parameter.direction != "out" and isinstance(parameter.type, ClassType) else None


def _restriction(relation: str, kind: OneOf["some", "all"], cls: str) -> AnonymousNode:
    """Return the OWL restriction `relation some cls` or `relation all cls`."""
    of, on = (RDF_TYPE, IriNode(f"{OWL}Restriction")), (f"{OWL}onProperty", IriNode(relation))
    return AnonymousNode((of, on, (f"{OWL}{kind}ValuesFrom", IriNode(cls))))


def _named(iri: str, label: str, doc: str, source: Position) -> Iterator[Statement]:
    yield iri, f"{RDFS}label", label
    yield iri, f"{SKILLC}definedAt", str(source)
    if doc:
        yield iri, f"{RDFS}comment", doc


def _parameter(skill: str, parameter: Parameter, library: SkillLibrary) -> Iterator[Statement]:
    iri = f"{skill}.parameter.{parameter.name}"
    yield skill, f"{SKIROS}hasParam", IriNode(iri)
    yield iri, RDF_TYPE, IriNode(f"{SKIROS}Parameter")
    yield iri, RDF_TYPE, IriNode(f"{CSS}{'OutputParameter' if parameter.direction == 'out' else 'InputParameter'}")
    yield from _named(iri, parameter.name, parameter.doc, parameter.source)
    yield iri, f"{SKILLC}direction", parameter.direction
    yield from type_statements(iri, parameter.type)
    if parameter.default is not None:
        yield iri, f"{SKILLC}defaultValue", convert_value(parameter.default, parameter.type, library.vocabulary)
    for name, bound in (("leastValue", parameter.low), ("greatestValue", parameter.high)):
        if bound is not None:
            yield iri, f"{SKILLC}{name}", float(bound)
    if _argument_class(parameter):
        yield from _argument(f"{skill}.argument.{parameter.name}")


def _argument(iri: str) -> Iterator[Statement]:
    yield iri, RDF_TYPE, IriNode(f"{OWL}ObjectProperty")
    yield iri, RDF_TYPE, IriNode(f"{OWL}FunctionalProperty")
    yield iri, f"{RDFS}subPropertyOf", IriNode(ARGUMENT)


def _condition(
    owner: str,
    kind: str,
    requirement: Requirement | Post | Outcome,
    skill: Skill,
    library: SkillLibrary,
    described: str = "",
) -> Iterator[Statement]:
    """Yield the statements of a condition of a description, or of an implementation of the description `described`."""
    iri, (relation, cls) = f"{owner}.{kind}.{requirement.label}", CONDITIONS[kind]
    yield owner, relation, IriNode(iri)
    if not described:
        yield owner, f"{CSS}isRestrictedBy", IriNode(iri)
    yield iri, RDF_TYPE, IriNode(cls)
    yield iri, RDF_TYPE, IriNode(f"{CSS}Constraint")
    yield from _named(iri, requirement.label, "", requirement.source)
    yield iri, f"{SKILLC}conditionText", requirement.text
    if isinstance(requirement, Post):
        yield iri, f"{SKILLC}sensed", requirement.sensed
    if isinstance(requirement, Outcome):
        yield iri, f"{SKILLC}likelihood", requirement.likely
    parameters = {each.name: f"{described or owner}.parameter.{each.name}" for each in skill.parameters}
    yield from ((iri, predicate, part) for predicate, part in _literal(requirement.condition, parameters))


def _literal(condition: Condition, parameters: dict[str, str]) -> Iterator[tuple[str, Object]]:
    """Yield the parts of a condition that is a single literal, for simple readers; nothing for other conditions."""
    literal = condition.body if isinstance(condition, Not) else condition
    if isinstance(literal, Holds | Compare | HasProperty | IsA | Same):
        yield f"{SKILLC}desiredState", literal is condition
    match literal:
        case Holds(subject=subject, relation=relation, object=object_):
            yield f"{SKILLC}conditionRelation", IriNode(relation)
            yield from _ends(parameters, subject, object_)
        case Same(left=left, right=right):
            yield f"{SKILLC}operator", "=="
            yield from _ends(parameters, left, right)
        case HasProperty(subject=subject, property=iri):
            yield f"{SKILLC}conditionProperty", IriNode(iri)
            yield from _ends(parameters, subject)
        case IsA(subject=subject, cls=cls):
            yield f"{SKILLC}parameterType", IriNode(cls)
            yield from _ends(parameters, subject)
        case Compare(left=PropertyOf(of=Variable() as subject, property=iri), operator=operator, right=right):
            yield f"{SKILLC}conditionProperty", IriNode(iri)
            yield f"{SKILLC}operator", operator
            if isinstance(right, Literal):
                yield f"{SKILLC}comparedValue", right.value
            yield from _ends(parameters, subject)


def _ends(parameters: dict[str, str], subject: Term, object_: Term | None = None) -> Iterator[tuple[str, Object]]:
    for word, term in (("subject", subject), ("object", object_)):
        if isinstance(term, Variable) and term.name in parameters:
            yield f"{SKILLC}{word}", IriNode(parameters[term.name])
