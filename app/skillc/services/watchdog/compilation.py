"""Tells when functions are compiled, which may take longer than a tick."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from skillc_runtime.motion.numerics.compiled import LISTENERS


@contextmanager
def watching_compilation(changed: Callable[[int], None]) -> Iterator[None]:
    """Call `changed` with 1 whenever a function begins to be compiled or loaded, and with -1 when that ends."""
    LISTENERS.append(changed)
    try:
        yield
    finally:
        LISTENERS.remove(changed)
