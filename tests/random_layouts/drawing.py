"""Draws small cells in which one part is to be put into a bin, and something may keep the arms from it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from random import Random
from types import MappingProxyType
from typing import Final

from random_cells.drawing import BIN_PLACES, PART_PLACES, TABLE_M, ArmName, Bin, Cell, Part, Point
from random_cells.writing import ARMS, HANDS, format_scene
from random_layouts.stations import Station, draw_stations, format_stations, spot_on

ARM_NAMES: Final[tuple[ArmName, ...]] = ("iiwa14", "ur5e", "panda")

PARTS_NEAR: Final = PART_PLACES[:9]

SECOND_ARM: Final = (0.0, 1.15, TABLE_M, 0.0)
"""Where the second arm stands, in m and degrees: beside the first one, as its table beside the other."""

ARM = """lab:Robot-2 a skillc:FixedRobot ; skiros:FrameId "robot2" ; skiros:at lab:Cell ; skillc:hasArm lab:Arm-2 .

{arm}    skiros:FrameId "arm2" ; skiros:BaseFrameId "robot2" ; skillc:deviceState "Idle" ;
    skiros:PositionX {at[0]} ; skiros:PositionY {at[1]} ; skiros:PositionZ {at[2]} ; skillc:yaw {at[3]} .

