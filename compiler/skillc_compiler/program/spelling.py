"""Corrections of misspelt names."""

from __future__ import annotations

from collections.abc import Iterable

from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Fix
from skillc_dsl.spelling import close_names


def suggest_fix(wrong: s.Name, candidates: Iterable[str]) -> Fix | None:
    """Return the edit that replaces a name by the one candidate close to it, None if none or several are close."""
    near = close_names(wrong.text, candidates)
    if len(near) != 1:
        return None
    return Fix(wrong.span, near[0], f"write `{near[0]}`", safe=False)
