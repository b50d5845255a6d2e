"""Consoles that print text as it is: what looks like rich's markup in a goal, a name or a path is none."""

from __future__ import annotations

from rich.console import Console


def console(stderr: bool = False, quiet: bool = False) -> Console:
    """Return a console for stdout or stderr.

    A spinner and a column of a progress bar parse markup whatever their console says: give these a `Text`.
    """
    return Console(stderr=stderr, quiet=quiet, highlight=False, markup=False, emoji=False)
