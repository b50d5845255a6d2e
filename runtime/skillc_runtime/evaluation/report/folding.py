"""Shortens what is long in a report, so that the page of a run of thousands of steps stays small."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from skillc_runtime.recording.history.node_outcome import NodeOutcome

MOST_ROWS, LAST_ROWS = 100, 10
"""Of longer tables the first and the last rows are shown, and those that did not succeed."""

MOST_NODES = 2500
"""Of larger trees the upper nodes are shown, and those that lead to what did not succeed."""

FINE = ("success", "idle", "skipped", "not started")

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Shortened(Generic[T]):
    """The rows of a table that are shown, each with its number from 1, and how many are not."""

    rows: tuple[tuple[int, T], ...]
    left_out: int


def shorten(rows: Sequence[T], kept: Sequence[bool] = ()) -> Shortened[T]:
    """Return the first and the last rows, and those that are `kept`, at most twice MOST_ROWS."""
    if len(rows) <= MOST_ROWS:
        return Shortened(tuple(enumerate(rows, 1)), 0)
    last = range(len(rows) - LAST_ROWS, len(rows))
    special = [index for index, wanted in enumerate(kept) if wanted][:MOST_ROWS]
    shown = sorted({*range(MOST_ROWS - LAST_ROWS), *special, *last})
    return Shortened(tuple((index + 1, rows[index]) for index in shown), len(rows) - len(shown))


@dataclass(frozen=True, slots=True)
class Branch:
    """A node of a tree with those of its children that are shown, and the number of the others."""

    node: NodeOutcome
    children: tuple[Branch, ...]
    left_out: int


def fold_tree(tree: NodeOutcome) -> Branch:
    """Return a tree with at most about MOST_NODES nodes."""
    kept = {id(node) for node in _first_nodes(tree, MOST_NODES)} | set(_failing(tree))
    return _build(tree, kept)


def _first_nodes(tree: NodeOutcome, count: int) -> Iterator[NodeOutcome]:
    """Yield the nodes that are nearest to the root; of many siblings the first ones."""
    waiting = deque([tree])
    while waiting and count > 0:
        node = waiting.popleft()
        count -= 1
        yield node
        waiting.extend(node.children if len(node.children) <= MOST_ROWS else node.children[:MOST_ROWS])


def _failing(tree: NodeOutcome) -> Iterator[int]:
    """Yield the identities of the first nodes that did not succeed, from the root on."""
    found = (id(node) for node in tree.nodes() if node.status not in FINE)
    yield from (each for _, each in zip(range(MOST_NODES), found, strict=False))


def _build(node: NodeOutcome, kept: set[int]) -> Branch:
    children = tuple(_build(each, kept) for each in node.children if id(each) in kept)
    return Branch(node, children, len(node.children) - len(children))
