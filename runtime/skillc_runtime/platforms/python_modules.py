"""Imports the Python modules that libraries, ontologies and scenes name; a server says at its start which these are."""

from __future__ import annotations

import os
from collections.abc import Iterable
from importlib import import_module
from types import ModuleType

VARIABLE = "SKILLC_MODULES"
"""The environment variable that lists the only modules that may be imported here, separated by commas."""
SHIPPED = "skillc_runtime."
"""How the names of modules begin that may always be imported."""


def import_named(module: str) -> ModuleType:
    """Import a module that a text names; ImportError if that may not be imported in this process."""
    allowed = os.environ.get(VARIABLE)
    if allowed is not None and not module.startswith(SHIPPED) and module not in allowed.split(","):
        raise ImportError(f"the server was not started with the Python module {module}; start it again")
    return import_module(module)


def make_environment(modules: Iterable[str]) -> dict[str, str]:
    """Return the variable for a process that may import only these modules, and so may those that it starts."""
    return {VARIABLE: ",".join(modules)}
