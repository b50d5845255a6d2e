"""How a state was reached: the steps that led there, the shortest way of those that lead to the same state."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from skillc_compiler.analysis.forgetting import forgotten
from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import State, joined
from skillc_compiler.analysis.writes import Write
from skillc_dsl.diagnostics import Label
from skillc_dsl.source import Span

LIMIT = 64
"""So many states are told apart at one point of a body; when there are more, only what all have in common is kept."""
SHOWN = 7


@dataclass(frozen=True, slots=True)
class Trail:
    """What happened last, and what before it."""

    before: Trail | None
    span: Span
    event: str
    length: int

    def __iter__(self) -> Iterator[Trail]:
        if self.before is not None:
            yield from self.before
        yield self


Way: TypeAlias = Trail | None
Ways: TypeAlias = Mapping[State, Way]
"""States that can be reached, each with the shortest way to it."""


@dataclass
class Ends:
    """The states in which a node can end, by how it ends; `broken` is a failure by a hold, which `try` keeps."""

    success: dict[State, Way] = field(default_factory=dict)
    failure: dict[State, Way] = field(default_factory=dict)
    broken: dict[State, Way] = field(default_factory=dict)

    def add_failures(self, other: Ends) -> None:
        """Take over how another node fails."""
        merge(self.failure, other.failure)
        merge(self.broken, other.broken)

    @property
    def failed(self) -> dict[State, Way]:
        """The states after any failure."""
        found = dict(self.failure)
        merge(found, self.broken)
        return found


def step(way: Way, span: Span, event: str) -> Trail:
    """Return the way with one more step."""
    return Trail(way, span, event, length(way) + 1)


def decided(before: State, after: State, way: Way, span: Span, text: str, holds: bool) -> Way:
    """Return the way after a condition was looked at; where it was known before, nothing happened."""
    return way if after is before else step(way, span, f"`{text}` {'holds' if holds else 'does not hold'}")


def length(way: Way) -> int:
    """Return how many steps a way has."""
    return 0 if way is None else way.length


def add(ways: dict[State, Way], state: State, way: Way) -> None:
    """Note that a state can be reached."""
    if state not in ways or length(way) < length(ways[state]):
        ways[state] = way


def merge(ways: dict[State, Way], more: Ways) -> None:
    """Note that all these states can be reached."""
    for state, way in more.items():
        add(ways, state, way)


def few(ways: Ways) -> dict[State, Way]:
    """Return the same, or what the states have in common when there are too many; those watched apart stay apart."""
    if len(ways) <= LIMIT:
        return dict(ways)
    found: dict[tuple[int, bool], tuple[State, Way]] = {}
    for state, way in ways.items():
        if state.monitor in found:
            known, shortest = found[state.monitor]
            found[state.monitor] = (joined(known, state), min(shortest, way, key=length))
        else:
            found[state.monitor] = (state, way)
    return dict(found.values())


def after(sorts: Sorts, ways: Ways, writes: Iterable[Write]) -> dict[State, Way]:
    """Return what is still known after any of these may have been written."""
    changed = tuple(writes)
    found: dict[State, Way] = {}
    for state, way in ways.items():
        add(found, forgotten(sorts, state, changed), way)
    return found


def labels(way: Way) -> tuple[Label, ...]:
    """Return the way as numbered labels in source lines; of a long one, how it begins and how it ends."""
    steps = list(way) if way is not None else []
    numbered = [Label(each.span, f"{number} {each.event}") for number, each in enumerate(steps, 1)]
    return tuple(numbered if len(numbered) <= SHOWN else (*numbered[:2], *numbered[-(SHOWN - 2) :]))
