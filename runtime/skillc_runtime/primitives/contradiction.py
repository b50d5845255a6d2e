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
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.evidence import describe_evidence, stated_fact
from skillc_runtime.world.state.facts import RelationFact
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.labels.labelling import label_fact

if TYPE_CHECKING:
    from skillc_runtime.world.state.model import WorldModel
    from skillc_runtime.world.state.world_state import WorldState


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
    """Withdraw, as sensed, where a thing is, which was looked for in the place `at`; return the failure."""
    before = world.snapshot()
    contradict(world, skill, displacement_changes(before, thing, at), failure)
    suppose_around(world, thing, before, skill, at)
    return failure


def suppose_around(world: WorldModel, thing: str, before: WorldState, origin: str, at: str | None = None) -> None:
    """Assume a thing, withdrawn from where it was `before`, somewhere in the area around, but not in the place `at`.

    It can be looked for there: its pose in the world stays as it was, though only as the last one that is known.
    """
    after, near = world.snapshot(), holders_of(before, thing)
    supposed = (*last_known_changes(before, after, thing), *search_changes(after, thing, near, at))
    if supposed:
        world.commit(supposed, origin, "assumed")


def _describe_withdrawn(changes: tuple[Change, ...], world: WorldModel) -> list[str]:
    """Return the relations that hold until the changes are written, each with its evidence."""
    state, found = world.snapshot(), []
    for fact in map(stated_fact, changes):
        if isinstance(fact, RelationFact) and not fact.holds and state.holds(fact.subject, fact.relation, fact.object):
            lost = RelationFact(fact.subject, fact.relation, fact.object)
            found.append(f"`{format_fact(label_fact(lost, state))}` ({describe_evidence(world.deciding_write(lost))})")
    return found
