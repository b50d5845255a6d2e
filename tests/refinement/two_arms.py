"""A cell of two Pandas that face each other over a table with two parts and two boxes."""

from __future__ import annotations

from pathlib import Path

PREFIXES = """
@prefix lab:    <http://example.org/lab#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
"""

BOTH = "lab:Box-A contain lab:Part-A and lab:Box-B contain lab:Part-B"
SIDE_BY_SIDE = {"Part-A": (-0.03, 0.0), "Part-B": (0.04, 0.01), "Box-A": (-0.1, 0.35), "Box-B": (0.1, -0.35)}
"""Where things are on the table, in m from its middle: the hands have no room for both parts at the same time."""


def _arm(number: int, x: float, yaw_deg: float) -> str:
    return f"""
lab:Pedestal-{number} a skillc:Furniture ; skiros:SizeX 0.3 ; skiros:SizeY 0.3 ; skiros:SizeZ 0.6 ;
    skillc:on lab:Cell ; skillc:atX {x} ; skillc:yaw {yaw_deg} .
lab:Robot-{number} a skillc:FixedRobot ; skiros:at lab:Cell ; skillc:hasArm lab:Arm-{number} .
lab:Arm-{number} a skillc:Panda ; skillc:hasSheet skillc:panda-sheet ; skiros:CompliantController "impedance" ;
    skillc:on lab:Pedestal-{number} ; skillc:deviceState "Idle" ; skillc:hasGripper lab:Hand-{number} .
lab:Hand-{number} a skillc:PandaHand ; skillc:hasSheet skillc:panda-hand-sheet ; skillc:deviceState "Idle" .
"""


def _thing(name: str, x: float, y: float) -> str:
    kind, size = ("Product", (0.04, 0.04, 0.06)) if name.startswith("Part") else ("Container", (0.16, 0.16, 0.06))
    sizes = " ; ".join(f"skiros:Size{axis} {value}" for axis, value in zip("XYZ", size, strict=True))
    weight = " ; skiros:Weight 0.15" if kind == "Product" else ""
    return f"""
lab:{name} a skiros:{kind} ; {sizes}{weight} ;
    skillc:on lab:Table ; skillc:atX {x} ; skillc:atY {y} .
"""


def two_arms(things: dict[str, tuple[float, float]], apart_m: float = 1.2) -> str:
    """Return the scene with parts and boxes at places on the table, and the arms so far apart."""
    inside = ", ".join(f"lab:{each}" for each in ("Pedestal-1", "Pedestal-2", "Table", *things))
    return "".join(
        (
            PREFIXES,
            "lab:Scene-1 a skiros:Scene ; skiros:contain lab:Cell .\n",
            f"lab:Cell a skillc:Workstation ; skillc:on lab:Scene-1 ; skiros:contain {inside} .\n",
            f"lab:Table a skillc:Furniture ; skiros:SizeX {apart_m - 0.5} ; skiros:SizeY 1.2 ; skiros:SizeZ 0.6 ;\n",
            f"    skillc:on lab:Cell ; skillc:atX {apart_m / 2} .\n",
            _arm(1, 0.0, 0.0),
            _arm(2, apart_m, 180.0),
            *(_thing(name, *place) for name, place in things.items()),
        )
    )


def write_two_arms(folder: Path, things: dict[str, tuple[float, float]], apart_m: float = 1.2) -> Path:
    """Write the scene; return its file."""
    path = folder / "cell.ttl"
    path.write_text(two_arms(things, apart_m))
    return path
