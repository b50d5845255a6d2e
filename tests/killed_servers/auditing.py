"""Counts what the history of a cell of a yard has lost or has twice, after its process or its server was killed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec

from running_cells.yard import CRATES
from skillc.cells.database import DatabaseError
from skillc.cells.journal.reading import JournalReader, RecordedOperation
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import ImplementationChosen, NodeEnded, TaskEnded, WorldChanged
from skillc_runtime.world.state.changes import AddRelation, RemoveRelation
from skillc_runtime.world.state.terms import CONTAIN
from skillc_runtime.world.state.transactions import Transaction

BY_HAND = "it was done by hand"
"""Why steps are skipped."""
Place = tuple[str, str]
"""A location and what it contains, as local names."""


@dataclass(frozen=True, slots=True)
class Faults:
    """What was found that must not be: all are 0 if the promises are kept."""

    facts_lost: int = 0
    facts_twice: int = 0
    steps_repeated: int = 0
    histories_unreadable: int = 0
    jobs_lost: int = 0


def audit(journal: Path, seen: Mapping[str, Sequence[dict[str, Any]]], places: set[Place]) -> Faults:
    """Compare a journal with the events that a client saw of each operation, and with the world of the cell."""
    try:
        with closing(JournalReader(journal)) as reader:
            operations = {each.id: each for each in reader.latest(2**62, 10_000)}
            histories = {each: _read_all(reader, each) for each in operations}
            writes = [each.transaction for each in reader.writes()]
    except DatabaseError:
        return Faults(histories_unreadable=1)
    unreadable = sum(not _is_whole(each) for each in histories.values())
    changes = [change for write in writes for change in write.changes]
    recorded = [
        change
        for history in histories.values()
        for each in history
        if isinstance(each.event, WorldChanged)
        for change in each.event.changes
    ]
    replayed, twice = _replay(writes)
    numbers = [each.sequence for each in writes]
    lost = (
        sum(_count_missing(events, histories.get(name, ())) for name, events in seen.items())
        + len(set(range(2, len(writes) + 2)) - set(numbers))
        + abs(len(changes) - len(recorded))
        + len(replayed - places)
    )
    return Faults(lost, twice + len(places - replayed), _count_repeated(operations, histories), unreadable)


def _read_all(reader: JournalReader, operation: str) -> tuple[Envelope, ...]:
    found = list[Envelope]()
    while more := reader.envelopes(operation, len(found)):
        found += more
    return tuple(found)


def _is_whole(history: Sequence[Envelope]) -> bool:
    """Whether a history has no gap, and an end, and nothing after it."""
    ends = [number for number, each in enumerate(history, 1) if isinstance(each.event, TaskEnded)]
    return [each.sequence for each in history] == [*range(1, len(history) + 1)] and ends == [len(history)]


def _count_missing(seen: Sequence[dict[str, Any]], history: Sequence[Envelope]) -> int:
    """Return how many events that a client saw are not in a history, as they were."""
    kept = msgspec.json.decode(msgspec.json.encode(history))
    return sum(each != other for each, other in zip(seen, kept, strict=False)) + max(0, len(seen) - len(kept))


def _replay(writes: Sequence[Transaction]) -> tuple[set[Place], int]:
    """Return what is where after writes to the world of a yard, and how many effects of skills were effects before.

    Who skips a step states its effects, whether they were known before or not.
    """
    places, twice = {("Start", f"crate-{number}") for number in range(CRATES)}, 0
    for write in writes:
        for change in write.changes:
            match change:
                case AddRelation(subject, relation, object_) if relation == CONTAIN:
                    place = _local(subject), _local(object_)
                    twice += place in places and BY_HAND not in write.origin
                    places.add(place)
                case RemoveRelation(subject, relation, object_) if relation == CONTAIN:
                    places.discard((_local(subject), _local(object_)))
                case _:
                    pass
    return places, twice


def _local(iri: str) -> str:
    return iri.rpartition("#")[2]


def _count_repeated(operations: Mapping[str, RecordedOperation], histories: Mapping[str, Sequence[Envelope]]) -> int:
    """Return how many steps were begun again without a decision that allows it."""
    return sum(
        _count_repeats(operation, operations, histories) for operation in operations.values() if histories[operation.id]
    )


def _count_repeats(
    operation: RecordedOperation,
    operations: Mapping[str, RecordedOperation],
    histories: Mapping[str, Sequence[Envelope]],
) -> int:
    """Return how many steps of an operation were begun again though they were done, by a skill or by hand.

    One that ran at a crash may be begun again, by a decision.
    """
    begun = Counter(key for key, _ in _steps(histories[operation.id]))
    within = sum(count - 1 for count in begun.values())
    done, following = set[str](), operation
    while (earlier := operations.get(following.request.continues)) is not None:
        skipped = following.request.decision == "skip"
        done |= {key for key, succeeded in _steps(histories[earlier.id]) if succeeded or skipped}
        following = earlier
    return within + len(begun.keys() & done)


def _steps(history: Sequence[Envelope]) -> list[tuple[str, bool]]:
    """Return the steps that an operation began, and whether each has succeeded."""
    events = [each.event for each in history]
    succeeded = {each.node for each in events if isinstance(each, NodeEnded) and each.status == "success"}
    chosen = [each for each in events if isinstance(each, ImplementationChosen)]
    return [(f"{each.skill} {each.bindings['crate']}", each.node in succeeded) for each in chosen]
