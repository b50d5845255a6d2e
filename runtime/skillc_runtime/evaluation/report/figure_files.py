"""Figures as files: PNG and SVG, the same bytes for the same figure."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

DOTS_PER_INCH = 120

STYLE: dict[Any, Any] = {"font.size": 9, "axes.titlesize": 10, "legend.fontsize": 8, "svg.hashsalt": "skillc"}


@dataclass(frozen=True, slots=True)
class FigureFiles:
    """A figure in two formats, the same bytes for the same drawings."""

    png: bytes
    svg: bytes


@dataclass(frozen=True, slots=True)
class NamedFigure:
    """A figure of a report: what it shows, such as `path`, and the display name of the hand; empty if it shows all."""

    kind: str
    of: str
    files: FigureFiles

    @property
    def data(self) -> str:
        """The SVG file in base64."""
        return b64encode(self.files.svg).decode()


def render_figure(draw: Callable[[], Figure]) -> FigureFiles:
    """Return the files of the figure that a function draws."""
    with mpl.rc_context(STYLE):
        figure = draw()
        png = _save(figure, "png", {"Software": ""})
        figure.set_layout_engine("none")
        return FigureFiles(png, _save(figure, "svg", {"Date": None, "Creator": None}))


def _save(figure: Figure, form: str, metadata: dict[str, str | None]) -> bytes:
    buffer = BytesIO()
    figure.savefig(buffer, format=form, dpi=DOTS_PER_INCH, metadata=metadata)
    return buffer.getvalue()
