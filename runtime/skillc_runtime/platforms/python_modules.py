"""Imports the Python modules that libraries, ontologies and scenes name; a server says at its start which these are."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Any

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


def defer_import(name: str) -> None:
    """Have a module that others import executed only when one of its names is first used; nothing if it is not there.

    For what a library imports and hardly anybody uses. `importlib.util.LazyLoader` executes it at the second import.
    """
    if name in sys.modules or find_spec(name) is None:
        return
    placeholder = ModuleType(name)

    def find(attribute: str) -> Any:
        if sys.modules.get(name) is placeholder:
            del sys.modules[name]
        return getattr(import_module(name), attribute)

    vars(placeholder)["__getattr__"] = find
    sys.modules[name] = placeholder
