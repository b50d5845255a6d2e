"""The inverse of the changes that the posts of a scoped skill wrote."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_runtime.world.state.changes import AddRelation, Change, ClearProperty, RemoveRelation, SetProperty
from skillc_runtime.world.state.values import are_equal
from skillc_runtime.world.state.world_state import WorldState


def inverse_changes(
    changes: Sequence[Change], before: WorldState, after: WorldState, now: WorldState
) -> tuple[Change, ...]:
    """Return the changes to `now` that undo `changes`, which led from `before` to `after`.

    A fact that has changed since `after` is left unchanged.
    """
    return tuple(inverse for change in reversed(changes) for inverse in _invert(change, before, after, now))


def _invert(change: Change, before: WorldState, after: WorldState, now: WorldState) -> Iterator[Change]:
    if isinstance(change, SetProperty):
        yield from _invert_property(change, before, after, now)
    elif isinstance(change, AddRelation) and not before.holds(change.subject, change.relation, change.object):
        yield from _invert_relation(change, before, now)
    elif isinstance(change, RemoveRelation) and _is_still_removed(change, before, now):
        yield AddRelation(change.subject, change.relation, change.object)


def _is_still_removed(change: RemoveRelation, before: WorldState, now: WorldState) -> bool:
    fact = (change.subject, change.relation, change.object)
    return before.holds(*fact) and not now.holds(*fact)


def _invert_property(change: SetProperty, before: WorldState, after: WorldState, now: WorldState) -> Iterator[Change]:
    former, ours, current = (state.value(change.individual, change.property) for state in (before, after, now))
    if current is None or ours is None or not are_equal(current, ours):
        return
    if former is None:
        yield ClearProperty(change.individual, change.property)
    else:
        yield SetProperty(change.individual, change.property, former)


def _invert_relation(change: AddRelation, before: WorldState, now: WorldState) -> Iterator[Change]:
    subject, relation, object_ = change.subject, change.relation, change.object
    if not now.holds(subject, relation, object_):
        return
    yield RemoveRelation(subject, relation, object_)
    for implied, flipped in now.axioms.implied[relation]:
        term = now.vocabulary.relations[implied]
        start, end = (object_, subject) if flipped else (subject, object_)
        if term.functional:
            yield from (AddRelation(start, implied, former) for former in sorted(before.objects(start, implied)))
        if term.inverse_functional:
            yield from (AddRelation(former, implied, end) for former in sorted(before.subjects(implied, end)))
