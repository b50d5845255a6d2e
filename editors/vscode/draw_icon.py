"""Draws the icon of the extension, an arm between braces: `python editors/vscode/draw_icon.py`."""

from __future__ import annotations

from pathlib import Path

from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyBboxPatch, PathPatch
from matplotlib.path import Path as Outline

FILE = Path(__file__).parent / "icon.png"
PIXELS = 256
GROUND, BRACE, ARM, JOINT = "#17324d", "#f2b134", "#e9eef3", "#2f9e8f"
BRACE_POINTS = ((31, 20), (19, 20), (27, 45), (15, 50), (27, 55), (19, 80), (31, 80))
ARM_POINTS = ((42, 28), (46, 54), (62, 65), (62, 46))


def main() -> None:
    """Write the icon."""
    figure = Figure(figsize=(1, 1), dpi=PIXELS)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, 100), ylim=(0, 100))
    axes.axis("off")
    plate = FancyBboxPatch((8, 8), 84, 84, boxstyle="round,pad=6,rounding_size=18", color=GROUND, linewidth=0)
    axes.add_patch(plate)
    codes = [Outline.MOVETO, *[Outline.CURVE4] * 6]
    for sign, offset in ((1, 0), (-1, 100)):
        points = [(offset + sign * x, y) for x, y in BRACE_POINTS]
        axes.add_patch(
            PathPatch(
                Outline(points, codes), fill=False, edgecolor=BRACE, linewidth=5, capstyle="round", joinstyle="round"
            )
        )
    axes.plot(*zip(*ARM_POINTS, strict=True), color=ARM, linewidth=6, solid_capstyle="round", solid_joinstyle="round")
    axes.plot((36, 48), (27, 27), color=ARM, linewidth=6, solid_capstyle="round")
    for x in (57, 67):
        axes.plot((62, x, x), (46, 42, 36), color=ARM, linewidth=3, solid_capstyle="round", solid_joinstyle="round")
    for joint in ARM_POINTS[1:3]:
        axes.add_patch(Circle(joint, 4.6, color=JOINT, zorder=3))
    figure.savefig(FILE, transparent=True, metadata={"Software": None})


if __name__ == "__main__":
    main()
