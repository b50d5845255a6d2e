"""A display on a terminal that changes: a spinner beside its first line, a bar, and more lines."""

from __future__ import annotations

import sys

from rich.console import Group, RenderableType
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.spinner import Spinner
from rich.table import Table
from rich.text import Text

from skillc.cli.console import is_unicode, rich_console
from skillc.cli.progress.run_display import format_estimate
from skillc.cli.progress.run_estimate import Estimate

REFRESHES_PER_S = 12.5


class LiveDisplay:
    """What is shown on stderr until `stop`; what is printed meanwhile stays above it."""

    def __init__(self) -> None:
        self._console = rich_console(sys.stderr)
        self._spinner = Spinner("dots" if is_unicode(sys.stderr) else "line")
        self._live = Live(self._spinner, console=self._console, refresh_per_second=REFRESHES_PER_S, transient=True)
        self._live.start()

    def show(self, first: str, *more: str, estimate: Estimate | None = None) -> None:
        """Show lines, each cropped to the width of the terminal, and an estimate as a bar below the first."""
        self._spinner.update(text=_one_line(first))
        bar = [] if estimate is None else [_draw_bar(estimate, self._console.width)]
        self._live.update(Group(self._spinner, *bar, *map(_one_line, more)))

    def stop(self) -> None:
        """Remove it from the terminal."""
        self._live.stop()


def _draw_bar(estimate: Estimate, width: int) -> RenderableType:
    """Return a bar beside what an estimate says, on one line of a terminal."""
    words = format_estimate(estimate)
    line = Table.grid(padding=(0, 2))
    line.add_row("", ProgressBar(1.0, estimate.share, width=max(8, min(40, width - len(words) - 8))), _one_line(words))
    return line


def _one_line(text: str) -> Text:
    return Text(text, no_wrap=True, overflow="crop")
