"""Where the runtime keeps what it makes or fetches once: where the language does, which it must not know."""

from __future__ import annotations

import os
from pathlib import Path

VARIABLE = "SKILLC_CACHE"
"""The environment variable with skillc's cache folder; else it is `skillc` in the user's."""


def cache_folder() -> Path | None:
    """Return skillc's cache folder, which may have to be made; None for a user without a home."""
    if named := os.environ.get(VARIABLE):
        return Path(named).absolute()
    try:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    except RuntimeError:
        return None
    return base / "skillc" if base.is_absolute() else None
