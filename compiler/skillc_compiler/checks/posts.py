"""A postcondition without a definite effect, or one that contradicts another."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, islice

from skillc_compiler.logic.conflicts import Conflicts, covers
from skillc_compiler.logic.conjunctions import TypedFact, equal_names, facts_in, rename_fact
from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.logic.related import TopicIndex, topics_of_effect, topics_of_fact
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import Program, Requirement
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_model.conditions import Assert, Assign, Compare, Effect, Expression, HasProperty, Holds, Literal, Retract
from skillc_model.rewriting import substitute
from skillc_rdf.vocabulary.types import PropertyTerm, RelationTerm, Vocabulary, local_name

NAMES = ("post-not-literal", "computed-property", "two-values", "contradicting-posts")
NEEDS = Need.NAMES
READS = Reads.DECLARATION
MOST_CONFLICTS = 20
"""With so many earlier posts the contradictions of one are reported."""


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield the problems of the posts of each skill, and of those that an implementation adds."""
    conflicts = Conflicts(program.vocabulary)
    for skill in program.skills.values():
        yield from _check_posts(conflicts, skill.requirements, ())
    for implementation in program.implementations:
        yield from _check_posts(conflicts, implementation.requirements, implementation.skill.requirements)


def _check_posts(
    conflicts: Conflicts, own: Sequence[Requirement], given: Sequence[Requirement]
) -> Iterator[Diagnostic]:
    names = equal_names((*given, *own))
    known = TopicIndex[tuple[Effect, Requirement]]()
    for post in given:
        for effect in effects_of(post.condition) if post.kind == "post" else ():
            _add(conflicts, known, _with_equal_names(effect, names), post)
    for post in (requirement for requirement in own if requirement.kind == "post"):
        for effect in effects_of(post.condition):
            if isinstance(effect, NoEffect):
                if not post.sensed:
                    yield _not_literal(effect)
                continue
            if not post.sensed:
                yield from _check_computed(conflicts.vocabulary, effect, post)
            seen = substitute(effect, names)
            others = known.related(topics_of_effect(conflicts, seen))
            found = (_check_conflict(conflicts, seen, post, other, earlier) for other, earlier in others)
            yield from islice(chain.from_iterable(found), MOST_CONFLICTS)
            _add(conflicts, known, seen, post)
    yield from _check_measured(conflicts, own, given, names)


def _add(
    conflicts: Conflicts,
    known: TopicIndex[tuple[Effect, Requirement]],
    effect: Effect | NoEffect,
    post: Requirement,
) -> None:
    if not isinstance(effect, NoEffect):
        known.add((effect, post), topics_of_effect(conflicts, effect))


def _with_equal_names(effect: Effect | NoEffect, names: Mapping[str, Expression]) -> Effect | NoEffect:
    """Return the effect with equal names replaced by their representative."""
    return effect if isinstance(effect, NoEffect) else substitute(effect, names)


def _check_measured(
    conflicts: Conflicts, own: Sequence[Requirement], given: Sequence[Requirement], names: Mapping[str, Expression]
) -> Iterator[Diagnostic]:
    """Report a measured value that contradicts the one of another post."""
    posts = [post for post in (*given, *own) if post.kind == "post"]
    facts = [(rename_fact(fact, names), post) for post in posts for fact in facts_in(post.condition)]
    valued = [(fact, post) for fact, post in facts if isinstance(fact.meaning, Compare | HasProperty)]
    known = TopicIndex[tuple[TypedFact, Requirement]]()
    for fact, post in valued:
        topics = tuple(topics_of_fact(conflicts, fact))
        for other, earlier in known.related(topics) if post in own else ():
            both_assigned = _is_assigned(fact) and _is_assigned(other)
            if not both_assigned and (post.sensed or earlier.sensed) and conflicts.exclude(fact, other):
                yield _report_either("contradicting-posts", post, earlier, "another post says the opposite")
        known.add((fact, post), topics)


def _is_assigned(fact: TypedFact) -> bool:
    """Whether a post assigns the value, so that a second assignment is reported as such."""
    match fact.meaning:
        case Compare(operator="=="):
            return fact.holds
        case Compare(left=Literal(value=bool())) | Compare(right=Literal(value=bool())):
            return True
    return False


def _not_literal(part: NoEffect) -> Diagnostic:
    return Diagnostic(
        "post-not-literal",
        part.span,
        f"this does not say what is true afterwards: {part.reason}",
        help="write relations and `property == value` joined by `and`, or mark the post `sensed`",
    )


def _check_computed(vocabulary: Vocabulary, effect: Effect, post: Requirement) -> Iterator[Diagnostic]:
    term: PropertyTerm | RelationTerm | None
    if isinstance(effect, Assign):
        term = vocabulary.properties.get(effect.property)
    else:
        term = vocabulary.relations.get(effect.relation)
    if term is not None and term.computed_by is not None:
        yield Diagnostic(
            "computed-property",
            post.condition.span,
            f"`{local_name(term.iri)}` follows from other facts and cannot be set",
            help="mark the post `sensed`, or state the facts it follows from",
        )


def _check_conflict(
    conflicts: Conflicts, effect: Effect, post: Requirement, other: Effect, earlier: Requirement
) -> Iterator[Diagnostic]:
    match effect, other:
        case Assert(), Assert():
            relation = conflicts.two_values(_holds(effect), _holds(other))
            if relation is not None:
                message = f"`{local_name(relation)}` can have one value only, and another post gives it a second"
                yield _report_either("two-values", post, earlier, message)
        case Assign(value=Literal() as one), Assign(value=Literal() as two):
            if (effect.subject, effect.property) == (other.subject, other.property) and one != two:
                yield _report_either(
                    "two-values", post, earlier, f"`{local_name(effect.property)}` is given two values"
                )
        case (Assert() as true, Retract() as false) | (Retract() as false, Assert() as true):
            if any(covers(_holds(false), link) for link in conflicts.implied(_holds(true))):
                yield _report_either("contradicting-posts", post, earlier, "another post says the opposite")


def _report_either(name: str, post: Requirement, earlier: Requirement, message: str) -> Diagnostic:
    labels = (Label(earlier.condition.span, "the other one", is_cause=True),)
    return Diagnostic(name, post.condition.span, message, "keep one of the two", labels=labels)


def _holds(effect: Assert | Retract) -> Holds:
    return Holds(effect.subject, effect.relation, effect.object)
