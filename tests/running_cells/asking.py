"""A yard in which somebody is asked."""

from __future__ import annotations

from pathlib import Path

from running_cells.yard import write_yard
from skillc.cells.settings import CellSettings

SKILLS = """# Somebody is asked.

use skiros
import "asking.skill"

## Go on if the operator says that the cart is free.
skill Confirm {
    noplan
}
impl asked of Confirm {
    do seq {
        Ask(text: "Is the cart free?", choices: "yes | no"DEFAULT, limit: 60 s) -> said
        check(said == "yes")
        wait 100 ms
    }
}

task confirm {
    scene "yard.ttl"
    do Confirm()
}
"""


def write_question(folder: Path, default: str = "") -> None:
    """Write the file of the task that asks into the folder of a library."""
    given = f', default: "{default}"' if default else ""
    (folder / "confirm.skill").write_text(SKILLS.replace("DEFAULT", given), encoding="utf-8")


def write_asking_yard(folder: Path, default: str = "", takes_ms: int = 10) -> CellSettings:
    """Write a yard with a task that asks `Is the cart free?`; return the settings of its cell."""
    settings = write_yard(folder, takes_ms)
    write_question(folder, default)
    return settings
