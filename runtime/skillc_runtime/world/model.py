"""The world model: the one place where what is known of the world changes, version by version."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from threading import RLock
from typing import TypeAlias

from skillc_runtime.world.changes import (
    AddIndividual,
    AddRelation,
    Change,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.rules import broken, unknown
from skillc_runtime.world.state import WorldState


class WorldError(ValueError):
    """A write that was refused; the message names the axioms it breaks and the facts."""


@dataclass(frozen=True, slots=True)
class ChangeEvent:
    """A write that was made: the changes, who made them, and the versions before and after."""

    changes: tuple[Change, ...]
    origin: str
    before: WorldState
    after: WorldState


Listener: TypeAlias = Callable[[ChangeEvent], None]


class WorldModel:
    """The current version of the world and whoever wants to hear of the next."""

    def __init__(self, state: WorldState) -> None:
        self._state = state
        self._listeners: list[Listener] = []
        self._lock = RLock()

    def snapshot(self) -> WorldState:
        """Return the current version, which never changes."""
        return self._state

    def listen(self, listener: Listener) -> Callable[[], None]:
        """Call the listener after every write; return what ends that."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def commit(self, changes: Iterable[Change], origin: str = "") -> ChangeEvent:
        """Make all the changes or, when the world would break an axiom, none: WorldError says which."""
        with self._lock:
            made = tuple(changes)
            before = self._state
            strange = [iri for change in made if (iri := unknown(before, change)) is not None]
            if strange:
                raise WorldError(f"there is no relation or property {before.vocabulary.short(strange[0])}")
            after = before.changed(made)
            problems = [breach.message for change in _lasting(made) for breach in broken(after, change)]
            if problems:
                raise WorldError("; ".join(dict.fromkeys(problems)))
            self._state = after
        event = ChangeEvent(made, origin, before, after)
        for listener in tuple(self._listeners):
            listener(event)
        return event


def _lasting(changes: tuple[Change, ...]) -> list[Change]:
    """Return the changes that a later one of the same write does not take back."""
    lasting: list[Change] = []
    for change in changes:
        match change:
            case RemoveIndividual(gone):
                lasting = [each for each in lasting if not _about(each, gone)]
            case RemoveRelation(subject, relation, object_):
                lasting = [each for each in lasting if each != AddRelation(subject, relation, object_)]
            case _:
                lasting.append(change)
    return lasting


def _about(change: Change, individual: str) -> bool:
    match change:
        case AddRelation(subject, _, object_):
            return individual in (subject, object_)
        case AddIndividual(other, _) | SetProperty(other, _, _):
            return other == individual
        case _:
            return False
