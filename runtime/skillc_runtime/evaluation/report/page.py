"""A task's report as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from jinja2 import Environment, PackageLoader, StrictUndefined

from skillc_runtime.evaluation.report.folding import FINE, fold_tree, shorten
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.table import (
    PLACEMENT_COLUMNS,
    format_choice_reason,
    format_step,
    list_failure_details,
    list_table_rows,
    split_placement,
)
from skillc_runtime.evaluation.report.work_figure import DrawnFigure
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from skillc_runtime.recording.known_facts import format_false_claim, format_status, format_unverified, unverified_facts
from skillc_runtime.world.state.labels.labelled_text import format_value

if TYPE_CHECKING:
    from skillc_runtime.film.footage import FilmFiles

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
    environment = Environment(
        loader=PackageLoader("skillc_runtime.evaluation.report", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template("page.html.j2").render(
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
