"""Saves runs: what is printed, the result, the sequence of events, and the digest of all recorded signals."""

from __future__ import annotations

import hashlib
from pathlib import Path

from behaviour.product import Product, file_name, write

KEPT = ("result.json", "events.jsonl")


def save_run(product: Product, folder: Path, task: str, *options: str) -> None:
    """Run a task without a film."""
    name = file_name(task)
    told = product.tell("run", task, *options, "--out", name, "--no-film", "--signals", "csv", "--json")
    write(folder / name / "told.txt", told)
    for kept in KEPT:
        if (path := product.work / name / kept).exists():
            write(folder / name / kept, path.read_text("utf-8"))
    files = sorted(each for each in (product.work / name).rglob("*") if each.is_file())
    lines = (f"{each.relative_to(product.work / name).as_posix()} {_digest(each)}".rstrip() for each in files)
    write(folder / name / "files.txt", "\n".join(lines) + "\n")


def _digest(path: Path) -> str:
    """Return the digest of a file with signals: the same run has the same ones; other files may have dates."""
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.suffix == ".csv" else ""
