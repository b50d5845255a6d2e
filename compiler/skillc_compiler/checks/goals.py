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
from skillc_model.conditions import Compare, Holds, PropertyOf
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
        reported: set[str] = set()
        for condition in conditions_in(task.goal) if task.goal else ():
            term = _term(condition)
            if term is not None and term not in reported and not _may_change(term, written, program.vocabulary):
                reported.add(term)
                yield Diagnostic(
                    "unachievable-goal",
                    condition.span,
                    f"no skill of this library changes `{local_name(term)}`",
                    help="import the file with the skill that does, or state it as a post of one",
                    severity="warning",
                )


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
