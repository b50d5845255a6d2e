"""Skills as the text that an author would write, and back through the compiler."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import assert_never

from skillc_compiler.goals.parsing import parse_goal
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_model.conditions import (
    And,
    Anything,
    Compare,
    Condition,
    Exists,
    Expression,
    Forall,
    Given,
    HasProperty,
    Holds,
    Individual,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Term,
    Variable,
)
from skillc_model.skills import Skill, SkillLibrary
from skillc_rdf.vocabulary.types import ClassType, Vocabulary, local_name
from skillc_runtime.world.state.world_state import WorldState


def text_of(skills: Sequence[Skill]) -> str:
    """Return a file with the skills, each with an implementation."""
    return "\n".join(["use t", *(line for each in skills for line in _lines(each))])


def _lines(skill: Skill) -> Iterator[str]:
    yield f"skill {skill.name} {{"
    for parameter in skill.parameters:
        assert isinstance(parameter.type, ClassType)
        yield f"    in {parameter.name}: {local_name(parameter.type.iri)}"
    for requirement in skill.pre:
        yield f"    pre {requirement.label}: {condition_text(requirement.condition)}"
    for post in skill.post:
        yield f"    post {condition_text(post.condition, outside=True)}"
    assert isinstance(skill.duration, Literal)
    yield f"    duration {skill.duration.value} s"
    yield "}"
    yield f'impl {skill.name.lower()}_done of {skill.name} {{ run python "package.module:Class" }}'


def condition_text(condition: Condition, *, outside: bool = False) -> str:
    """Return a condition as text; a post stands `outside` of parentheses."""
    match condition:
        case Holds(subject, relation, object_):
            return f"{_term(subject)} {local_name(relation)} {_term(object_)}"
        case Compare(left, operator, right):
            return f"{_term(left)} {operator} {_term(right)}"
        case HasProperty(subject, property_):
            return f"{_term(subject)} has {local_name(property_)}"
        case IsA(subject, cls):
            return f"{_term(subject)} is {local_name(cls)}"
        case Same(left, right):
            return f"{_term(left)} == {_term(right)}"
        case Not(body):
            return f"not {condition_text(body)}" if outside else f"not ({condition_text(body)})"
        case And(parts):
            return " and ".join(f"({condition_text(each)})" for each in parts)
        case Or(parts):
            return " or ".join(f"({condition_text(each)})" for each in parts)
        case Exists(variable, cls, body):
            return f"exists {variable}: {local_name(cls)} ({condition_text(body)})"
        case Forall(variable, cls, body):
            return f"forall {variable}: {local_name(cls)} ({condition_text(body)})"
        case Given():
            raise AssertionError("no parameter is optional")
        case _:
            assert_never(condition)


def _term(term: Term | Expression | Anything) -> str:
    match term:
        case Anything():
            return "_"
        case Variable(name):
            return name
        case Individual(iri):
            return f"t:{local_name(iri)}"
        case PropertyOf(of, property_):
            return f"{_term(of)}.{local_name(property_)}"
        case Literal(bool(value)):
            return "true" if value else "false"
        case Literal(str(value)):
            return f'"{value}"'
        case Literal(value):
            return str(value)
        case _:
            raise AssertionError(f"{term} is not drawn")


def compiled(text: str, vocabulary: Vocabulary) -> SkillLibrary:
    """Return the library of a text; what an author would be told about it does not matter here."""
    return compile([Source("random.skill", text)], vocabulary, {}, "random").value


class Contradictory(Exception):
    """A goal of which the compiler says that it can never hold."""


def asked(text: str, state: WorldState) -> Condition:
    """Return the goal that a text asks for in a world."""
    vocabulary = state.vocabulary
    individuals = {each: sorted(state.types(each)) for each in state.individuals}
    outcome = parse_goal(text, vocabulary, individuals, vocabulary.prefixes)
    if any(each.name == "contradicting-conditions" for each in outcome.diagnostics):
        raise Contradictory
    assert outcome.value is not None, (text, outcome.diagnostics)
    return outcome.value
