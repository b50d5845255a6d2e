"""Imports hundreds of modules in less time: no garbage is looked for while they are imported, nor among them later."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from skillc_dsl.garbage import exempt_for_ever, gc_disabled


@contextmanager
def importing() -> Iterator[None]:
    """Import what a program needs in the block, which does nothing else.

    What it leaves, which stays, is exempt from collections of garbage for ever.
    """
    before = len(sys.modules)
    with gc_disabled():
        yield
        if len(sys.modules) > before:
            exempt_for_ever()
