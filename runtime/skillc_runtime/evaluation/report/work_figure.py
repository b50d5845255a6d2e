"""A figure of a piece of work, as it goes into a report: what it shows, and how it is drawn."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import msgspec
from msgspec.structs import replace

from skillc_runtime.evaluation.report.figure_files import FigureFiles

if TYPE_CHECKING:
    from matplotlib.figure import Figure


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


def number_files(figures: Sequence[WorkFigure]) -> tuple[WorkFigure, ...]:
    """Return figures whose files have names of their own: a number follows where several had the same."""
    names = [each.file for each in figures]
    counts = [names[: index + 1].count(name) for index, name in enumerate(names)]
    several = [names.count(name) > 1 for name in names]
    return tuple(
        replace(each, file=f"{each.file}-{count}") if repeated else each
        for each, count, repeated in zip(figures, counts, several, strict=True)
    )
