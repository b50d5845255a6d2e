"""The public Python names, with their signatures and documentation."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from api.test_names import MODULES, _members
from behaviour.product import Product, write

SIMULATES = False


def save(product: Product, folder: Path) -> None:
    """Write a file for each public module."""
    for module in MODULES:
        write(folder / f"{module}.txt", "\n\n".join(_describe(module)) + "\n")


def _describe(module: str) -> Iterator[str]:
    for name, value in _members(module):
        yield f"{name}{_signature(value)}\n{inspect.getdoc(value) if callable(value) else ''}"


def _signature(value: Any) -> str:
    match value:
        case property():
            return _signature(value.fget)
        case staticmethod() | classmethod():
            return _signature(value.__func__)
        case _ if callable(value):
            try:
                return str(inspect.signature(value))
            except ValueError:
                return "(..)"
        case _:
            return f": {type(value).__name__}"
