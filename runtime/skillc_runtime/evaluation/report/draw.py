"""Draws the figure of each kind of work; matplotlib, which takes long to import, is imported with the first figure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from skillc_runtime.evaluation.report.drive_drawing import DriveDrawing
    from skillc_runtime.evaluation.report.guidances import FreePeriod
    from skillc_runtime.evaluation.report.handling_drawing import HandlingDrawing
    from skillc_runtime.evaluation.report.push_drawing import PushDrawing
    from skillc_runtime.evaluation.report.search_drawing import SearchDrawing
    from skillc_runtime.evaluation.report.wiping_drawing import WipingDrawing


def draw_wipings(drawings: Sequence[WipingDrawing]) -> Figure:
    """Return the figure of wipings."""
    from skillc_runtime.evaluation.report.wiping_figure import draw_figure

    return draw_figure(drawings)


def draw_push(drawing: PushDrawing) -> Figure:
    """Return the figure of a push."""
    from skillc_runtime.evaluation.report import push_figure

    return push_figure.draw_push(drawing)


def draw_search(drawing: SearchDrawing) -> Figure:
    """Return the figure of a search."""
    from skillc_runtime.evaluation.report import search_figure

    return search_figure.draw_search(drawing)


def draw_guidance(period: FreePeriod) -> Figure:
    """Return the figure of an arm that is guided by hand."""
    from skillc_runtime.evaluation.report import guidance_figure

    return guidance_figure.draw_guidance(period)


def draw_path(drawing: HandlingDrawing, across: int) -> Figure:
    """Return the figure of the path of a hand; `across` is the axis of the world that lies across."""
    from skillc_runtime.evaluation.report import path_figure

    return path_figure.draw_path(drawing, across)


def draw_grips(drawing: HandlingDrawing) -> Figure:
    """Return the figure of the picks of a hand."""
    from skillc_runtime.evaluation.report import grip_figure

    return grip_figure.draw_grips(drawing)


def draw_drive(drawing: DriveDrawing) -> Figure:
    """Return the figure of a mobile base."""
    from skillc_runtime.evaluation.report import drive_figure

    return drive_figure.draw_drive(drawing)
