"""What is saved; a file in this folder is a kind, nothing else need be edited."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Protocol, cast

from behaviour.product import Product


class Kind(Protocol):
    """What a module in this folder is. `SIMULATES` says that it computes physics, which takes minutes."""

    SIMULATES: bool

    def save(self, product: Product, folder: Path) -> None:
        """Use the product and write what it tells into files below `folder`."""
        ...


def kind_names() -> list[str]:
    """Return the names of all kinds, the quick ones first."""
    names = (module.name for module in iter_modules(__path__) if not module.name.startswith("_"))
    return sorted(names, key=lambda name: (load_kind(name).SIMULATES, name))


def load_kind(name: str) -> Kind:
    """Return a kind by its name."""
    return cast(Kind, import_module(f"{__name__}.{name}"))
