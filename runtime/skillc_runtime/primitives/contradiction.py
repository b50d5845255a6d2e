"""A measurement contradicts what the world model says: that is withdrawn at once, and the skill fails."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.space.whereabouts import (
    displacement_changes,
    holders_of,
    last_known_changes,
    search_changes,
)
from skillc_runtime.world.state.changes import Change, RemoveRelation
from skillc_runtime.world.state.evidence import describe_evidence, stated_fact
from skillc_runtime.world.state.facts import RelationFact
from skillc_runtime.world.state.labelled import label_fact
from skillc_runtime.world.state.labelled_text import format_fact

if TYPE_CHECKING:
    from skillc_runtime.world.state.model import WorldModel


def contradict(world: WorldModel, skill: str, changes: Iterable[Change], failure: SkillFailure) -> SkillFailure:
    """Write, as sensed, the changes that a measurement forces; return the failure that says what was measured.

    Both are the origin of the write: the skill and what it measured.
    """
    forced = tuple(changes)
    failure.withdrawn = tuple(_describe_withdrawn(forced, world))
    world.commit(forced, f"{skill}: {failure}", "sensed")
    return failure


def contradict_place(
    world: WorldModel, skill: str, thing: str, failure: SkillFailure, at: str | None = None
) -> SkillFailure:
    """Withdraw, as sensed, where a thing is, which was looked for in the place `at`; return the failure.

    It is then assumed somewhere in the area around, where it can be looked for.
    """
    before = world.snapshot()
    forced, near = displacement_changes(before, thing, at), holders_of(before, thing)
    contradict(world, skill, forced, failure)
    kept = last_known_changes(before, thing) if any(isinstance(each, RemoveRelation) for each in forced) else []
    supposed = (*kept, *search_changes(world.snapshot(), thing, near, at))
    if supposed:
        world.commit(supposed, skill, "assumed")
    return failure


def _describe_withdrawn(changes: tuple[Change, ...], world: WorldModel) -> list[str]:
    """Return the relations that hold until the changes are written, each with its evidence."""
    state, found = world.snapshot(), []
    for fact in map(stated_fact, changes):
        if isinstance(fact, RelationFact) and not fact.holds and state.holds(fact.subject, fact.relation, fact.object):
            lost = RelationFact(fact.subject, fact.relation, fact.object)
            found.append(f"`{format_fact(label_fact(lost, state))}` ({describe_evidence(world.deciding_write(lost))})")
    return found
