"""Keeps the cyclic garbage collector from looking through trees without cycles, and through what stays for ever."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def gc_disabled() -> Iterator[None]:
    """Disable the garbage collector for the block, if it is enabled; objects made in the block are collected later."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


def exempt_from_gc() -> None:
    """Collect garbage now, and exempt all that is left from later collections.

    For processes that live long: a collection of everything holds up all threads for 0.1 s.
    """
    gc.collect()
    gc.freeze()
