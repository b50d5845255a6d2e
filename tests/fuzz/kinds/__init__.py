"""The kinds of input; a file in this folder is a kind, nothing else need be edited."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from random import Random
from typing import Protocol, cast


class Kind(Protocol):
    """What a module in this folder is."""

    def run_case(self, random: Random, folder: Path) -> None:
        """Make an input, write it into `folder` and try it; raise when the product breaks a promise."""
        ...


def kind_names() -> list[str]:
    """Return the names of all kinds."""
    return sorted(module.name for module in iter_modules(__path__) if not module.name.startswith("_"))


def load_kind(name: str) -> Kind:
    """Return a kind by its name."""
    return cast(Kind, import_module(f"{__name__}.{name}"))


def seconds_of(kind: Kind) -> float:
    """Return how long one case may take, in seconds of processor time."""
    return float(getattr(kind, "SECONDS", 10.0))
