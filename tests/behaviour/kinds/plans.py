"""The plans for all shipped tasks."""

from __future__ import annotations

from pathlib import Path

from behaviour.product import Product, file_name, write

SIMULATES = False
SEVERAL_ROBOTS = ("clean_both", "share_eraser")


def save(product: Product, folder: Path) -> None:
    """Plan for each task; where there are several robots, also for the shortest time."""
    for task in product.tasks():
        name = task["name"]
        write(folder / f"{file_name(name)}.json", product.tell("plan", name, "--json", "--no-plan-cache"))
        write(folder / f"{file_name(name)}.txt", product.tell("plan", name))
    for name in SEVERAL_ROBOTS:
        told = product.tell("plan", name, "--json", "--no-plan-cache", "--minimise", "makespan")
        write(folder / f"{name}-makespan.json", told)
