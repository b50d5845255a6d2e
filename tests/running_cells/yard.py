"""A library and a scene in which crates are carried from one place to another, one after the other, by nobody."""

from __future__ import annotations

from pathlib import Path

from skillc.cells.settings import CellSettings

CRATES = 6
SKILLS = """# Crates are carried one after the other.

use skiros

prefix lab: <http://example.org/lab#>

class lab:Cart < Location

skill Load {
    in    cart:  lab:Cart
    in    crate: Product
    infer from:  Location
    pre   from contain crate
    pre   not cart contain _
    pre   from != cart
    post  there: cart contain crate
    post  gone:  not from contain crate
}
impl by_hand of Load { do seq { wait TAKES ms  apply gone, there  wait TAKES ms } }

skill Unload {
    in    cart:  lab:Cart
    in    crate: Product
    in    to:    Location
    pre   cart contain crate
    pre   cart != to
    post  gone:  not cart contain crate
    post  there: to contain crate
}
impl by_hand of Unload { do seq { wait TAKES ms  apply gone, there  wait TAKES ms } }

## Bring one crate to a place.
task carry(crate: Product, to: Location) {
    scene "yard.ttl"
    goal to contain crate
}

task carry_all {
    scene "yard.ttl"
    goal forall c: Product (lab:Goal contain c)
}

## Bring two crates in this order.
task carry_two {
    scene "yard.ttl"
    do seq {
        Load(cart: lab:Cart-1, crate: lab:crate-1)
        Unload(cart: lab:Cart-1, crate: lab:crate-1, to: lab:Goal)
        Load(cart: lab:Cart-1, crate: lab:crate-0)
        Unload(cart: lab:Cart-1, crate: lab:crate-0, to: lab:Goal)
    }
}
"""
SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:Cart-1 a lab:Cart .
lab:Goal a skiros:Location .
lab:Start a skiros:Location ;
    skiros:contain {crates} .
"""


def write_yard(folder: Path, takes_ms: int = 100) -> CellSettings:
    """Write the library and its scene into a folder; return the settings of its cell."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "yard.skill").write_text(SKILLS.replace("TAKES", str(takes_ms)), encoding="utf-8")
    crates = [f"lab:crate-{number}" for number in range(CRATES)]
    scene = SCENE.format(crates=", ".join(crates)) + "".join(f"{each} a skiros:Product .\n" for each in crates)
    (folder / "yard.ttl").write_text(scene, encoding="utf-8")
    return find_settings(folder)


def find_settings(folder: Path) -> CellSettings:
    """Return the settings of the cell of a yard that was written."""
    return CellSettings(
        name="yard",
        scene=str(folder / "yard.ttl"),
        library=str(folder),
        folder=str(folder / "state"),
        backend="kinematic",
    )
