"""The figure of the fingers: how far they are open and how hard they press, a panel for each pick."""

from __future__ import annotations

from math import ceil
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from skillc_runtime.evaluation.report.handling_drawing import HandlingDrawing, Pick

MEASURED, OPENING, FORCE, HELD = "#1c2128", "#d55e00", "#0072b2", "#edf0f3"
"""Colours of the measured and the true opening, the force, and of the time in which a thing is held."""

MOST_COLUMNS, PANEL_IN, HEIGHT_IN, FRAME_IN = 3, 3.65, 2.3, 1.1
SHARE_ABOVE = 1.15
"""The scales end above the greatest value by this factor."""


def draw_grips(drawing: HandlingDrawing) -> Figure:
    """Return the figure of the picks of one hand; all panels have the same scales."""
    columns = min(MOST_COLUMNS, len(drawing.picks))
    rows = ceil(len(drawing.picks) / columns)
    figure = Figure(figsize=(PANEL_IN * max(columns, 2), HEIGHT_IN * rows + FRAME_IN), layout="constrained")
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    opening = max(1e3 * float(np.nanmax(pick.samples.opening, initial=0.0)) for pick in drawing.picks)
    force = max(float(np.nanmax(pick.samples.finger_force, initial=0.0)) for pick in drawing.picks)
    handles: dict[str, Any] = {}
    for number, (panel, pick) in enumerate(zip(panels, drawing.picks, strict=False), 1):
        _draw_opening(panel, pick, SHARE_ABOVE * opening)
        panel.set_title(f"{number}  {pick.name}", loc="left")
        if force > 0.0:
            _draw_force(panel.twinx(), pick, SHARE_ABOVE * force)
    for axes in figure.axes:
        found, names = axes.get_legend_handles_labels()
        handles |= dict(zip(names, found, strict=True))
    for panel in panels[len(drawing.picks) :]:
        panel.set_visible(False)
    figure.suptitle(f"Fingers of {drawing.hand}", x=0.01, ha="left", fontsize=10)
    figure.legend(list(handles.values()), list(handles), loc="outside lower left", ncols=2, frameon=False)
    return figure


def _draw_opening(axes: Axes, pick: Pick, greatest_mm: float) -> None:
    time, end = pick.samples.time - pick.grasped_s, pick.samples.time[-1] - pick.grasped_s
    released = end if pick.released_s is None else pick.released_s - pick.grasped_s
    axes.axvspan(0.0, released, color=HELD, linewidth=0, label="from grasp to release")
    axes.plot(time, 1e3 * pick.samples.opening, color=OPENING, linewidth=1.6, label="opening: true, by the simulator")
    axes.plot(
        time, 1e3 * pick.samples.measured_opening, color=MEASURED, linewidth=0.9, linestyle=(0, (3, 2)),
        label="opening: by the sensor of the fingers, as last read",
    )  # fmt: skip
    axes.set(xlabel="time from the grasp, s", ylabel="opening, mm", xlim=(time[0], end), ylim=(0.0, greatest_mm))
    axes.spines[["top"]].set_visible(False)


def _draw_force(axes: Axes, pick: Pick, greatest_n: float) -> None:
    """Draw the force; while a thing is held, it is that of the grasp."""
    time = pick.samples.time - pick.grasped_s
    axes.plot(
        time, pick.samples.finger_force, color=FORCE, linewidth=1.2,
        label="force of each finger: true, by the simulator; while held, that of the grasp",
    )  # fmt: skip
    axes.set_ylabel("force, N", color=FORCE)
    axes.set(ylim=(0.0, greatest_n))
    axes.tick_params(axis="y", colors=FORCE)
    axes.spines[["top"]].set_visible(False)
