"""What is said about erroneous libraries, texts and scenes: all cases of the tests."""

from __future__ import annotations

import shutil
from pathlib import Path

from behaviour.product import CASES, Product, file_name, write
from own_cell.test_ways_to_break_it import WAYS, written

SIMULATES = False


def save(product: Product, folder: Path) -> None:
    """Check each case, to be read and as JSON."""
    for kind in ("errors", "syntax"):
        for path in sorted((CASES / "cases" / kind).glob("*.skill")):
            _check(product, folder / kind / path.stem, *_copy(path, product.work / kind / path.stem))
    for path in sorted((CASES / "scene" / "cases").glob("*.ttl")):
        shutil.copy(path, product.work)
        write(folder / "scenes" / path.stem, product.tell("world", path.name))
    (product.work / "own").mkdir()
    for name, way in WAYS.items():
        written(product.work, way)
        _check(product, folder / "cells" / file_name(name), "own")


def _copy(case: Path, folder: Path) -> tuple[str, ...]:
    """Copy a case, and the vocabularies beside it into a folder of their own; return the words of the command."""
    (folder / "terms").mkdir(parents=True)
    shutil.copy(case, folder)
    own = [shutil.copy(path, folder / "terms") for path in sorted(case.parent.glob(f"{case.stem}*.ttl"))]
    return (str(folder / case.name), *(("--ontology", str(folder / "terms")) if own else ()))


def _check(product: Product, saved: Path, *words: str) -> None:
    write(saved.with_suffix(".txt"), product.tell("check", *words))
    write(saved.with_suffix(".json"), product.tell("check", *words, "--json"))
