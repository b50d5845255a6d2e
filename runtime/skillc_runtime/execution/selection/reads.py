"""What conditions and expressions read, and what of it no skill of the library ever changes."""

from __future__ import annotations

from typing import assert_never

from skillc_compiler.library.conditions import (
    And,
    Arithmetic,
    Assign,
    Compare,
    Condition,
    Exists,
    Expression,
    Forall,
    Given,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Variable,
)
from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.library.vocabulary import Vocabulary


def changing_terms(library: SkillLibrary) -> frozenset[str]:
    """Return the relations and properties that some skill changes, with the relations that change with them."""
    changing: set[str] = set()
    for implementation in library.implementations.values():
        for post in implementation.post:
            for effect in post.effects:
                if isinstance(effect, Assign):
                    changing.add(effect.property)
                else:
                    changing |= _moved_with(effect.relation, library.vocabulary)
    return frozenset(changing)


def is_fixed(condition: Condition, changing: frozenset[str], vocabulary: Vocabulary) -> bool:
    """Whether the condition, once its names are bound, is as true now as at any later time."""
    match condition:
        case Holds(relation=relation):
            return relation not in changing and vocabulary.relations[relation].computed_by is None
        case Compare(left=left, right=right):
            return has_fixed_value(left, changing, vocabulary) and has_fixed_value(right, changing, vocabulary)
        case HasProperty(property=property_):
            return _is_stored(property_, changing, vocabulary)
        case Same() | IsA() | Given():
            return True
        case Not(body=body) | Exists(body=body) | Forall(body=body):
            return is_fixed(body, changing, vocabulary)
        case And(parts=parts) | Or(parts=parts):
            return all(is_fixed(part, changing, vocabulary) for part in parts)
        case _:
            assert_never(condition)


def has_fixed_value(expression: Expression, changing: frozenset[str], vocabulary: Vocabulary) -> bool:
    """Whether the expression, once its names are bound, has the same value now as at any later time."""
    match expression:
        case Literal() | Variable() | Individual():
            return True
        case PropertyOf(of=of, property=property_):
            return _is_stored(property_, changing, vocabulary) and has_fixed_value(of, changing, vocabulary)
        case Arithmetic(left=left, right=right):
            return has_fixed_value(left, changing, vocabulary) and has_fixed_value(right, changing, vocabulary)
        case Invoke():
            return False
        case _:
            assert_never(expression)


def _is_stored(property_: str, changing: frozenset[str], vocabulary: Vocabulary) -> bool:
    """Whether a property only changes by effects, and by none: a computed one may follow from anything."""
    return property_ not in changing and vocabulary.properties[property_].computed_by is None


def _moved_with(relation: str, vocabulary: Vocabulary) -> set[str]:
    """Return the relations whose facts may change when one of `relation` is written or retracted."""
    below = {iri for iri, above in vocabulary.super_relations.items() if relation in above}
    written = below | _inverses(below, vocabulary)
    moved = {above for iri in written for above in vocabulary.super_relations.get(iri, {iri})}
    return moved | _inverses(moved, vocabulary)


def _inverses(relations: set[str], vocabulary: Vocabulary) -> set[str]:
    return {
        inverse
        for iri, term in vocabulary.relations.items()
        for one, inverse in ((iri, term.inverse), (term.inverse, iri))
        if one in relations and inverse is not None
    }
