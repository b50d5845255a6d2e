"""Figures as files: PNG and SVG, the same bytes for the same figure; matplotlib is imported for the first one."""

from __future__ import annotations

import re
from collections.abc import Callable
from io import BytesIO
from threading import Lock
from typing import TYPE_CHECKING

import msgspec

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DOTS_PER_INCH = 120

_DRAWING = Lock()
"""Held while a figure is drawn: the settings of matplotlib are those of all threads."""

THEMED = ("INK", "DIM", "PAPER", "GRID", "SHADE", "TRUTH", "SENSOR", "ESTIMATE")
"""The colours that a page may replace, by their names in `figure_style`."""


class FigureFiles(msgspec.Struct, frozen=True):
    """A figure in two formats, the same bytes for the same drawings."""

    png: bytes
    svg: bytes

    def embed_svg(self, alternative: str) -> str:
        """Return the SVG as an element of a page, whose colours follow the variables `--ink`, `--paper` and others.

        `alternative` describes the figure to those who cannot see it.
        """
        from skillc_runtime.evaluation.report import figure_style

        text = self.svg.decode()
        text = re.sub(r"<metadata>.*?</metadata>", "", text[text.index("<svg") :], flags=re.DOTALL)
        for name in THEMED:
            text = text.replace(getattr(figure_style, name), f"var(--{name.lower()})")
        text = re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1", text, count=1)
        text = re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", text, count=1)
        return text.replace("<svg", f'<svg role="img" aria-label="{_escape(alternative)}"', 1)


def render_figure(draw: Callable[[], Figure]) -> FigureFiles:
    """Return the files of the figure that a function draws."""
    import matplotlib as mpl

    from skillc_runtime.evaluation.report import figure_style

    with _DRAWING, mpl.rc_context(figure_style.STYLE):
        figure = draw()
        _lay_out(figure)
        png = _save(figure, "png", {"Software": ""})
        return FigureFiles(png, _save(figure, "svg", {"Date": None, "Creator": None}))


def _lay_out(figure: Figure) -> None:
    """Place what is in a figure, once for all files; saving it would draw it once more for that."""
    figure.dpi = DOTS_PER_INCH
    if (engine := figure.get_layout_engine()) is not None:
        engine.execute(figure)
        figure.set_layout_engine("none")


def _save(figure: Figure, form: str, metadata: dict[str, str | None]) -> bytes:
    buffer = BytesIO()
    figure.savefig(buffer, format=form, dpi=DOTS_PER_INCH, metadata=metadata)
    return buffer.getvalue()


def _escape(text: str) -> str:
    return text.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")
