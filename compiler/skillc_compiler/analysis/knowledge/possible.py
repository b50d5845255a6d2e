"""What a `post possible` says may have been written, and whether that includes what else may have been."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeAlias

from msgspec import structs

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes, any_individual, is_any_individual
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State
from skillc_compiler.analysis.knowledge.writes import PropertyWrite, RelationWrite, write_of
from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.typed import Requirement
from skillc_model.conditions import (
    And,
    Anything,
    Condition,
    Effect,
    Forall,
    ForEach,
    HasProperty,
    Holds,
    Individual,
    Same,
    Term,
    Variable,
)
from skillc_model.rewriting import ALWAYS, substitute
from skillc_model.traversal import conjuncts

FactWrite: TypeAlias = RelationWrite | PropertyWrite
BY_BOUNDS = "by how much a number may change is said by two bounds without `possible`, as in `-= 0 Wh .. 2 Wh`"


def possible_writes(requirements: Sequence[Requirement]) -> Iterator[FactWrite]:
    """Yield what may have been written, each with what it was on before; parts that say no such thing are left out."""
    for each in requirements:
        if each.kind == "possible":
            yield from (part for part in possible_parts(each.condition) if not isinstance(part, NoEffect))


def possible_parts(post: TypedCondition) -> Iterator[FactWrite | NoEffect]:
    """Yield what each part says may have been written.

    Unlike an effect, it may leave open to whom a relation leads (`_`), and which value a property has (`has`).
    """
    match post.meaning:
        case _ if post.change is not None:
            yield NoEffect(post.span, BY_BOUNDS)
        case _ if post.conditional is not None:
            scope, (body, when) = post.conditional, post.parts
            yield from (_of_each(each, scope.variable, scope.cls, when.meaning) for each in possible_parts(body))
        case Forall(variable=variable, cls=cls):
            yield from (_of_each(each, variable, cls, ALWAYS) for each in possible_parts(post.parts[0]))
        case And() if post.parts:
            for part in post.parts:
                yield from possible_parts(part)
        case Holds(subject=subject, relation=relation, object=object_) if Anything() in (subject, object_):
            yield RelationWrite(subject, relation, object_, None)
        case HasProperty(subject=Variable() | Individual() as subject, property=iri):
            yield PropertyWrite(subject, iri, None)
        case _:
            for effect in effects_of(post):
                yield effect if isinstance(effect, NoEffect) else single_write(effect)


def single_write(effect: Effect) -> FactWrite:
    """Return what an effect writes; of one on many, with what it writes to each."""
    single = effect.effect if isinstance(effect, ForEach) else effect
    write = write_of(single)
    assert isinstance(write, RelationWrite | PropertyWrite), "an effect writes a relation or a property"
    found = _of_each(write, effect.variable, effect.cls, effect.when) if isinstance(effect, ForEach) else write
    assert not isinstance(found, NoEffect), "it is a write still"
    return found


def with_term(write: FactWrite, name: str, term: IndividualTerm) -> FactWrite:
    """Return a write with a term in place of a name; of a value by that name nothing is known."""
    ends = ("subject", "object") if isinstance(write, RelationWrite) else ("subject",)
    changed: dict[str, object] = {end: term for end in ends if getattr(write, end) == Variable(name)}
    if isinstance(write, PropertyWrite) and write.value == Variable(name):
        changed["value"] = None
    when = None if write.when is None else substitute(write.when, {name: term})
    return structs.replace(write, **changed, when=when)


def _of_each(part: FactWrite | NoEffect, variable: str, cls: str, when: Condition) -> FactWrite | NoEffect:
    if isinstance(part, NoEffect):
        return part
    every = any_individual(cls)
    named = with_term(part, variable, every)
    return structs.replace(named, when=None if when == ALWAYS else substitute(when, {variable: every}))


def includes(types: AliasTypes, start: State, declared: FactWrite, write: FactWrite) -> bool:
    """Whether what is declared to be possible includes a write; `start` is the state at the start."""
    match declared, write:
        case RelationWrite(), RelationWrite():
            ends: tuple[tuple[Term, Term], ...] = (
                (declared.subject, write.subject),
                (declared.object, write.object),
            )
            is_said = declared.relation == write.relation and declared.value in (None, write.value)
        case PropertyWrite(), PropertyWrite():
            ends = ((declared.subject, write.subject),)
            is_said = declared.property == write.property and declared.value in (None, write.value)
        case _:
            return False
    if not is_said or not all(_is_one_of(types, start, one, other) for one, other in ends):
        return False
    named = {
        one.name: other
        for one, other in ends
        if isinstance(one, Variable) and is_any_individual(one) and not isinstance(other, Anything)
    }
    needed = () if declared.when is None else conjuncts(substitute(declared.when, named))
    known = () if write.when is None else conjuncts(write.when)
    return all(each in known or _is_so(types, start, each) for each in needed)


def _is_so(types: AliasTypes, start: State, condition: Condition) -> bool:
    if isinstance(condition, Same) and condition.left == condition.right:
        return True
    return bool(evaluate(types, start, condition))


def _is_one_of(types: AliasTypes, start: State, declared: Term, term: Term) -> bool:
    """Whether each individual that a term may stand for is one that another stands for."""
    if isinstance(declared, Anything):
        return True
    if isinstance(term, Anything):
        return False
    if is_any_individual(declared):
        return bool(types.is_a(start, term, types.class_of(declared)))
    return declared == term
