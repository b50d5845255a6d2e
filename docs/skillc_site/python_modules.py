"""The reference of the Python API, a page for each public module, made from its docstrings by mkdocstrings."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from functools import partial

FURTHER = ("backends", "collision", "controllers", "devices", "events", "primitives", "space", "vision", "world")
MODULES = ("skillc", *(f"skillc.{name}" for name in FURTHER))
"""The modules that programs of others may import from."""


def module_page(name: str) -> str:
    """Return the page of a module as Markdown: what it is for, and a directive for each exported name."""
    module = importlib.import_module(name)
    directives = (f"::: {name}.{exported}" for exported in sorted(module.__all__, key=str.lower))
    return "\n\n".join((f"# {name}", (module.__doc__ or "").partition("\n\n")[0], *directives)) + "\n"


MODULE_PAGES: Mapping[str, Callable[[], str]] = {f"{name}.md": partial(module_page, name) for name in MODULES}
