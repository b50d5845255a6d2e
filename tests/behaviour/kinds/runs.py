"""All shipped tasks with ideal motion and contact."""

from __future__ import annotations

from pathlib import Path

from behaviour.kinds._runs import save_run
from behaviour.product import Product

SIMULATES = False


def save(product: Product, folder: Path) -> None:
    """Run each task."""
    for task in product.tasks():
        save_run(product, folder, task["name"], "--backend", "kinematic", "--seed", "1")
