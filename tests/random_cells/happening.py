"""Something happens to a part that a camera looks after: somebody throws it aside, takes, raises or lowers it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from random import Random
from typing import Final, Literal, TypeAlias, assert_never, get_args

from random_cells.drawing import TABLE_M, Cell, Point, draw_cell
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.disturbances import DisturbanceRefused, MoveThing
from skillc_runtime.recording.events import Event, ImplementationChosen, NodeEnded
from skillc_runtime.world.state.facts import RelationFact
from skillc_runtime.world.state.terms import CONTAIN

Deed: TypeAlias = Literal["thrown", "taken", "raised", "lowered"]
Moment: TypeAlias = Literal["sought", "reached for", "released", "confirmed"]
"""When: a camera looks where the part is, the arm reaches for what it saw, lets it go, the camera looks afterwards."""

DEEDS: Final[tuple[Deed, ...]] = get_args(Deed)

DELAYS_S: Final[dict[Moment, float]] = {"sought": 0.35, "reached for": 5.0, "released": 2.0, "confirmed": 0.35}
"""How long after the beginning of the moment at most: a look takes at least 0.4 s, and sees nothing that is later."""

FLOOR: Final = (1.0, 1.2)
"""How far in m from the arm a part lies on the floor in front of the table."""

AWAY: Final = (2.0, 2.0)


@dataclass(frozen=True, slots=True)
class Happening:
    """What happens to a part, and when: after the moment has begun, or as soon as no hand holds the part.

    It is moved by (3,) in m, or to (3,) in m in the world, and turned about the vertical in rad.
    """

    deed: Deed
    moment: Moment
    delay_s: float
    by_m: Point | None
    to_m: Point | None
    turn_rad: float


def draw_watched_cell(rng: Random, most_parts: int) -> Cell:
    """Draw a cell with a camera, and with no parts but those that are to be moved."""
    while not (cell := draw_cell(rng, most_parts)).has_camera:
        pass
    return replace(cell, parts=cell.parts[: len(cell.goal)])


def draw_happening(rng: Random, deed: Deed) -> Happening:
    """Draw when and how a part is thrown, taken, raised or lowered."""
    moment: Moment = rng.choice(get_args(Moment))
    delay, turn = round(rng.uniform(0.02, DELAYS_S[moment]), 2), round(rng.uniform(-3.0, 3.0), 2)
    nothing = Happening(deed, moment, delay, None, None, turn)
    match deed:
        case "thrown":
            x, y = (rng.choice((-1, 1)) * rng.uniform(0.06, 0.25) for _ in range(2))
            return replace(nothing, by_m=(round(x, 3), round(y, 3), round(rng.uniform(0.05, 0.2), 3)))
        case "taken":
            return replace(nothing, to_m=(*AWAY, TABLE_M / 4))
        case "raised":
            return replace(nothing, by_m=(0.0, 0.0, round(rng.uniform(0.1, 0.4), 3)))
        case "lowered":
            return replace(nothing, to_m=(round(rng.uniform(*FLOOR), 3), round(rng.uniform(-0.3, 0.3), 3), 0.04))
        case _:
            assert_never(deed)


class Hand:
    """Somebody who does it to a part that is to be put into a bin; a listener, whose `update` is called each tick."""

    def __init__(self, happening: Happening, part: str, bin_: str, cell: SimulatedCell | KinematicCell) -> None:
        self._happening, self._part, self._bin, self._cell = happening, part, bin_, cell
        self._due_s: float | None = None
        self._looks = set[int]()
        self.acted = False

    def __call__(self, event: Event) -> None:
        """Notice when the moment begins."""
        match event:
            case ImplementationChosen(skill=skill, node=node) if self._part in event.individuals:
                if skill == "Locate":
                    self._looks.add(node)
                begins = {"Locate": "sought", "Release": "released", "ConfirmPlaced": "confirmed"}.get(skill)
                self._begin(event.time, begins)
            case NodeEnded(node=node, status="success") if node in self._looks:
                self._begin(event.time, "reached for")

    def _begin(self, now: float, moment: str | None) -> None:
        if moment == self._happening.moment and self._due_s is None:
            self._due_s = now + self._happening.delay_s

    def update(self) -> None:
        """Do it once its time has come, while no hand holds the part and no camera has seen it in its bin."""
        if self.acted or self._due_s is None or self._cell.now < self._due_s or self._is_confirmed():
            return
        try:
            self._cell.disturber.disturb(self._move())
            self.acted = True
        except DisturbanceRefused:
            return

    def _is_confirmed(self) -> bool:
        world, fact = self._cell.world, RelationFact(self._bin, CONTAIN, self._part)
        known = world.deciding_write(fact) if world.snapshot().holds(self._bin, CONTAIN, self._part) else None
        return known is not None and known.evidence in ("sensed", "idealised")

    def _move(self) -> MoveThing:
        happening, at = self._happening, self._cell.ground_truth.body_pose(self._part).position
        if happening.to_m is not None:
            x, y, z = (round(float(to - now), 4) for to, now in zip(happening.to_m, at, strict=True))
            return MoveThing(self._part, (x, y, z), happening.turn_rad)
        assert happening.by_m is not None, "a part is moved by something or to somewhere"
        return MoveThing(self._part, happening.by_m, happening.turn_rad)
