"""The client library of the Real-Time Data Exchange, which only cells of such arms need."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from skillc_runtime.devices.backend import BackendUnavailable

INSTALL = "pip install 'skillc[ur]'"


def load_library(module: str) -> ModuleType:
    """Return a module of ur-rtde, such as `rtde_control`; BackendUnavailable, with what to do, without it."""
    try:
        return import_module(module)
    except ImportError as error:
        raise BackendUnavailable(f"ur-rtde cannot be imported ({error}): {INSTALL}") from error
