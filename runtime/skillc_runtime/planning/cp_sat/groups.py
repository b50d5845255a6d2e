"""Finds groups of facts of which exactly one holds at any time, such as the places where one robot may be."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

from skillc_model.pddl.formulas import Atom
from skillc_runtime.planning.cp_sat.task import Activity, list_conjuncts


def find_groups(
    facts: Mapping[Atom, int], activities: Sequence[Activity], true: Sequence[int]
) -> tuple[tuple[int, ...], ...]:
    """Return disjoint groups of the numbers of facts that differ in one term only.

    One of a group holds at first, and each activity that changes the group ends one that it needs and begins one: so
    exactly one holds at any time (an invariant as of Helmert, "Concise finite-domain representations", 2009).
    """
    touching: dict[int, set[int]] = defaultdict(set)
    for number, activity in enumerate(activities):
        for literal in activity.effects:
            touching[abs(literal)].add(number)
    taken: set[int] = set()
    found = []
    for group in _list_candidates(facts):
        changing = set().union(*(touching[each] for each in group))
        if (
            len(group) > 1
            and taken.isdisjoint(group)
            and len(group.intersection(true)) == 1
            and all(_exchanges(activities[each], group) for each in changing)
        ):
            taken |= group
            found.append(tuple(sorted(group)))
    return tuple(found)


def _list_candidates(facts: Mapping[Atom, int]) -> list[set[int]]:
    """Return the sets of facts that differ in one term, the largest first."""
    candidates: dict[tuple[object, ...], set[int]] = defaultdict(set)
    for atom, number in facts.items():
        for place in range(len(atom.terms)):
            rest = atom.terms[:place] + atom.terms[place + 1 :]
            candidates[atom.predicate, place, *rest].add(number)
    return sorted(candidates.values(), key=lambda each: (-len(each), min(each)))


def _exchanges(activity: Activity, group: set[int]) -> bool:
    """Whether an activity begins exactly one fact of a group and ends exactly one, which it needs."""
    begun = [each for each in activity.effects if each in group]
    ended = [-each for each in activity.effects if -each in group]
    needed = [each for each in list_conjuncts(activity.need) if each in group]
    return len(begun) == 1 and ended == needed and len(ended) == 1
