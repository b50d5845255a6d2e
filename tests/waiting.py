"""How long tests wait for what other processes and threads do."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

LONG_S = 300.0
"""Longer than anything takes that does not hang, in s, on a busy machine that stands still at times too."""


def wait_until(look: Callable[[], T], every_s: float = 0.02) -> T:
    """Look again and again until what is found is true; return it."""
    end = time.monotonic() + LONG_S
    while not (found := look()):
        assert time.monotonic() < end, f"it does not come about: {found!r}"
        time.sleep(every_s)
    return found
