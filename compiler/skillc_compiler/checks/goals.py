"""A goal that no skill of the library can achieve."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Test
from skillc_compiler.program.walk import conditions_in
from skillc_dsl.diagnostics import Diagnostic
from skillc_model.conditions import And, Compare, Forall, Holds, PropertyOf
from skillc_model.read_write import may_change, terms_written_by
from skillc_rdf.vocabulary.types import Vocabulary, local_name

NAMES = ("unachievable-goal",)
NEEDS = Need.PROGRAM
READS = Reads.LIBRARY


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each relation or property of a task's goal that no planned skill changes."""
    if not program.files:
        return
    written = _written(program)
    for task in program.tasks:
        if isinstance(task, Test) and any(each.is_no_plan for each in task.expects):
            continue
        fixed: dict[str, TypedCondition] = {}
        for part in _parts(task.goal) if task.goal else ():
            terms = [(term, each) for each in conditions_in(part) if (term := _term(each)) is not None]
            if not any(_may_change(term, written, program.vocabulary) for term, _ in terms):
                for term, each in terms:
                    fixed.setdefault(term, each)
        for term, condition in fixed.items():
            yield Diagnostic(
                "unachievable-goal",
                condition.span,
                f"no skill of this library changes `{local_name(term)}`",
                help="import the file with the skill that does, or state it as a post of one",
                severity="warning",
            )


def _parts(goal: TypedCondition) -> Iterator[TypedCondition]:
    """Yield the conditions that all have to hold, also those of each individual that one is about.

    What else is in one of them may only choose about what it is, such as `exists h: Hall (h.isCold == true and ..)`.
    """
    match goal.meaning:
        case And() | Forall():
            for part in goal.parts:
                yield from _parts(part)
        case _:
            yield goal


def _term(condition: TypedCondition) -> str | None:
    match condition.meaning:
        case Holds(relation=relation):
            return relation
        case Compare(left=PropertyOf(property=name)) | Compare(right=PropertyOf(property=name)):
            return name
    return None


def _may_change(term: str, written: frozenset[str], vocabulary: Vocabulary) -> bool:
    """Whether skills change a relation or property, or the facts that it is computed from, which may be unknown."""
    relation = vocabulary.relations.get(term)
    if relation is not None and relation.computed_by is not None:
        return not relation.computed_from or any(
            may_change(each, written, vocabulary) for each in relation.computed_from
        )
    return vocabulary.is_computed(term) or may_change(term, written, vocabulary)


def _written(program: Program) -> frozenset[str]:
    """Return the terms that plannable skills write, as defined by `terms_written_by`."""
    planned = (skill for skill in program.skills.values() if "noplan" not in skill.flags)
    posts = (post for skill in planned for post in skill.requirements if post.says_what_comes)
    found = (effect for post in posts for effect in effects_of(post.condition) if not isinstance(effect, NoEffect))
    return frozenset[str]().union(*(terms_written_by(effect, program.vocabulary) for effect in found))
