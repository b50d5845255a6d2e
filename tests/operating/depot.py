"""A library of skills that do nothing but wait, so that runs of them can be operated."""

from __future__ import annotations

from pathlib import Path

SKILLS = """# Crates are delivered by hand.

use skiros

skill Deliver { noplan }
impl by_hand of Deliver {
    do seq {
        Lift()
        Carry()
        Lower()
    }
}

skill Lift { noplan }
impl slowly of Lift { do wait 1 s }

skill Carry { noplan }
impl far of Carry { do wait FAR }

skill Lower { noplan }
impl slowly of Lower { do wait 1 s }

skill Drop { noplan }
impl down of Drop { run python "operating.breaking:Failing" }

skill Leave { noplan }
impl early of Leave { run python "operating.breaking:Exiting" }

skill Crack { noplan }
impl open of Crack { run python "operating.breaking:Raising" }
"""
SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:crate a skiros:Product .
lab:shelf a skiros:Location .
"""


def write_depot(folder: Path, far_s: int = 2000) -> tuple[str, ...]:
    """Write the library and its scene into a folder; return the options that select them."""
    (folder / "depot.skill").write_text(SKILLS.replace("FAR", f"{far_s} s"), encoding="utf-8")
    (folder / "scene.ttl").write_text(SCENE, encoding="utf-8")
    return ("--library", str(folder), "--scene", str(folder / "scene.ttl"))


def line_of(text: str) -> int:
    """Return the number of the first line with a text in it."""
    return next(number for number, line in enumerate(SKILLS.splitlines(), 1) if text in line)
