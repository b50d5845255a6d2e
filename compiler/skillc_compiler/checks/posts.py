"""A postcondition without a definite effect, or one that contradicts another."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from skillc_compiler.analysis.knowledge.possible import possible_parts
from skillc_compiler.logic.conflicts import Conflicts, covers
from skillc_compiler.logic.conjunctions import TypedFact, equal_names, facts_in, rename_fact
from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.logic.related import TopicIndex, topics_of_effect, topics_of_fact
from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Requirement
from skillc_compiler.program.types import Thing
from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.source import Span
from skillc_model.conditions import (
    Adjust,
    Anything,
    Assert,
    Assign,
    Compare,
    Effect,
    Expression,
    HasProperty,
    Holds,
    Literal,
    Not,
    PropertyOf,
    Retract,
    single_effect,
)
from skillc_model.foresight import CLAIMED
from skillc_model.format_condition import format_condition, format_expression
from skillc_model.rewriting import substitute
from skillc_rdf.vocabulary.types import THING, PropertyTerm, RelationTerm, Vocabulary, local_name

NAMES = ("post-not-literal", "computed-property", "two-values", "contradicting-posts")
NEEDS = Need.NAMES
READS = Reads.DECLARATION
_OPPOSITE = "another post says the opposite"
MOST_CONFLICTS = 20
"""With so many earlier posts the contradictions of one are reported."""


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield the problems of the posts of each skill, and of those that an implementation adds."""
    conflicts = Conflicts(program.vocabulary)
    for own, given in program.list_requirements():
        yield from _check_posts(conflicts, own, given)


def _check_posts(
    conflicts: Conflicts, own: Sequence[Requirement], given: Sequence[Requirement]
) -> Iterator[Diagnostic]:
    names = equal_names((*given, *own))
    known = _KnownEffects(conflicts)
    for post in given:
        for effect in effects_of(post.condition) if post.kind == "post" else ():
            if not isinstance(effect, NoEffect):
                known.add(substitute(effect, names), post)
    for post in (requirement for requirement in own if requirement.kind == "post"):
        for effect in effects_of(post.condition):
            if isinstance(effect, NoEffect):
                if not post.sensed:
                    yield _not_literal(conflicts.vocabulary, effect)
                continue
            yield from _check_computed(conflicts.vocabulary, effect, post)
            seen = substitute(effect, names)
            yield from islice(known.contradictions(seen, post), MOST_CONFLICTS)
            known.add(seen, post)
    for outcome in (requirement for requirement in own if requirement.kind == "outcome"):
        for effect in effects_of(outcome.condition):
            if isinstance(effect, Assert | Retract) and effect.relation in conflicts.vocabulary.definitions:
                yield _defined(conflicts.vocabulary, effect, outcome)
    for possible in (requirement for requirement in own if requirement.kind == "possible"):
        yield from (_not_possible(part) for part in possible_parts(possible.condition) if isinstance(part, NoEffect))
    yield from _check_measured(conflicts, own, given, names)


class _KnownEffects:
    """The effects of earlier posts, each once, with the posts that have it."""

    def __init__(self, conflicts: Conflicts) -> None:
        self._conflicts = conflicts
        self._index = TopicIndex[Effect]()
        self._posts: dict[Effect, list[Requirement]] = {}

    def add(self, effect: Effect, post: Requirement) -> None:
        """Add an effect of a post."""
        if effect not in self._posts:
            self._index.add(effect, topics_of_effect(self._conflicts, effect))
        self._posts.setdefault(effect, []).append(post)

    def contradictions(self, effect: Effect, post: Requirement) -> Iterator[Diagnostic]:
        """Yield a problem for each earlier post that an effect of this one contradicts."""
        for other in self._index.related(topics_of_effect(self._conflicts, effect)):
            conflict = _find_conflict(self._conflicts, effect, other)
            if conflict is not None:
                yield from (_report_either(*conflict, post, earlier) for earlier in self._posts[other])


def _check_measured(
    conflicts: Conflicts, own: Sequence[Requirement], given: Sequence[Requirement], names: Mapping[str, Expression]
) -> Iterator[Diagnostic]:
    """Report a measured value that contradicts the one of another post."""
    posts = [(post, index >= len(given)) for index, post in enumerate((*given, *own)) if post.kind == "post"]
    facts = [(rename_fact(fact, names), post, is_own) for post, is_own in posts for fact in facts_in(post.condition)]
    valued = [each for each in facts if isinstance(each[0].meaning, Compare | HasProperty)]
    known = TopicIndex[tuple[TypedFact, Requirement]]()
    for fact, post, is_own in valued:
        topics = tuple(topics_of_fact(conflicts, fact))
        for other, earlier in known.related(topics) if is_own else ():
            both_assigned = _is_assigned(fact) and _is_assigned(other)
            if not both_assigned and (post.sensed or earlier.sensed) and conflicts.exclude(fact, other):
                yield _report_either("contradicting-posts", _OPPOSITE, post, earlier)
        known.add((fact, post), topics)


