"""A figure of a report: what it shows, how it is drawn, and its files, PNG and SVG, the same for the same data."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from io import BytesIO
from threading import Lock
from typing import TYPE_CHECKING

import msgspec
from msgspec.structs import replace

from skillc_runtime.evaluation.report import plotting

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DOTS_PER_INCH = 120

_DRAWING = Lock()
"""Held while a figure is drawn: the settings of matplotlib are those of all threads."""

THEMED = ("INK", "DIM", "PAPER", "GRID", "SHADE", "TRUTH", "SENSOR", "ESTIMATE")
"""The colours that a page may replace, by their names in `plotting`."""


class FigureFiles(msgspec.Struct, frozen=True):
    """A figure in two formats, the same bytes for the same drawings."""

    png: bytes
    svg: bytes

    def embed_svg(self, alternative: str) -> str:
        """Return the SVG as an element of a page, whose colours follow the variables `--ink`, `--paper` and others.

        `alternative` describes the figure to those who cannot see it.
        """
        text = self.svg.decode()
        text = re.sub(r"<metadata>.*?</metadata>", "", text[text.index("<svg") :], flags=re.DOTALL)
        for name in THEMED:
            text = text.replace(getattr(plotting, name), f"var(--{name.lower()})")
        text = re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1", text, count=1)
        text = re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", text, count=1)
        return text.replace("<svg", f'<svg role="img" aria-label="{_escape(alternative)}"', 1)


class WorkFigure(msgspec.Struct, frozen=True):
    """A figure to be drawn.

    file: the name of its files without suffix; title: its heading; explanation: what is to be known to read it;
    alternative: what it shows, for those who cannot see it. `draw` can be pickled: another process may draw it.
    """

    file: str
    title: str
    explanation: str
    alternative: str
    draw: Callable[[], Figure]


class DrawnFigure(msgspec.Struct, frozen=True):
    """A figure with its files; None until it is drawn."""

    of: WorkFigure
    files: FigureFiles | None = None

    @property
    def element(self) -> str | None:
        """The figure as an element of a page; None until it is drawn."""
        return None if self.files is None else self.files.embed_svg(self.of.alternative)


def render_figure(draw: Callable[[], Figure]) -> FigureFiles:
    """Return the files of the figure that a function draws."""
    import matplotlib as mpl

    with _DRAWING, mpl.rc_context(plotting.STYLE):
        figure = draw()
        _lay_out(figure)
        png = _save(figure, "png", {"Software": ""})
        return FigureFiles(png, _save(figure, "svg", {"Date": None, "Creator": None}))


def number_files(figures: Sequence[WorkFigure]) -> tuple[WorkFigure, ...]:
    """Return figures whose files have names of their own: a number follows where several had the same."""
    names = [each.file for each in figures]
    counts = [names[: index + 1].count(name) for index, name in enumerate(names)]
    several = [names.count(name) > 1 for name in names]
    return tuple(
        replace(each, file=f"{each.file}-{count}") if repeated else each
        for each, count, repeated in zip(figures, counts, several, strict=True)
    )


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
