"""Which facts were sensed since a skill started, so that nothing else passes for a measurement."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_compiler.library.conditions import And, Condition
from skillc_compiler.library.skills import Post
from skillc_runtime.tree.enclosing import Frame
from skillc_runtime.world.eval.grounds import Ground, grounds
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.evidence import Established, statement
from skillc_runtime.world.state.facts import fact_text
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.values import equal


def unsensed(changes: Sequence[Change], world: WorldModel, begun: int) -> tuple[Change, ...]:
    """Return the changes that are more than what devices have told since the write of the number `begun`.

    What was sensed stays so; it is not written again as an assumption.
    """
    return tuple(change for change in changes if not _told(change, world, begun))


def not_sensed(post: Post, world: WorldModel, frame: Frame, begun: int) -> str | None:
    """Say why a `sensed` post that holds is no measurement made since the write `begun`; None where it is one."""
    for literal in _literals(post.condition):
        found = grounds(literal, world, frame)
        assumed = next((ground for ground in found if ground.assumed), None)
        if assumed is not None:
            return f"`{post.text}` must be sensed, but {_said(assumed, world)}"
        if not any(_fresh(ground.established, begun) for ground in found):
            old = f": {'; '.join(_said(ground, world) for ground in found)}" if found else ""
            return f"`{post.text}` must be sensed, and nothing has sensed it since the skill started{old}"
    return None


def _told(change: Change, world: WorldModel, begun: int) -> bool:
    state, fact = world.snapshot(), statement(change)
    match change:
        case AddRelation(subject, relation, object_) | RemoveRelation(subject, relation, object_):
            so = state.holds(subject, relation, object_) is isinstance(change, AddRelation)
        case SetProperty(individual, property_, value):
            present = state.value(individual, property_)
            so = present is not None and equal(present, value)
        case _:
            return False
    return so and fact is not None and _fresh(world.known(fact), begun)


def _fresh(established: Established | None, begun: int) -> bool:
    return established is not None and established.number > begun and established.evidence in ("sensed", "reported")


def _literals(condition: Condition) -> Iterator[Condition]:
    if isinstance(condition, And):
        for part in condition.parts:
            yield from _literals(part)
    else:
        yield condition


def _said(ground: Ground, world: WorldModel) -> str:
    """Return a fact with how it is known, as `lab:A contain lab:B` was assumed by Place."""
    fact = fact_text(ground.fact, world.snapshot())
    known = ground.established
    if known is None or known.evidence is None:
        return f"`{fact}` was so before"
    by = f" by {known.origin}" if known.origin else ""
    return f"`{fact}` was {known.evidence}{by}"
