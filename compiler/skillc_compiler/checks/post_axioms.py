"""A postcondition that an axiom of its relation forbids, so that the world model would refuse it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

from skillc_compiler.logic.conflicts import Conflicts, covers
from skillc_compiler.logic.conjunctions import TypedFact, equal_names, facts_in, rename_fact
from skillc_compiler.logic.related import TopicIndex, topics_of_fact
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Requirement
from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_model.conditions import Holds
from skillc_model.format_condition import format_condition
from skillc_rdf.vocabulary.types import local_name

NAMES = ("breaks-axiom",)
NEEDS = Need.TYPES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each relation that cannot be made true."""
    conflicts = Conflicts(program.vocabulary)
    for own, given in program.list_requirements():
        yield from _check_posts(conflicts, own, given)


def _check_posts(
    conflicts: Conflicts, own: Sequence[Requirement], given: Sequence[Requirement]
) -> Iterator[Diagnostic]:
    whole = (*given, *own)
    names = equal_names(whole)
    posts = [
        (rename_fact(fact, names), post, is_own)
        for requirements, is_own in ((given, False), (own, True))
        for post in requirements
        if post.kind == "post"
        for fact in facts_in(post.condition)
    ]
    pre = (rename_fact(fact, names) for r in whole if r.kind == "pre" for fact in facts_in(r.condition))
    gone, before, staying = TopicIndex[Holds](), TopicIndex[TypedFact](), TopicIndex[TypedFact]()
    for fact, _, _ in posts:
        if not fact.holds and isinstance(fact.meaning, Holds):
            gone.add(fact.meaning, topics_of_fact(conflicts, fact))
    for fact in pre:
        if fact.holds and not _is_undone(conflicts, fact, gone):
            staying.add(fact, topics_of_fact(conflicts, fact))
    for fact, post, is_own in posts:
        if fact.holds and isinstance(fact.meaning, Holds):
            topics = tuple(topics_of_fact(conflicts, fact))
            others = chain(before.related(topics), staying.related(topics))
            yield from _check_axioms(conflicts, fact, fact.meaning, post, others) if is_own else ()
            before.add(fact, topics)


def _is_undone(conflicts: Conflicts, fact: TypedFact, gone: TopicIndex[Holds]) -> bool:
    if not isinstance(fact.meaning, Holds):
        return True
    links = tuple(conflicts.implied(fact.meaning))
    return any(covers(absent, link) for absent in gone.related(topics_of_fact(conflicts, fact)) for link in links)


def _check_axioms(
    conflicts: Conflicts, fact: TypedFact, meaning: Holds, post: Requirement, others: Iterable[TypedFact]
) -> Iterator[Diagnostic]:
    name = local_name(meaning.relation)
    if conflicts.is_impossible(meaning):
        message = f"nothing can be related to itself by `{name}`"
        yield Diagnostic("breaks-axiom", fact.source.span, message, "name another individual on one side")
    back = next(
        (o for o in others if isinstance(o.meaning, Holds) and conflicts.are_opposite(meaning, o.meaning)), None
    )
    if back is not None:
        text = f"post not {format_condition(back.meaning, conflicts.vocabulary)}"
        yield Diagnostic(
            "breaks-axiom",
            fact.source.span,
            f"`{name}` is asymmetric, and it still holds in the other direction",
            f"state that it no longer does: `{text}`",
            labels=(Label(back.condition.span, "the other direction"),),
            fix=Fix(post.span.after, f"\n{' ' * (post.span.column - 1)}{text}", f"add `{text}`"),
        )
