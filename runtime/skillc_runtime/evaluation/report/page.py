"""A task's report as one self-contained HTML page, which stays small when a run has thousands of steps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from skillc_runtime.evaluation.pages.page import make_page
from skillc_runtime.evaluation.report.figure import DrawnFigure
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.table import (
    PLACEMENT_COLUMNS,
    format_choice_reason,
    format_step,
    list_failure_details,
    list_table_rows,
    split_placement,
)
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from skillc_runtime.recording.known_facts import format_false_claim, format_status, format_unverified, unverified_facts
from skillc_runtime.world.state.labels.labelled_text import format_value

if TYPE_CHECKING:
    from skillc_runtime.film.footage import FilmFiles

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

MOST_ROWS, LAST_ROWS = 100, 10
"""Of longer tables the first and the last rows are shown, and those that did not succeed."""

MOST_NODES = 2500
"""Of larger trees the upper nodes are shown, and those that lead to what did not succeed."""

FINE = ("success", "idle", "skipped", "not started")

T = TypeVar("T")

SYMBOLS = {
    "success": "✓", "succeeded": "✓", "failure": "✗", "failed": "✗", "refused": "✗", "halted": "■", "stopped": "■",
    "interrupted": "■", "running": "…", "idle": "·", "skipped": "·", "not started": "·", "assumed": "?",
}  # fmt: skip
"""The symbol of each status, so that colour is not needed to see it."""


def render_page(
    result: TaskResult,
    trees: Sequence[NodeOutcome],
    figures: Sequence[DrawnFigure] = (),
    filmed: FilmFiles | None = None,
    is_made: bool = True,
) -> str:
    """Return the page; `trees` are those of all attempts; the files of `filmed` are, or will be, in the same folder.

    A page loads itself again until its film is made and its figures are drawn.
    """
    return make_page(
        Path(__file__).parent / "page.html.j2",
        result=result,
        status=format_status(result.status, result.verified, result.false_claims),
        kind=_kind(result),
        claims=list(map(format_false_claim, result.false_claims)),
        unverified=shorten([format_unverified(each) for each in unverified_facts(result.facts)]),
        details=list_failure_details(result),
        rows=list_table_rows(result) if result.sim_time_s else [],
        steps=shorten(result.plan, [step.status not in FINE for step in result.plan]),
        placements=shorten(result.placements),
        format_choice_reason=format_choice_reason,
        format_step=format_step,
        format_value=format_value,
        trees=[fold_tree(tree) for tree in trees],
        split_placement=split_placement,
        placement_names=PLACEMENT_COLUMNS,
        figures=figures,
        filmed=filmed,
        is_made=is_made or not (filmed or any(each.files is None for each in figures)),
        reason=_reason,
        symbols=SYMBOLS,
    )


def _kind(result: TaskResult) -> str:
    """Return how the end of a task is marked."""
    if result.status == "succeeded" and result.false_claims:
        return "failed"
    return "assumed" if result.verified is False else result.status


def _reason(node: NodeOutcome) -> str:
    """Return why a node failed, unless a child shows the same reason."""
    if node.failure is None or any(child.failure == node.failure for child in node.children):
        return ""
    return node.failure.message


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
