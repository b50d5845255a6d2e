"""What is sensed, and outcomes of which not exactly one comes true."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from skillc_compiler.logic.conflicts import Conflicts
from skillc_compiler.logic.conjunctions import equal_names, facts_in, rename_fact
from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Requirement, Skill, Test
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_model.conditions import Assert, Assign, Individual, PropertyOf, Variable
from skillc_rdf.vocabulary.types import local_name

NAMES = (
    "outcome-not-literal",
    "outcomes-overlap",
    "outcome-leaves-open",
    "bad-likelihood",
    "senses-no-property",
    "single-outcome",
    "repeated-outcome",
)
NEEDS = Need.NAMES
READS = Reads.DECLARATION
_TOLERANCE = 1e-9
"""By so much the sum of what is likely may differ from 1, since its parts are decimal fractions."""


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield the problems of `senses` and `outcome` lines, and of the outcomes that tests state."""
    conflicts = Conflicts(program.vocabulary)
    for skill in program.skills.values():
        yield from _check_number(skill)
        yield from _check_literals(skill)
        yield from _check_sensed(skill)
        yield from _check_likelihoods(skill.outcomes)
        yield from _check_exclusion(conflicts, skill)
    for task in program.tasks:
        if isinstance(task, Test):
            yield from _check_repeated(task)


def _check_number(skill: Skill) -> Iterator[Diagnostic]:
    if len(skill.outcomes) == 1:
        yield Diagnostic(
            "single-outcome",
            skill.outcomes[0].span,
            f"`{skill.name}` has one outcome only, so that it always comes true",
            help="write the other outcomes, or what is always true afterwards as `post sensed`",
        )


def _check_literals(skill: Skill) -> Iterator[Diagnostic]:
    for outcome in skill.outcomes:
        for part in effects_of(outcome.condition):
            if isinstance(part, NoEffect):
                yield Diagnostic(
                    "outcome-not-literal",
                    part.span,
                    f"this does not say what is true after this outcome: {part.reason}",
                    help="write relations and `property == value` joined by `and`",
                )


def _check_sensed(skill: Skill) -> Iterator[Diagnostic]:
    """Report what cannot be sensed, and outcomes after which it would not be known."""
    for value in skill.senses:
        match value.meaning:
            case PropertyOf(of=Variable() | Individual()) as sensed:
                yield from _check_left_open(skill, value, sensed)
            case _:
                yield Diagnostic(
                    "senses-no-property",
                    value.span,
                    "`senses` takes a property of a parameter or of an individual",
                    help="write it as in `senses part.grade`",
                )


def _check_left_open(skill: Skill, value: TypedExpression, sensed: PropertyOf) -> Iterator[Diagnostic]:
    name = local_name(sensed.property)
    if not skill.outcomes:
        yield Diagnostic(
            "senses-no-property",
            value.span,
            f"`{skill.name}` does not say which values of `{name}` it may sense",
            help="write an `outcome` line for each, or `post sensed THING has PROPERTY` if it can be any value",
        )
    for outcome in skill.outcomes:
        if not any(_says(each, sensed) for each in effects_of(outcome.condition)):
            yield Diagnostic(
                "outcome-leaves-open",
                outcome.span,
                f"after this outcome `{name}` is not known, which `{skill.name}` senses",
                help=f"say which value `{name}` has then",
                labels=(Label(value.span, "this is sensed"),),
            )


def _says(effect: object, sensed: PropertyOf) -> bool:
    """Whether an effect says which value something has, also one of an enumeration, which a relation leads to."""
    match effect:
        case Assign(subject=of, property=iri) | Assert(subject=of, relation=iri):
            return (of, iri) == (sensed.of, sensed.property)
        case _:
            return False


def _check_likelihoods(outcomes: Sequence[Requirement]) -> Iterator[Diagnostic]:
    stated = [each.likely for each in outcomes if each.likely is not None]
    wrong = [each for each in stated if not 0.0 <= each.value <= 1.0]
    for number in wrong:
        yield Diagnostic("bad-likelihood", number.span, "this is not between 0 and 1", "such as `likely 0.9`")
    total = sum(each.value for each in stated)
    if wrong or not stated:
        return
    if total > 1.0 + _TOLERANCE:
        message = f"the outcomes are likely by {total:g} in all, which is more than 1"
        yield Diagnostic("bad-likelihood", stated[-1].span, message, "write smaller numbers, or leave one out")
    elif total < 1.0 - _TOLERANCE and len(stated) == len(outcomes):
        message = f"the outcomes are likely by {total:g} in all, which is less than 1"
        yield Diagnostic("bad-likelihood", stated[-1].span, message, "leave out the last `likely`: it is what remains")


def _check_exclusion(conflicts: Conflicts, skill: Skill) -> Iterator[Diagnostic]:
    """Report outcomes that can both hold."""
    names = equal_names(skill.requirements)
    facts = {id(each): [rename_fact(fact, names) for fact in facts_in(each.condition)] for each in skill.outcomes}
    for one, other in combinations(skill.outcomes, 2):
        if not any(conflicts.exclude(mine, theirs) for mine in facts[id(one)] for theirs in facts[id(other)]):
            yield Diagnostic(
                "outcomes-overlap",
                other.span,
                "this outcome and another one can hold at the same time, so that it is not clear which has come true",
                help="let them differ in the value of a property, or let one say `not` where the other does not",
                labels=(Label(one.span, "the other outcome"),),
            )


def _check_repeated(test: Test) -> Iterator[Diagnostic]:
    first: dict[str, Label] = {}
    for each in test.outcomes:
        if each.skill is None:
            continue
        label = Label(each.span, "the first one")
        if first.setdefault(each.skill.name, label) is not label:
            message = f"it is stated already what comes of `{each.skill.name}`"
            yield Diagnostic(
                "repeated-outcome", each.span, message, "keep one of the two", labels=(first[each.skill.name],)
            )
