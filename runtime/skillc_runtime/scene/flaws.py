"""Places what is wrong with a world as a whole in the files that say it."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from skillc_compiler.turtle.problems import Place, Problem
from skillc_compiler.turtle.statements import Statement
from skillc_compiler.turtle.terms import RDF_TYPE
from skillc_runtime.scene.checks.containment import circular
from skillc_runtime.scene.checks.data_sheets import unsuited
from skillc_runtime.scene.checks.frames import misplaced
from skillc_runtime.scene.checks.plausible import implausible
from skillc_runtime.scene.checks.required import incomplete
from skillc_runtime.scene.checks.surface_regions import astray
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.scene.violation import Flaw
from skillc_runtime.world.state.world_state import WorldState


def flaws(
    state: WorldState, said: Sequence[Statement], problems: Collection[Problem], doubtful: Collection[str]
) -> Iterator[Problem]:
    """Yield what is wrong with individuals of which every statement made sense.

    Where things are is looked at only when there is no other problem: a frame may be missing because of it.
    """
    troubled = {*doubtful, *_subjects(said, problems)}
    found = [*circular(state), *incomplete(state), *implausible(state), *unsuited(state)]
    if not problems and not doubtful:
        found += list(misplaced(state)) or astray(state)
    places = {(iri_of(each.subject), each.predicate): each for each in reversed(said)}
    for flaw in found:
        if flaw.individual not in troubled:
            yield Problem(_place(flaw, places), flaw.name, flaw.message, flaw.help)


def _subjects(said: Sequence[Statement], problems: Collection[Problem]) -> Iterator[str]:
    """Yield the individuals whose statements have problems."""
    if not problems:
        return
    wrong = {problem.place for problem in problems}
    for each in said:
        if not wrong.isdisjoint((each.subject_place, each.predicate_place, each.object_place)):
            yield iri_of(each.subject)


def _place(flaw: Flaw, places: dict[tuple[str, str], Statement]) -> Place:
    if flaw.predicate is not None:
        return places[flaw.individual, flaw.predicate].object_place
    return places[flaw.individual, RDF_TYPE].subject_place
