"""The two tasks of the demo with physics, with its seed."""

from __future__ import annotations

from pathlib import Path

from behaviour.kinds._runs import save_run
from behaviour.product import Product, write

SIMULATES = True
TASKS = ("clean_whiteboard", "clean_table")


def save(product: Product, folder: Path) -> None:
    """Run each task, and the demo itself."""
    for task in TASKS:
        save_run(product, folder, task, "--seed", "1")
    write(folder / "demo.json", product.tell("demo", "--json"))
