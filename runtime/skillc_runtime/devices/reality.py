"""How far simulated devices are from what they should be: what their data sheets say of it, drawn from the seed.

Each kind of imperfection is a property of a data sheet, two numbers: the least and the greatest size that it has in
devices of the type. An ideal device has none, a wide one any size of the range, a typical one of its lower half.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Final, TypeAlias
from zlib import crc32

import msgspec
import numpy as np

from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Pose, exp
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.data_sheet import DataSheet, SheetError, sheet_of
from skillc_runtime.world.state.terms import ARM_DEVICE, REALITY, TOOL
from skillc_runtime.world.state.world_state import WorldState

LEVELS: Final = ("ideal", "typical", "wide")
"""How far devices are from what they should be."""

IDEAL: Final = LEVELS[0]

SHARES: Final = {"typical": 0.5, "wide": 1.0}
"""How much of a range is drawn from, from its lower end on."""

Sizes: TypeAlias = Mapping[str, tuple[float, ...]]
"""The imperfections of a device: their sizes, by the names of their kinds; those that it does not have are missing."""


NO_SIZES: Final[Sizes] = {}


class Kind(msgspec.Struct, frozen=True):
    """A kind of imperfection: the property of sheets with its range, the unit of its size, and how many sizes it has.

    per_joint: so many for each joint. signed: of either sign. at_wrist: only arms with a force/torque sensor
    have it.
    """

    name: str
    unit: str
    count: int = 1
    per_joint: bool = False
    signed: bool = True
    at_wrist: bool = False


ARM_KINDS: Final = (
    Kind("forceBias", "N", 3, at_wrist=True),
    Kind("torqueBias", "N m", 3, at_wrist=True),
    Kind("forceDrift", "N/s", 3, at_wrist=True),
    Kind("forceGainError", "", 6, at_wrist=True),
    Kind("forceCrossTalk", "", 12, at_wrist=True),
    Kind("forceResolution", "N", signed=False, at_wrist=True),
    Kind("torqueResolution", "N m", signed=False, at_wrist=True),
    Kind("forceTorquePeriod", "s", signed=False, at_wrist=True),
    Kind("jointFriction", "", per_joint=True, signed=False),
    Kind("torqueRipple", "", per_joint=True),
    Kind("jointTorqueBias", "", per_joint=True),
    Kind("transmissionError", "rad", per_joint=True),
    Kind("effortLoss", "", per_joint=True, signed=False),
    Kind("gravityError", ""),
    Kind("toolOffset", "m", 3),
    Kind("toolTurn", "rad", 3),
    Kind("mountingOffset", "m", 3),
    Kind("mountingTurn", "rad", 3),
    Kind("linkOffset", "m", 3, per_joint=True),
    Kind("linkTurn", "rad", 3, per_joint=True),
    Kind("commandDelay", "s", signed=False),
    Kind("commandJitter", "s", signed=False),
    Kind("lostCommands", "", signed=False),
)
"""The imperfections of arms."""

TOOL_KINDS: Final = (
    Kind("massError", "kg"),
    Kind("centreError", "m", 3),
    Kind("padStiffnessFactor", "", signed=False),
    Kind("padDampingFactor", "", signed=False),
    Kind("padThicknessError", "m"),
)
"""The imperfections of tools."""

KINDS: Final = (*ARM_KINDS, *TOOL_KINDS)


class Reality(msgspec.Struct, frozen=True):
    """A level, and the kinds of imperfections that there are; all if there are none."""

    level: str
    kinds: tuple[str, ...] = ()

    def has(self, kind: Kind) -> bool:
        """Whether devices have a kind of imperfection."""
        return self.has_named(kind.name)

    def has_named(self, kind: str) -> bool:
        """Whether devices have the kind of imperfection of this name."""
        return self.level != IDEAL and (not self.kinds or kind in self.kinds)


IDEAL_REALITY: Final = Reality(IDEAL)


def parse_reality(text: str) -> Reality:
    """Read `typical`, or `wide:jointFriction,forceBias`; ValueError for other levels and unknown kinds."""
    level, colon, named = text.partition(":")
    kinds = tuple(each.strip() for each in named.split(",")) if colon else ()
    if level not in LEVELS:
        raise ValueError(f"reality is {', '.join(LEVELS[:-1])} or {LEVELS[-1]}, not {level!r}")
    known = [each.name for each in KINDS]
    if unknown := [each for each in kinds if each not in known]:
        raise ValueError(f"there is no imperfection {unknown[0]!r}; there are: {', '.join(known)}")
    return Reality(level, kinds)


def read_reality(state: WorldState, device: str) -> Reality:
    """Return how far a device is from what it should be, ideal unless stated; SheetError if what is stated is none."""
    stated = state.value(device, REALITY)
    try:
        return parse_reality(IDEAL if stated is None else str(stated))
    except ValueError as error:
        short = state.vocabulary.short
        raise SheetError(f"{short(REALITY)} of {short(device)}: {error}") from error


def set_reality(state: WorldState, text: str) -> WorldState:
    """Return a world in which all arms and tools are this far from what they should be; see `parse_reality`.

    ValueError as of that, and if no device has an imperfection of these kinds: nothing would differ.
    """
    reality, devices = parse_reality(text), sorted(state.instances(ARM_DEVICE) | state.instances(TOOL))
    sheets = [sheet_of(state, each) for each in devices]
    if reality.level != IDEAL and not any(
        reality.has(kind) and each.has(kind.name) for kind in KINDS for each in sheets
    ):
        what = f"the imperfections {', '.join(reality.kinds)}" if reality.kinds else "imperfections"
        raise ValueError(f"no arm or tool of the scene has {what}: state their ranges on its data sheet")
    return state.with_changes([SetProperty(each, REALITY, text) for each in devices])


def draw_sizes(
    individual: str, sheet: DataSheet, reality: Reality, kinds: Iterable[Kind], joints: int, seed: int
) -> Sizes:
    """Draw the imperfections of a device, each independently of all others; SheetError if a range is none."""
    return {
        each.name: _draw(individual, sheet, reality, each, joints, seed)
        for each in kinds
        if reality.has(each) and sheet.has(each.name)
    }


def _draw(individual: str, sheet: DataSheet, reality: Reality, kind: Kind, joints: int, seed: int) -> tuple[float, ...]:
    low, high = _read_range(sheet, kind.name)
    rng, count = rng_for(individual, seed, crc32(kind.name.encode())), kind.count * (joints if kind.per_joint else 1)
    sizes = rng.uniform(low, low + SHARES[reality.level] * (high - low), count)
    signs = rng.choice((-1.0, 1.0), count)
    return tuple((sizes * signs if kind.signed else sizes).tolist())


def _read_range(sheet: DataSheet, kind: str) -> tuple[float, float]:
    found = sheet.numbers(kind)
    if found.size != 2 or not 0.0 <= found[0] <= found[1]:
        what = f"skillc:{kind} of {sheet.state.vocabulary.short(sheet.individual)}"
        raise SheetError(f"{what} must be the least and the greatest size, two numbers: {sheet.text(kind)!r}")
    return float(found[0]), float(found[1])


def describe_sizes(sizes: Sizes) -> str:
    """Return imperfections as text: `forceBias 1.2 -0.4 2.0 N, gravityError 0.02`."""
    units = {each.name: each.unit for each in KINDS}
    return ", ".join(
        f"{name} {' '.join(f'{each:.3g}' for each in values)} {units[name]}".rstrip() for name, values in sizes.items()
    )


def make_tool_error(sizes: Sizes) -> Pose:
    """Return the frame that the arm's model takes for the tool centre point, in that of the true one."""
    offset, turn = (np.broadcast_to(sizes.get(each, 0.0), 3) for each in ("toolOffset", "toolTurn"))
    return Pose(offset.copy(), exp(turn))
