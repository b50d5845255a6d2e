"""Two conditions that cannot both hold.

Told of preconditions and holds, those an implementation adds included, of goals and of conditions in bodies. A relation
that has one value only, one that goes one way only, values of properties, classes and who is said to be the same are
taken into account.

Bad:

    use skiros, rparts
    skill Take {
        in   gripper: GripperEffector
        in   object:  Product
        pre  empty: not gripper contain _
        pre  held:  gripper contain object
        noplan
    }
    impl waiting of Take { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts
    skill Take {
        in   gripper: GripperEffector
        in   object:  Product
        pre  held:  gripper contain object
        noplan
    }
    impl waiting of Take { run python "skillc_runtime.primitives.stand_in:StandIn" }
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.logic.conflicts import Conflicts
from skillc_compiler.logic.conjunctions import Fact, Together, names_of, renamed, together
from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("contradicting-conditions",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each fact that an earlier one excludes."""
    conflicts = Conflicts(program.vocabulary)
    for group in together(program):
        yield from _in_group(conflicts, group)


def _in_group(conflicts: Conflicts, group: Together) -> Iterator[Diagnostic]:
    names = names_of((*group.given, *group.own))
    earlier = [renamed(fact, names) for fact in group.given]
    for fact in (renamed(each, names) for each in group.own):
        against = next((other for other in earlier if conflicts.between(other, fact)), None)
        if against is not None:
            yield _problem(fact, against)
        earlier.append(fact)


def _problem(fact: Fact, against: Fact) -> Diagnostic:
    return Diagnostic(
        "contradicting-conditions",
        fact.source.span,
        "this contradicts another condition, so they never hold together",
        help="keep one of the two, or join them with `or`",
        labels=(Label(against.source.span, "the other one"),),
    )
