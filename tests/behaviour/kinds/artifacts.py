"""What libraries compile to: the shipped ones, and those of the tests."""

from __future__ import annotations

from pathlib import Path

import skillc_skills
from behaviour.product import CASES, Product, write

SIMULATES = False
LIBRARIES = ("cases/build/*/", "cases/libraries/*.skill")


def save(product: Product, folder: Path) -> None:
    """Compile each library into a folder."""
    shipped = [each for each in sorted(Path(skillc_skills.__file__).parent.iterdir()) if any(each.glob("*.skill"))]
    own = [path for pattern in LIBRARIES for path in sorted(CASES.glob(pattern))]
    for path in (*shipped, *own):
        told = product.tell("compile", str(path), "--output", str(folder / path.stem))
        write(folder / path.stem / "told.txt", told.replace(str(folder), "<saved>"))
