"""What skills do to what rests on what and blocks what: facts for planners, while the world computes them from poses.

A planner knows no poses. Where it reads `restsOn` or `blocks`, it gets a library in which both are stated relations,
and skills also say what becomes of them:
- what is taken is blocked by nothing, and rests on nothing and blocks nothing afterwards; what rests on it stays there;
- what is put into a location rests on that, which contains it;
- what a skill says comes to rest on something blocks that, unless the skill says that it is contained there.
"""

from __future__ import annotations

from typing import assert_never

from msgspec import structs

from skillc_model.conditions import Anything, Assert, Effect, Holds, Individual, Not, Retract, Term, Variable
from skillc_model.read_write import terms_read_by, terms_written
from skillc_model.skills import Post, Requirement, Skill, SkillLibrary
from skillc_rdf.vocabulary.iris import SKILLC, SKIROS
from skillc_rdf.vocabulary.types import ClassType, Vocabulary, local_name

RESTS_ON = SKILLC + "restsOn"
BLOCKS = SKILLC + "blocks"
CONTAIN = SKIROS + "contain"
LOCATION = SKIROS + "Location"

FORESEEN = (RESTS_ON, BLOCKS)
"""The computed relations of which it is known what steps do to them."""

CLAIMED = frozenset({RESTS_ON})
"""Those that a postcondition may claim without a measurement: it is checked when the skill ends, and never written."""


def foresee_effects(library: SkillLibrary) -> SkillLibrary:
    """Return a library in which the foreseen relations are stated; the same if no planned skill is about them."""
    if not computes_foreseen(library.vocabulary) or find_terms_of_skills(library).isdisjoint(FORESEEN):
        return library
    return with_foreseen_effects(library, state_foreseen(library.vocabulary))


def computes_foreseen(vocabulary: Vocabulary) -> bool:
    """Whether a vocabulary computes the foreseen relations."""
    return all(each in vocabulary.relations and vocabulary.is_computed(each) for each in FORESEEN)


def find_terms_of_skills(library: SkillLibrary) -> frozenset[str]:
    """Return the terms that planned skills read, or claim in postconditions."""
    planned = [each for each in library.skills.values() if each.planned]
    claimed = terms_written((result for each in planned for result in each.results), library.vocabulary)
    return claimed.union(*(terms_read_by(each, library) for each in planned))


def state_foreseen(vocabulary: Vocabulary) -> Vocabulary:
    """Return a vocabulary in which the foreseen relations are stated.

    They are functional: where a thing comes to rest, only that is known, and replaces all that was computed.
    """
    known = vocabulary.relations
    stated = {
        each: structs.replace(known[each], computed_by=None, computed_from=(), functional=True) for each in FORESEEN
    }
    return structs.replace(vocabulary, relations={**known, **stated})


def with_foreseen_effects(library: SkillLibrary, vocabulary: Vocabulary) -> SkillLibrary:
    """Return a library with a vocabulary of stated relations, whose skills say what becomes of them."""
    skills = {name: _with_effects(skill, vocabulary) for name, skill in library.skills.items()}
    return structs.replace(library, vocabulary=vocabulary, skills=skills)


def _with_effects(skill: Skill, vocabulary: Vocabulary) -> Skill:
    """Return a skill that says what becomes of the foreseen relations of what it moves."""
    asserted = [each for post in skill.post for each in post.effects if isinstance(each, Assert)]
    rests = [each for each in asserted if each.relation == RESTS_ON]
    contained = [each for each in asserted if each.relation == CONTAIN]
    told = {each.subject for each in rests}
    put = [each for each in contained if each.object not in told and _is_location(each.subject, skill, vocabulary)]
    taken = [each.object for each in contained if each.object not in told and each not in put]
    holders = {(each.object, each.subject) for each in contained}
    conditions: list[Holds | Not] = [
        *(Holds(each.object, RESTS_ON, each.subject) for each in put),
        *(Holds(each.subject, BLOCKS, each.object) for each in rests if (each.subject, each.object) not in holders),
        *(Not(Holds(each.object, BLOCKS, Anything())) for each in put),
        *(Not(Holds(each, relation, Anything())) for each in taken for relation in FORESEEN),
    ]
    posts = (
        Post(label="", condition=each, effects=(_effect(each),), sensed=False, text=_text(each), source=skill.source)
        for each in conditions
    )
    free = (Not(Holds(Anything(), BLOCKS, each)) for each in taken)
    requirements = (Requirement(label="", condition=each, text=_text(each), source=skill.source) for each in free)
    return structs.replace(skill, pre=(*skill.pre, *requirements), post=(*skill.post, *posts))


def _effect(literal: Holds | Not) -> Effect:
    match literal:
        case Holds(Variable() | Individual() as subject, relation, Variable() | Individual() as object_):
            return Assert(subject, relation, object_)
        case Not(Holds(subject, relation, object_)):
            return Retract(subject, relation, object_)
    raise AssertionError(f"{literal} is no effect")


def _text(literal: Holds | Not) -> str:
    """Return a literal as its author would have written it."""
    match literal:
        case Holds(subject, relation, object_):
            return f"{_name(subject)} {local_name(relation)} {_name(object_)}"
        case Not(Holds() as body):
            return f"not {_text(body)}"
    raise AssertionError(f"{literal} is no literal")


def _name(term: Term) -> str:
    match term:
        case Variable(name):
            return name
        case Individual(iri):
            return local_name(iri)
        case Anything():
            return "_"
        case _:
            assert_never(term)


def _is_location(term: Variable | Individual, skill: Skill, vocabulary: Vocabulary) -> bool:
    if isinstance(term, Individual):
        return False
    types = (each.type for each in skill.parameters if each.name == term.name)
    return any(isinstance(each, ClassType) and vocabulary.is_a(each.iri, LOCATION) for each in types)
