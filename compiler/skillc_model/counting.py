"""Writes out conditions on how many individuals there are: `count(x: C where P) >= 2` is that there are two of them.

Planners need no numbers then, and a proof can tell `count(..) == 0` from what it knows.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from skillc_model.conditions import Aggregate, And, Compare, Condition, Exists, ForEach, Literal, Not, Same, Variable
from skillc_model.definitions import map_planned_conditions
from skillc_model.read_write import changing_terms, is_fixed
from skillc_model.rewriting import ALWAYS, map_children, substitute
from skillc_model.skills import Implementation, Skill, SkillLibrary
from skillc_model.traversal import free_variables, walk

MOST = 4
"""The greatest number of different individuals that a condition is written out for."""
_MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}


def write_out_counts(condition: Condition, most: int = MOST) -> Condition:
    """Return an equivalent condition in which counts are not compared with numbers up to `most`."""
    match condition:
        case Compare(left=Aggregate(function="count") as counted, operator=sign, right=Literal(value=int() as number)):
            return _compared(condition, counted, sign, number, most)
        case Compare(left=Literal(value=int() as number), operator=sign, right=Aggregate(function="count") as counted):
            return _compared(condition, counted, _MIRRORED[sign], number, most)
        case Compare():
            return condition
        case _:
            return map_children(condition, lambda part: write_out_counts(part, most))


def _compared(written: Compare, counted: Aggregate, sign: str, number: int, most: int) -> Condition:
    """Return what the comparison means, or the comparison where that needs more individuals than `most`."""
    least = {">=": number, "<": number, ">": number + 1, "<=": number + 1}.get(sign)
    if (number + 1 if least is None else least) > most or isinstance(number, bool):
        return written
    if least is not None:
        found = _at_least(counted, least)
        return Not(found) if sign in ("<", "<=") else found
    exactly = And((_at_least(counted, number), Not(_at_least(counted, number + 1))))
    return exactly if sign == "==" else Not(exactly)


def _at_least(counted: Aggregate, number: int) -> Condition:
    """Return that there are so many different individuals."""
    if number <= 0:
        return ALWAYS
    taken = free_variables(counted)
    names = [counted.variable, *(f"{counted.variable}_{place}" for place in range(2, number + 1))]
    while taken.intersection(names):
        names = [f"{name}_" for name in names]
    each = [substitute(counted.where, {counted.variable: Variable(name)}) for name in names]
    apart = (Not(Same(Variable(one), Variable(other))) for one, other in combinations(names, 2))
    found: Condition = And((*each, *apart)) if number > 1 else each[0]
    for name in reversed(names):
        found = Exists(name, counted.cls, found)
    return found


def write_out_changing_counts(library: SkillLibrary) -> SkillLibrary:
    """Return a library whose planned skills compare no count of what skills change with a small number."""
    if not any(isinstance(each, Aggregate) for condition in _conditions(library) for each in walk(condition)):
        return library
    changing = changing_terms(library)

    def written_out(condition: Condition) -> Condition:
        return condition if is_fixed(condition, changing, library.vocabulary) else write_out_counts(condition)

    return map_planned_conditions(library, written_out)


def _conditions(library: SkillLibrary) -> Iterator[Condition]:
    described: tuple[Skill | Implementation, ...] = (*library.skills.values(), *library.implementations.values())
    for one in described:
        yield from (each.condition for each in (*one.pre, *one.hold))
        yield from (effect.when for post in one.post for effect in post.effects if isinstance(effect, ForEach))
