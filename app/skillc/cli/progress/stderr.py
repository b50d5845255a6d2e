"""Progress on stderr: a bar on a terminal, elsewhere plain lines by those who show it."""

from __future__ import annotations

import sys
from types import TracebackType
from typing import Any, Self

from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, TextColumn, TimeRemainingColumn

from skillc.cli.console import find_display_obstacle, rich_console
from skillc.cli.settings import output_settings


class StderrProgress:
    """A bar for what is done of a total, with further columns; use it in a `with` statement. Nothing if `quiet`."""

    def __init__(self, task: str, total: int, done: int, quiet: bool, *columns: ProgressColumn, **fields: Any) -> None:
        self._console = rich_console(sys.stderr)
        self._is_quiet = quiet or output_settings().quiet
        hidden = self._is_quiet or find_display_obstacle() is not None
        shown = (
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            *columns,
        )
        self._bar = Progress(*shown, console=self._console, disable=hidden, transient=True)
        self._row = self._bar.add_task(task, total=total, completed=done, **fields)

    @property
    def _prints_lines(self) -> bool:
        """Whether lines are printed, since there is no bar."""
        return self._bar.disable and not self._is_quiet

    def __enter__(self) -> Self:
        self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.stop()
