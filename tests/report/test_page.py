"""The page of a report: for every reader, without anything from elsewhere, and small however long the run was."""

from __future__ import annotations

import re

import numpy as np
from matplotlib.figure import Figure
from msgspec import structs

from skillc_dsl.position import Position
from skillc_runtime.evaluation.report.figure import DrawnFigure, WorkFigure, number_files, render_figure
from skillc_runtime.evaluation.report.page import render_page
from skillc_runtime.evaluation.report.plotting import INK, MOST_POINTS, TRUTH, count_columns, thin_curve
from skillc_runtime.evaluation.report.result import GraspResult, PlacementResult, StepResult, TaskResult
from skillc_runtime.evaluation.report.table import list_table_rows
from skillc_runtime.recording.history.node_outcome import NodeOutcome

HERE = Position(path="sort.skill", line=1, column=1)
STEP = StepResult(
    number="1", skill="Pick", implementation="from_above", arguments={}, source="sort.skill:1", status="success"
)
RESULT = TaskResult(task="sort", status="failed", plan=(STEP,), sim_time_s=12.0, failure="the part slipped")


def draw_line() -> Figure:
    figure = Figure()
    figure.subplots().plot([0, 1], [0, 1], color=TRUTH, label="force: simulator truth")
    figure.axes[0].set_xlabel("time & more, s")
    return figure


def make_figure(file: str = "push") -> WorkFigure:
    return WorkFigure(file, "Force of Press on Button 1", "Forces.", 'Force <over> "time"', draw_line)


def draw_page(result: TaskResult = RESULT, *trees: NodeOutcome) -> str:
    return render_page(result, trees, [DrawnFigure(make_figure(), render_figure(draw_line))])


def call(number: int, status: str, *below: NodeOutcome) -> NodeOutcome:
    return NodeOutcome(
        id=number, name=f"Call{number}", kind="call", status=status, source=HERE, started=0.0, ended=1.0, children=below
    )


def test_figures_are_part_of_the_page_with_text_in_the_colours_of_its_theme() -> None:
    page = draw_page()
    (svg,) = re.findall(r"<svg.*?</svg>", page, re.DOTALL)
    assert ">time &amp; more, s</text>" in svg and "<title" not in svg
    assert "var(--truth)" in svg and "var(--ink)" in svg
    assert TRUTH not in svg and INK not in svg
    assert 'aria-label="Force &lt;over> &quot;time&quot;"' in svg
    assert re.search(r"<svg[^>]* width=", svg) is None, "it is as wide as the page"


def test_the_page_is_read_in_the_dark_on_paper_and_on_a_phone_and_loads_nothing() -> None:
    page = draw_page()
    for wanted in ("prefers-color-scheme: dark", "@media print", "max-width: 48rem", 'name="viewport"', "overflow-x"):
        assert wanted in page
    loaded = re.findall(r'(?:src|href)="(?!#|data:)([^"]*)"', page)
    assert loaded == [] and "@import" not in page and "url(http" not in page
    variables = set(re.findall(r"var\((--[\w]+)\)", page))
    for theme in re.findall(r":root \{(.*?)\}", page, re.DOTALL):
        assert variables <= set(re.findall(r"(--\w+):", theme))


def test_no_status_is_told_by_colour_alone() -> None:
    page = draw_page(RESULT, call(1, "failure", call(2, "success"), call(3, "halted"), call(4, "idle")))
    assert "✗ failed" in page and "✓ success" in page
    for status, symbol in (("failure", "✗"), ("halted", "■"), ("idle", "·")):
        assert f'<span class="{status}" title="{status}">{symbol}</span>' in page


def test_the_page_of_three_thousand_steps_is_small_and_shows_what_failed() -> None:
    steps = [structs.replace(STEP, number=str(each)) for each in range(1, 3001)]
    steps[1500] = structs.replace(steps[1500], skill="Drop", status="failure")
    placed = PlacementResult(
        thing="lab:Part", holder="lab:Box", is_held=False, holder_known="", known="assumed by Release",
        believed_m=(0.1, 0.2, 0.3), true_m=(0.1, 0.2, 0.3), error_m=0.0, turned_deg=0.0,
    )  # fmt: skip
    grasp = GraspResult(
        thing="lab:Part", gripper="lab:Hand", grasped_s=1.0, released_s=2.0, force_n=30.0, opening_mm=40.0
    )
    result = structs.replace(RESULT, plan=tuple(steps), placements=(placed,) * 3000, works=(grasp,) * 3000)
    calls = [call(10 * each, "success", *(call(10 * each + k, "success") for k in range(8))) for each in range(3000)]
    calls[1500] = call(15000, "failure", call(15001, "failure"))
    page = draw_page(result, call(1, "failure", *calls))
    assert len(page) < 2_000_000
    assert "1501 Drop" in page and "Call15001" in page
    assert page.count("more steps are in result.json") == 1 and "are in events.jsonl" in page
    assert len(list_table_rows(result)) < 100


def test_a_long_curve_is_thinned_without_losing_its_peak() -> None:
    time = np.linspace(0.0, 3600.0, 360_000)
    force = np.sin(time)
    force[123_456] = 40.0
    x, y = thin_curve(time, force)
    assert len(x) <= 1.1 * MOST_POINTS and y.max() == 40.0 and x[y.argmax()] == time[123_456]


def test_files_of_several_figures_of_a_kind_have_numbers() -> None:
    files = [each.file for each in number_files([make_figure("push"), make_figure("path"), make_figure("push")])]
    assert files == ["push-1", "path", "push-2"]


def test_a_legend_has_as_many_columns_as_fit() -> None:
    assert count_columns(["short"] * 4) == 4
    assert count_columns(["a name that is as long as names of curves are"] * 6) == 2