def _is_assigned(fact: TypedFact) -> bool:
    """Whether a post assigns the value, so that a second assignment is reported as such."""
    match fact.meaning:
        case Compare(operator="=="):
            return fact.holds
        case Compare(left=Literal(value=bool())) | Compare(right=Literal(value=bool())):
            return True
    return False


def _not_literal(vocabulary: Vocabulary, part: NoEffect) -> Diagnostic:
    help_ = "write relations and `property == value` joined by `and`, or mark the post `sensed`"
    fix = None
    if part.around is not None:
        left, amount = part.around
        help_ = f"write `{part.operator}`, which changes the value from what it was before"
        fix = Fix(left.gap(amount), f" {part.operator} ", f"write `{part.operator}`")
    if part.reads is not None:
        help_ = _name_it(vocabulary, part.reads)
    message = f"this does not say what is true afterwards: {part.reason}"
    return Diagnostic("post-not-literal", part.span, message, help=help_, fix=fix)


def _name_it(vocabulary: Vocabulary, value: TypedExpression) -> str:
    """Return the lines that give a name to a value of a functional relation."""
    assert isinstance(value.meaning, PropertyOf) and isinstance(value.type, Thing)
    name, read = local_name(value.meaning.property), format_expression(value.meaning, vocabulary)
    cls = local_name(value.type.cls or THING)
    return f"add `infer {name}: {cls}` and `pre {read} == {name}`, and write `{name}` here"


def _not_possible(part: NoEffect) -> Diagnostic:
    message = f"this does not say what may be true afterwards: {part.reason}"
    help_ = "write relations, `property == value` or `thing has property` for any value, joined by `and`"
    return Diagnostic("post-not-literal", part.span, message, help=help_)


def _check_computed(vocabulary: Vocabulary, effect: Effect, post: Requirement) -> Iterator[Diagnostic]:
    term: PropertyTerm | RelationTerm | None
    single = single_effect(effect)
    if isinstance(single, Assign | Adjust):
        term = vocabulary.properties.get(single.property)
    else:
        term = vocabulary.relations.get(single.relation)
        if single.relation in vocabulary.definitions:
            yield _defined(vocabulary, single, post)
            return
    if post.sensed:
        return
    if term is not None and term.computed_by is not None and term.iri not in CLAIMED:
        yield Diagnostic(
            "computed-property",
            post.condition.span,
            f"`{local_name(term.iri)}` follows from other facts and cannot be set",
            help="mark the post `sensed`, or state the facts it follows from",
        )


def _defined(vocabulary: Vocabulary, effect: Assert | Retract, post: Requirement) -> Diagnostic:
    """Return that a post is about a defined relation, with what would make it so in its place."""
    definition = vocabulary.definitions[effect.relation]
    sides = ((definition.subject, effect.subject), (definition.object, effect.object))
    values = {side.name: term for side, term in sides if not isinstance(term, Anything)}
    meant = substitute(definition.condition, values)
    if isinstance(effect, Retract):
        meant = Not(meant)
    return Diagnostic(
        "computed-property",
        post.condition.span,
        f"`{local_name(effect.relation)}` is defined by a condition, so no skill makes it true or false",
        help=f"state the facts that make this so: {format_condition(meant, vocabulary)}",
        labels=(Label(at, "defined here"),) if (at := _place_of(vocabulary.relations[effect.relation])) else (),
    )


def _place_of(term: RelationTerm) -> Span | None:
    place = term.source
    return Span(place.path, place.line, 1, place.line, 2) if place else None


def _find_conflict(conflicts: Conflicts, effect: Effect, other: Effect) -> tuple[str, str] | None:
    """Return the name of the problem with two effects, and what is wrong; None if they go together."""
    match effect, other:
        case Assert(), Assert():
            relation = conflicts.two_values(_holds(effect), _holds(other))
            if relation is not None:
                message = f"`{local_name(relation)}` can have one value only, and another post gives it a second"
                return "two-values", message
        case Assign(value=Literal() as one), Assign(value=Literal() as two):
            if (effect.subject, effect.property) == (other.subject, other.property) and one != two:
                return "two-values", f"`{local_name(effect.property)}` is given two values"
        case (Adjust() | Assign() as effect, Adjust() | Assign() as other) if Adjust in (type(effect), type(other)):
            if (effect.subject, effect.property) == (other.subject, other.property):
                return "contradicting-posts", f"another post says what becomes of `{local_name(effect.property)}`"
        case (Assert() as true, Retract() as false) | (Retract() as false, Assert() as true):
            if any(covers(_holds(false), link) for link in conflicts.implied(_holds(true))):
                return "contradicting-posts", _OPPOSITE
    return None


def _report_either(name: str, message: str, post: Requirement, earlier: Requirement) -> Diagnostic:
    labels = (Label(earlier.condition.span, "the other one", is_cause=True),)
    return Diagnostic(name, post.condition.span, message, "keep one of the two", labels=labels)


def _holds(effect: Assert | Retract) -> Holds:
    return Holds(effect.subject, effect.relation, effect.object)