lab:Hand-2 a {hand} ; skiros:FrameId "hand2" ; skillc:deviceState "Idle" .
"""


@dataclass(frozen=True, slots=True)
class Layout:
    """A cell, of which the part of the first goal is to be moved, and a second arm: at x, y, z in m, yaw in degrees.

    With `stations` the first arm stands on a mobile base, which drives from one of them to another.
    """

    cell: Cell
    second_arm: ArmName | None = None
    second_at: tuple[float, float, float, float] = SECOND_ARM
    stations: tuple[Station, ...] = ()

    @property
    def arms(self) -> int:
        """The number of arms."""
        return 1 if self.second_arm is None else 2


def draw_layout(seed: int, kind: str) -> Layout:
    """Draw the layout of a seed and a kind, one of KINDS."""
    return KINDS[kind](Random(f"layouts:{kind}:{seed}"))


def format_layout(layout: Layout, library: str) -> str:
    """Return the scene of a layout as Turtle."""
    if layout.stations:
        return format_stations(layout.cell, layout.stations, library)
    text = format_scene(layout.cell, library)
    if layout.second_arm is None:
        return text
    arm = ARMS[layout.second_arm].replace("-1", "-2").replace("sheet-2", "sheet")
    return text + "\n" + ARM.format(arm=arm, hand=HANDS[layout.second_arm], at=layout.second_at)


def _draw_part(rng: Random, name: str, place: tuple[float, float], on_m: float = TABLE_M) -> Part:
    width, height = round(rng.uniform(0.028, 0.036), 4), round(rng.uniform(0.04, 0.07), 4)
    length = width if rng.random() < 0.5 else round(1.5 * width, 4)
    return Part(name, "box", (length, width, height), 0.1, (*place, round(on_m + height / 2, 4)))


def _draw_bins(rng: Random, count: int, size: tuple[float, float] | None = None) -> tuple[Bin, ...]:
    _, room, corners = BIN_PLACES[2]
    height = round(rng.uniform(0.035, 0.06), 3)
    places = rng.sample(corners, count)
    sides = [room if size is None or number else size for number in range(count)]
    return tuple(
        Bin(f"Bin-{number}", (*side, height), (*place, TABLE_M + height / 2))
        for number, (side, place) in enumerate(zip(sides, places, strict=True), 1)
    )


def _base(rng: Random, parts: int = 1, bins: int = 1) -> Cell:
    places = rng.sample(PARTS_NEAR, parts)
    drawn = tuple(_draw_part(rng, f"Part-{number}", place) for number, place in enumerate(places, 1))
    return Cell(rng.choice(ARM_NAMES), drawn, _draw_bins(rng, bins), (("Part-1", "Bin-1"),))


def _plain(rng: Random) -> Layout:
    return Layout(_base(rng, rng.randint(1, 4), rng.randint(1, 3)))


def _stack(rng: Random) -> Layout:
    """Draw one or two parts that stand on the one to be moved, and one to three bins."""
    cell = _base(rng, 1, rng.randint(1, 3))
    below, tower = cell.parts[0], list(cell.parts)
    for number in range(rng.randint(1, 2)):
        x, y, z = below.at
        below = _draw_part(rng, f"Part-{number + 2}", (x, y), round(z + below.size[2] / 2, 4))
        tower.append(below)
    return Layout(replace(cell, parts=tuple(tower)))


def _crowd(rng: Random) -> Layout:
    """Draw parts, or blocks that nobody can move, close to the sides of the one to be moved."""
    cell = _base(rng, 1, rng.randint(1, 3))
    middle = cell.parts[0]
    x, y, _ = middle.at
    parts, boxes = [middle], []
    for number, (a, b) in enumerate(rng.sample([(1, 0), (-1, 0), (0, 1), (0, -1)], rng.randint(1, 4)), 2):
        gap, other = rng.uniform(0.004, 0.05), _draw_part(rng, f"Part-{number}", (0.0, 0.0))
        side = gap + (middle.size[0] + other.size[0] if a else middle.size[1] + other.size[1]) / 2
        at = (round(x + a * side, 4), round(y + b * side, 4), other.at[2])
        if rng.random() < 0.3:
            boxes.append((f"Block-{number}", other.size, at))
        else:
            parts.append(replace(other, at=at))
    return Layout(replace(cell, parts=tuple(parts), boxes=tuple(boxes)))


def _slot(rng: Random) -> Layout:
    """Draw a bin that may be too narrow for the part or for fingers around it."""
    cell = _base(rng)
    size = (round(rng.uniform(0.05, 0.15), 3), round(rng.uniform(0.05, 0.15), 3))
    deep = round(rng.uniform(0.03, 0.12), 3)
    place = cell.bins[0].at[:2]
    slot = Bin("Bin-1", (*size, deep), (*place, round(TABLE_M + deep / 2, 4)))
    return Layout(replace(cell, bins=(slot,)))


def _shelf(rng: Random) -> Layout:
    """Draw a board over the part, over the bin, or over both."""
    cell = _base(rng)
    under: list[tuple[str, Point]] = [("part", cell.parts[0].at), ("bin", cell.bins[0].at)]
    boxes = []
    for name, (x, y, _) in rng.sample(under, rng.randint(1, 2)):
        height = TABLE_M + rng.uniform(0.1, 0.45)
        boxes.append((f"Board-{name}", (0.22, 0.26, 0.02), (x, y, round(height, 3))))
    return Layout(replace(cell, boxes=tuple(boxes)))


def _two_arms(rng: Random) -> Layout:
    """Draw two arms side by side; part, bin and, often, a bin between are each in reach of one arm, both or none."""
    cell = _base(rng)
    width = {"at": (0.5, SECOND_ARM[1], TABLE_M), "size": (0.68, 1.0, TABLE_M)}
    boxes = [("Table-2", width["size"], width["at"]), ("Pedestal-2", (0.3, 0.3, TABLE_M), SECOND_ARM[:3])]

    def place() -> tuple[float, float]:
        return round(rng.uniform(0.3, 0.65), 3), round(rng.uniform(-0.45, 1.55), 3)

    def bin_at(name: str, spot: tuple[float, float]) -> Bin:
        return Bin(name, (0.155, 0.155, 0.04), (*spot, TABLE_M + 0.02))

    spots = [place()]
    wanted = 3 if rng.random() < 0.7 else 2
    while len(spots) < wanted:
        spot = (0.45, round(rng.uniform(0.45, 0.7), 3)) if len(spots) == 2 else place()
        if all((spot[0] - x) ** 2 + (spot[1] - y) ** 2 > 0.25**2 for x, y in spots):
            spots.append(spot)
        elif len(spots) == 2:
            wanted = 2
    part = replace(cell.parts[0], at=(*spots[0], cell.parts[0].at[2]))
    bins = tuple(bin_at(f"Bin-{number}", spot) for number, spot in enumerate(spots[1:], 1))
    return Layout(replace(cell, parts=(part,), bins=bins, boxes=tuple(boxes)), rng.choice(ARM_NAMES))


def _rack(rng: Random) -> Layout:
    """Draw the part in a compartment of a rack, with a board above it and walls, from which it is taken sideways."""
    cell = _base(rng)
    x, y, floor = round(rng.uniform(0.5, 0.62), 3), round(rng.uniform(-0.4, -0.1), 3), rng.choice((0.0, 0.15, 0.3))
    part = _draw_part(rng, "Part-1", (x, y), TABLE_M + floor)
    wide, deep, high = (round(rng.uniform(*each), 3) for each in ((0.18, 0.4), (0.1, 0.2), (0.12, 0.35)))
    top, back = TABLE_M + floor + high, round(x + deep / 2 + 0.04, 3)
    boxes = [("Board-above", (deep, wide, 0.015), (x, y, round(top + 0.015, 3)))]
    if floor:
        boxes.append(("Board-below", (deep, wide, 0.015), (x, y, TABLE_M + floor)))
    if rng.random() < 0.6:
        boxes.append(("Wall-back", (0.015, wide, round(high + floor, 3)), (back, y, round(top, 3))))
    for name, side in rng.sample([("left", 0.5), ("right", -0.5)], rng.randint(0, 2)):
        at = (x, round(y + side * (wide + 0.02), 3), round(top, 3))
        boxes.append((f"Wall-{name}", (deep, 0.015, round(high + floor, 3)), at))
    return Layout(replace(cell, parts=(part,), boxes=tuple(boxes)))


def _full(rng: Random) -> Layout:
    """Draw a bin in which other parts stand already, so that there may be no more room, and perhaps another one."""
    size = (round(rng.uniform(0.07, 0.155), 3), round(rng.uniform(0.07, 0.155), 3))
    cell = _base(rng)
    bins = _draw_bins(rng, rng.randint(1, 2), size)
    (x, y, _), inside = bins[0].at, list[Part]()
    for number in range(2, rng.randint(3, 5)):
        one = _draw_part(rng, f"Part-{number}", (0.0, 0.0), TABLE_M + 0.0045)
        room = [(each - side) / 2 - 0.01 for each, side in zip(size, one.size, strict=False)]
        at = tuple(round(middle + rng.uniform(-each, each), 4) for middle, each in zip((x, y), room, strict=True))
        if all(abs(at[i] - each.at[i]) > (one.size[i] + each.size[i]) / 2 for each in inside for i in (0, 1)):
            inside.append(replace(one, at=(*at, one.at[2])))
    contained = tuple((each.name, "Bin-1") for each in inside)
    return Layout(replace(cell, parts=(*cell.parts, *inside), bins=bins, contained=contained))


def _opposite(rng: Random) -> Layout:
    """Draw two arms that face each other across the table, one higher than the other, so that their reach differs."""
    cell = _base(rng)
    second = (
        round(rng.uniform(1.05, 1.4), 2),
        round(rng.uniform(-0.4, 0.4), 2),
        round(rng.uniform(0.4, 0.9), 2),
        180.0,
    )
    pedestal = ("Pedestal-2", (0.3, 0.3, second[2]), second[:3])
    stand = (0.2, 0.2, round(rng.uniform(0.1, 0.35), 2))
    spots = list[tuple[float, float]]()
    while len(spots) < 3:
        spot = (round(rng.uniform(0.27, 0.72), 3), round(rng.uniform(-0.5, 0.5), 3))
        if all((spot[0] - x) ** 2 + (spot[1] - y) ** 2 > 0.25**2 for x, y in spots):
            spots.append(spot)
    high = rng.random() < 0.5
    on_m = TABLE_M + (stand[2] if high else 0.0)
    boxes = [pedestal, *([("Stand-1", stand, (*spots[0], round(on_m, 3)))] if high else [])]
    part = _draw_part(rng, "Part-1", spots[0], on_m)
    bins = tuple(
        Bin(f"Bin-{number}", (0.155, 0.155, 0.04), (*spot, TABLE_M + 0.02))
        for number, spot in enumerate(spots[1 : rng.choice((2, 3))], 1)
    )
    return Layout(replace(cell, parts=(part,), bins=bins, boxes=tuple(boxes)), rng.choice(ARM_NAMES), second)


def _bases(rng: Random) -> Layout:
    """Draw a base with an arm, and two or three workstations, on whose tables part and bins are."""
    cell = _base(rng)
    stations = draw_stations(rng, rng.randint(2, 3))
    first, second = rng.sample(stations, 2)
    part = replace(cell.parts[0], at=(*spot_on(rng, first), cell.parts[0].at[2]))
    bin_ = Bin("Bin-1", (0.155, 0.155, 0.04), (*spot_on(rng, second), TABLE_M + 0.02))
    return Layout(replace(cell, parts=(part,), bins=(bin_,)), stations=stations)


KINDS: Final[Mapping[str, Callable[[Random], Layout]]] = MappingProxyType(
    {
        "plain": _plain,
        "stack": _stack,
        "crowd": _crowd,
        "slot": _slot,
        "shelf": _shelf,
        "two-arms": _two_arms,
        "rack": _rack,
        "full": _full,
        "opposite": _opposite,
        "bases": _bases,
    }
)
"""The kinds of layouts, by name."""
