"""Work in contact, and sorting, with physics."""

from __future__ import annotations

from pathlib import Path

from behaviour.kinds._runs import save_run
from behaviour.product import Product

SIMULATES = True


def save(product: Product, folder: Path) -> None:
    """Run each task of both libraries."""
    for task in product.tasks():
        if task["library"] in ("contact", "sorting"):
            save_run(product, folder, task["name"], "--seed", "0")
