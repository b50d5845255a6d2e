"""Tells when functions are compiled, which may take longer than a tick."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from skillc_runtime.motion.numerics.compiled import COMPILES


@contextmanager
def watching_compilation(changed: Callable[[int], None]) -> Iterator[None]:
    """Call `changed` with 1 whenever a function begins to be compiled or loaded, and with -1 when that ends."""
    if not COMPILES:
        yield
        return
    event: Any = import_module("numba.core.event")
    methods = {"on_start": lambda *_: changed(1), "on_end": lambda *_: changed(-1)}
    listener = type("CompilationListener", (event.Listener,), methods)()
    event.register("numba:compile", listener)
    try:
        yield
    finally:
        event.unregister("numba:compile", listener)
