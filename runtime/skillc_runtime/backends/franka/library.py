"""The client library of the Franka Control Interface, which only cells of such arms need."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from skillc_runtime.devices.backend import BackendUnavailable

INSTALL = "pip install 'skillc[franka]'"


def load_library() -> ModuleType:
    """Return pylibfranka; BackendUnavailable, with what to do, where it is not installed."""
    try:
        return import_module("pylibfranka")
    except ImportError as error:
        raise BackendUnavailable(
            f"pylibfranka cannot be imported ({error}): {INSTALL}; it is made for Linux only"
        ) from error
