"""Draws and writes workstations with a table each, between which a mobile base carries an arm."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, radians, sin
from random import Random
from string import Template

from random_cells.drawing import TABLE_M, Cell
from random_cells.writing import ARMS, HANDS, format_scene

BASE_M = (0.70, 0.50, 0.60)
"""The size of the base, on top of which an arm stands ARM_AHEAD_M before its middle."""

ARM_AHEAD_M = 0.2
TABLE_SIDES_M = (0.6, 0.9)

HEAD = Template("""lab:Dock a skillc:Workstation ; skiros:FrameId "dock" ; skiros:BaseFrameId "map" ;
    skiros:PositionX 0.0 ; skiros:PositionY 0.0 ; skiros:PositionZ 0.0 .

lab:Robot-1 a skillc:Heron ; skillc:hasSheet skillc:heron-sheet ; skiros:FrameId "robot" ;
    skiros:SizeX ${base_x} ; skiros:SizeY ${base_y} ; skiros:SizeZ ${base_z} ;
    skiros:at lab:Dock ; skillc:hasArm lab:Arm-1 .

$arm    skiros:FrameId "arm" ; skiros:BaseFrameId "robot" ; skillc:deviceState "Idle" ;
    skiros:PositionX ${ahead} ; skiros:PositionY 0.0 ; skiros:PositionZ ${base_z} .

lab:Hand-1 a $hand ; skiros:FrameId "hand" ; skillc:deviceState "Idle" .

""")

STATION = Template("""lab:$name a skillc:Workstation ; skiros:FrameId "$name" ; skiros:BaseFrameId "map" ;
    skiros:PositionX $x ; skiros:PositionY $y ; skiros:PositionZ 0.0 ; skillc:yaw $yaw ;
    skiros:contain $things .

lab:Table-$name a skillc:Furniture ; skiros:SizeX $sx ; skiros:SizeY $sy ; skiros:SizeZ $sz ;
    skiros:FrameId "Table-$name" ; skiros:BaseFrameId "$name" ;
    skiros:PositionX $away ; skiros:PositionY 0.0 ; skiros:PositionZ $sz .

""")


@dataclass(frozen=True, slots=True)
class Station:
    """A workstation: where a base is wanted to stand, in m and degrees, and how far before that its table begins."""

    name: str
    at: tuple[float, float]
    yaw_deg: float
    away_m: float

    def place(self, ahead_m: float, left_m: float) -> tuple[float, float]:
        """Return the position in the world of a point before the station and to its left."""
        turn = radians(self.yaw_deg)
        x = self.at[0] + ahead_m * cos(turn) - left_m * sin(turn)
        y = self.at[1] + ahead_m * sin(turn) + left_m * cos(turn)
        return round(x, 4), round(y, 4)


def draw_stations(rng: Random, count: int) -> tuple[Station, ...]:
    """Draw stations around the dock, each with its table away from it."""
    turns = rng.sample((-120.0, -60.0, 0.0, 60.0, 120.0, 180.0), count)
    stations = []
    for number, turn in enumerate(turns, 1):
        far = rng.uniform(1.6, 2.4)
        at = (round(far * cos(radians(turn)), 3), round(far * sin(radians(turn)), 3))
        stations.append(Station(f"Station-{number}", at, turn, round(rng.uniform(0.4, 0.95), 3)))
    return tuple(stations)


def spot_on(rng: Random, station: Station) -> tuple[float, float]:
    """Draw a place on the table of a station, in the world."""
    length, width = TABLE_SIDES_M
    return station.place(station.away_m + rng.uniform(0.09, length - 0.09), rng.uniform(-0.4, 0.4) * width)


def format_stations(cell: Cell, stations: tuple[Station, ...], library: str) -> str:
    """Return the scene as Turtle; parts and bins are at the station whose table they are on."""
    text = format_scene(cell, library)
    begin, end = text.index("lab:Cell a"), text.index("lab:Part-1 a")
    named = [*cell.parts, *cell.bins]
    base_x, base_y, base_z = BASE_M
    arm = HEAD.substitute(
        base_x=base_x, base_y=base_y, base_z=base_z, ahead=ARM_AHEAD_M, arm=ARMS[cell.arm], hand=HANDS[cell.arm]
    )
    parts = [text[:begin].replace("lab:Cell", ", ".join(f"lab:{each.name}" for each in stations) + ", lab:Dock"), arm]
    for station in stations:
        x, y = station.place(station.away_m + TABLE_SIDES_M[0] / 2, 0.0)
        near = [each.name for each in named if hypot(each.at[0] - x, each.at[1] - y) < 0.6]
        things = ", ".join(f"lab:{each}" for each in (f"Table-{station.name}", *near))
        parts.append(
            STATION.substitute(
                name=station.name,
                x=station.at[0],
                y=station.at[1],
                yaw=station.yaw_deg,
                things=things,
                away=round(station.away_m + TABLE_SIDES_M[0] / 2, 3),
                sx=TABLE_SIDES_M[0],
                sy=TABLE_SIDES_M[1],
                sz=TABLE_M,
            )
        )
    return "".join((*parts, text[end:]))
