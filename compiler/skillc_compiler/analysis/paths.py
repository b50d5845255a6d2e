"""How a state was reached: the path of steps, the shortest one of those that lead to the same state."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

import msgspec

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.havoc import havoc
from skillc_compiler.analysis.knowledge.state import State, join
from skillc_compiler.analysis.knowledge.writes import Write
from skillc_compiler.program.typed import TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Label
from skillc_dsl.source import Span

MAX_STATES = 64
"""The number of states that are kept apart at one point of a body; more are widened to what they have in common."""
MAX_LABELS = 7
"""The number of steps of a path that are shown."""


class PathStep(msgspec.Struct, frozen=True):
    """The last step of a path, and the path before it; `failed` if it is a call that failed."""

    before: PathStep | None
    span: Span
    event: str
    length: int
    failed: bool = False

    def __iter__(self) -> Iterator[PathStep]:
        """Yield the steps from the first to this one."""
        steps, step = [self], self.before
        while step is not None:
            steps.append(step)
            step = step.before
        return reversed(steps)


Path: TypeAlias = PathStep | None
StatePaths: TypeAlias = Mapping[State, Path]
"""Reachable states, each with the shortest path to it."""


@dataclass
class EndStates:
    """The states in which a node can end, by outcome; `broken` is a failure by a hold, which `try` does not catch."""

    success: dict[State, Path] = field(default_factory=dict)
    failure: dict[State, Path] = field(default_factory=dict)
    broken: dict[State, Path] = field(default_factory=dict)

    def add_failures(self, other: EndStates) -> None:
        """Add the failures of another node."""
        add_states(self.failure, other.failure)
        add_states(self.broken, other.broken)

    @property
    def failed(self) -> dict[State, Path]:
        """The states after any failure."""
        found = dict(self.failure)
        add_states(found, self.broken)
        return found


def extend_path(path: Path, span: Span, event: str, failed: bool = False) -> PathStep:
    """Return the path with one more step."""
    return PathStep(path, span, event, path_length(path) + 1, failed)


def leads_through(path: Path, calls: Collection[Span]) -> bool:
    """Whether a path leads through the start of any of these calls, not only past their failure."""
    return bool(calls) and path is not None and any(step.span in calls and not step.failed for step in path)


def ends_in_finally(body: object, path: PathStep) -> bool:
    """Whether the last step of a path stands in the second block of a `finally`, whose failure changes no result."""
    if not isinstance(body, TypedNode):
        return False
    ends = (node.orelse for node in nodes_in(body) if isinstance(node.written, s.Finally))
    return any(path.span == inner.written.span for after in ends for each in after for inner in nodes_in(each))


def extend_if_new(before: State, after: State, path: Path, span: Span, text: str, holds: bool) -> Path:
    """Return the path after a condition was checked, extended if that changed what is known."""
    return path if after is before else extend_path(path, span, f"`{text}` {'holds' if holds else 'does not hold'}")


def path_length(path: Path) -> int:
    """Return the number of steps of a path."""
    return 0 if path is None else path.length


def add_state(states: dict[State, Path], state: State, path: Path) -> None:
    """Add a reachable state; of several paths to it the shortest is kept."""
    if state not in states or path_length(path) < path_length(states[state]):
        states[state] = path


def add_states(states: dict[State, Path], more: StatePaths) -> None:
    """Add several reachable states."""
    for state, path in more.items():
        add_state(states, state, path)


def widen(states: StatePaths) -> dict[State, Path]:
    """Return the same states, or what they have in common if there are too many, for each state of the monitor."""
    if len(states) <= MAX_STATES:
        return dict(states)
    found: dict[tuple[int, bool], tuple[State, Path]] = {}
    for state, path in states.items():
        if state.monitor in found:
            known, shortest = found[state.monitor]
            found[state.monitor] = (join(known, state), min(shortest, path, key=path_length))
        else:
            found[state.monitor] = (state, path)
    return dict(found.values())


def havoc_all(types: AliasTypes, states: StatePaths, writes: Iterable[Write]) -> dict[State, Path]:
    """Return what is still known in each state after any of these writes may have happened."""
    changed = tuple(writes)
    found: dict[State, Path] = {}
    for state, path in states.items():
        add_state(found, havoc(types, state, changed), path)
    return found


def path_labels(path: Path) -> tuple[Label, ...]:
    """Return the path as numbered labels in source lines; of a long path, its begin and its end."""
    steps = list(path) if path is not None else []
    numbered = [Label(each.span, f"{number} {each.event}") for number, each in enumerate(steps, 1)]
    return tuple(numbered if len(numbered) <= MAX_LABELS else (*numbered[:2], *numbered[-(MAX_LABELS - 2) :]))
