"""Shows how far a film is: a line that changes on a terminal, a line a film elsewhere."""

from __future__ import annotations

import sys

from skillc.cli.console import find_display_obstacle, print_remark


class FilmProgress:
    """Shows how far films are on stderr, nothing if `quiet`."""

    def __init__(self, quiet: bool = False) -> None:
        self._is_quiet, self._changes = quiet, find_display_obstacle() is None
        self._shown = ""

    def __call__(self, name: str, share: float) -> None:
        """Show which share of a film is made; all of it removes the line that changes."""
        if self._is_quiet:
            return
        if self._changes:
            line = "" if share >= 1.0 else f"{name}: making the film, {100 * share:.0f} %"
            sys.stderr.write(f"\r{line:<{len(self._shown)}}" + ("\r" if not line else ""))
            sys.stderr.flush()
            self._shown = line
        elif self._shown != name and share < 1.0:
            print_remark(f"{name}: making the film")
            self._shown = name
