"""Keeps the cyclic garbage collector from looking through trees without cycles, and through what stays for ever."""

from __future__ import annotations

import gc
import sys
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


@contextmanager
def importing() -> Iterator[None]:
    """Look for no garbage in the block, which only imports modules; what it leaves, which stays, is exempt for ever.

    For programs: looking through what hundreds of modules leave takes a tenth of the time of their imports.
    """
    before = len(sys.modules)
    with gc_disabled():
        yield
        if len(sys.modules) > before:
            gc.freeze()


def exempt_from_gc() -> None:
    """Collect garbage now, and exempt all that is left from later collections.

    For processes that live long: a collection of everything holds up all threads for 0.1 s.
    """
    gc.collect()
    gc.freeze()
