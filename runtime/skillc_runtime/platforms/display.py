"""Whether a program with windows can be shown."""

from __future__ import annotations

import os
import sys

DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY")
"""The variables of the environment of which such a program needs one, but on macOS and Windows."""


def has_display() -> bool:
    """Tell whether the user of this process can see windows."""
    return sys.platform in ("darwin", "win32") or any(map(os.environ.get, DISPLAYS))
