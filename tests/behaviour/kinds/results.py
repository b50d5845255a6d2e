"""What commands print as JSON without a run: tasks, scenes, worlds, and all schemas."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from behaviour.product import Product, file_name, write

SIMULATES = False
SCHEMAS = ("library", "events", "result", "diagnostics", "signals", "project")


def save(product: Product, folder: Path) -> None:
    """Print what is known about each scene of a shipped task, and whatever else has no input."""
    tasks = product.tasks()
    write(folder / "tasks.json", product.tell("tasks", "--json"))
    for name in SCHEMAS:
        write(folder / f"schema-{name}.json", product.tell("schema", name))
    for scene in sorted({task["library"] + ":" + _find(task) for task in tasks}):
        library, _, path = scene.partition(":")
        name = file_name(f"{library}-{Path(path).stem}")
        write(folder / f"world-{name}.json", product.tell("world", path, "--json"))
        write(folder / f"scene-{name}.json", product.tell("scene", "show", path, "--json"))


def _find(task: dict[str, Any]) -> str:
    """Return the scene of a task: a file beside it, or the name of a shipped one."""
    beside = Path(task["file"]).with_name(task["scene"])
    return str(beside) if beside.exists() else str(task["scene"])
