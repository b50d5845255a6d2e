"""A goal that no skill of the library can bring about."""

from __future__ import annotations

from collections.abc import Iterator, Set

from skillc_compiler.library.conditions import Assert, Assign, Compare, Holds, PropertyOf, Retract
from skillc_compiler.library.vocabulary import Vocabulary, local_name
from skillc_compiler.logic.effects import NoEffect, effects
from skillc_compiler.program.typed import Program, TypedCondition
from skillc_compiler.program.walk import clauses_in
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("unachievable-goal",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each relation or property of a task's goal that no planned skill changes."""
    if not program.files:
        return
    changed = _changed(program)
    for task in program.tasks:
        told: set[str] = set()
        for clause in clauses_in(task.goal) if task.goal else ():
            term = _term(clause)
            if term is not None and term not in told and not _may_change(term, changed, program.vocabulary):
                told.add(term)
                yield Diagnostic(
                    "unachievable-goal",
                    clause.span,
                    f"no skill of this library changes `{local_name(term)}`",
                    help="import the file with the skill that does, or state it as a post of one",
                    severity="warning",
                )


def _term(clause: TypedCondition) -> str | None:
    match clause.meaning:
        case Holds(relation=relation):
            return relation
        case Compare(left=PropertyOf(property=name)) | Compare(right=PropertyOf(property=name)):
            return name
    return None


def _may_change(term: str, changed: Set[str], vocabulary: Vocabulary) -> bool:
    """Whether skills change a relation or property, or what it is computed from; nobody may know what that is."""
    relation, property_ = vocabulary.relations.get(term), vocabulary.properties.get(term)
    if relation is not None and relation.computed_by is not None:
        return not relation.computed_from or not changed.isdisjoint(relation.computed_from)
    return term in changed or (property_ is not None and property_.computed_by is not None)


def _changed(program: Program) -> set[str]:
    changed: set[str] = set()
    for skill in program.skills.values():
        for post in (r for r in skill.requirements if r.kind == "post" and "noplan" not in skill.flags):
            for effect in effects(post.clause):
                match effect:
                    case Assign(property=name):
                        changed.add(name)
                    case Assert(relation=name) | Retract(relation=name):
                        changed |= _related(program.vocabulary, name)
                    case NoEffect():
                        pass
    return changed


def _related(vocabulary: Vocabulary, relation: str) -> set[str]:
    """Return a relation, those above it and their inverses."""
    above = vocabulary.super_relations.get(relation, frozenset({relation}))
    inverses = (vocabulary.relations[name].inverse for name in above if name in vocabulary.relations)
    return {*above, *(inverse for inverse in inverses if inverse)}
