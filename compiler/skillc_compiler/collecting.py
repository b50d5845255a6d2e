"""Work without the collector of cyclic garbage: trees have no cycles, and looking for them costs a tenth more time."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def no_collection() -> Iterator[None]:
    """Let the collector rest meanwhile, if it is at work; what is made here is looked through later."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
