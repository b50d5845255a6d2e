"""Keeps the cyclic garbage collector from looking through trees without cycles, and through what stays for ever."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_are_exempt = False
"""Whether what was there is exempt, for ever or for a block: to count what is takes as long as to look through it."""


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
    exempt_for_ever()


def exempt_for_ever() -> None:
    """Exempt all that there is from later collections."""
    global _are_exempt
    gc.freeze()
    _are_exempt = True


@contextmanager
def old_objects_exempt() -> Iterator[None]:
    """Exempt what there is from collections in the block, unless it is already, there or in another thread."""
    global _are_exempt
    if _are_exempt:
        yield
        return
    gc.freeze()
    _are_exempt = True
    try:
        yield
    finally:
        _are_exempt = False
        gc.unfreeze()
