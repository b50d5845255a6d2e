"""The help of all commands, and the explanations of all diagnostics."""

from __future__ import annotations

import re
from pathlib import Path

from behaviour.product import Product, write

SIMULATES = False
COMMAND = re.compile(r"^  ([a-z][a-z-]*)(?=  )", re.MULTILINE)


def save(product: Product, folder: Path) -> None:
    """Print the help of each command and of the commands below it."""
    _save(product, folder)
    write(folder / "explain.json", product.tell("explain", "--json"))


def _save(product: Product, folder: Path, *words: str) -> None:
    text = product.tell(*words, "--help")
    write(folder / ("-".join(("skillc", *words)) + ".txt"), text)
    if "COMMAND [ARGS]..." in text:
        for name in COMMAND.findall(text.partition("Output options:")[0]):
            _save(product, folder, *words, name)
