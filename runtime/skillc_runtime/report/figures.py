"""Figures of a wiping run as PNG: path and coverage on the surface, force and tilt over time."""

from __future__ import annotations

from io import BytesIO

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array

MILLIMETRES = 1000.0
REFERENCE, ACTUAL, WIPED, LIMIT = "#9aa3ad", "#1f5fa8", "#cfe8d5", "#b3402a"


def path_figure(extent: Array, wiped: NDArray[np.bool_], reference: Array, actual: Array) -> bytes:
    """Draw the reference and the actual path over what was wiped.

    extent (2,): size of the surface in m. wiped (rows, columns): cells along y and x. reference, actual (n, 2): m, in
    the surface frame, whose origin is the middle.
    """
    figure = Figure(figsize=(7.2, 5.6), layout="constrained")
    axes = figure.add_subplot()
    half = extent / 2 * MILLIMETRES
    box = (-half[0], half[0], -half[1], half[1])
    axes.imshow(np.where(wiped, 1.0, 0.0), extent=box, origin="lower", cmap=_two_colours(), vmin=0, vmax=1)
    axes.plot(*(reference.T * MILLIMETRES), color=REFERENCE, linewidth=1.2, label="reference")
    axes.plot(*(actual.T * MILLIMETRES), color=ACTUAL, linewidth=0.9, label="tool")
    axes.plot([], [], color=WIPED, linewidth=8, label=f"wiped, {wiped.mean():.1%}")
    axes.set(xlabel="x in mm", ylabel="y in mm", title="Path of the tool on the surface", aspect="equal")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=3, frameon=False)
    return _png(figure)


def force_figure(time: Array, force: Array, commanded: float, window: tuple[float, float]) -> bytes:
    """Draw the normal force (n,) in N over time (n,) in s, with the commanded force and the window that is judged."""
    figure = Figure(figsize=(9.6, 3.2), layout="constrained")
    axes = figure.add_subplot()
    axes.axvspan(*window, color=WIPED, alpha=0.6, linewidth=0, label="wiping")
    axes.plot(time, force, color=ACTUAL, linewidth=0.5, label="normal force")
    axes.axhline(commanded, color=LIMIT, linewidth=1.0, label=f"commanded, {commanded:g} N")
    axes.set(xlabel="time in s", ylabel="force in N", title="Force on the surface", xlim=(time[0], time[-1]))
    axes.set_ylim(bottom=0)
    axes.legend(loc="upper left", ncols=3, frameon=False)
    return _png(figure)


def _two_colours() -> ListedColormap:
    return ListedColormap(["#f4e6d8", WIPED])


def _png(figure: Figure) -> bytes:
    buffer = BytesIO()
    figure.savefig(buffer, format="png", dpi=130, metadata={"Software": ""})
    return buffer.getvalue()
