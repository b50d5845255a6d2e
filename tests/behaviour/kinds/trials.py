"""Ten trials of wiping on each arm."""

from __future__ import annotations

from pathlib import Path

from behaviour.product import Product, write

SIMULATES = True
TASKS = ("clean_whiteboard", "clean_table", "clean_desk")


def save(product: Product, folder: Path) -> None:
    """Try each task with the same seeds."""
    for task in TASKS:
        told = product.tell("trials", task, "-n", "10", "--seed", "8000", "--jobs", "1", "--json")
        write(folder / f"{task}.json", told)
