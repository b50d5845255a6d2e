"""The faces of parts as they really are: labels, and defects that are drawn from a seed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final, Literal, TypeAlias

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.backends.simulation.cameras.image_camera_spec import PrintedPart
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Array
from skillc_runtime.vision.inspected_surface import linear
from skillc_runtime.vision.labels import draw_label
from skillc_runtime.vision.part_look import PAPER, PartLook

PIXEL_M: Final = 0.00025
"""The edge of a pixel of the texture of a face."""

GRAIN, INK = 0.03, 0.04
"""Standard deviation of the reflectance of a face, relative; what share of the light the black of a label reflects."""

LEAST_SHARE = 0.7
"""A defect lies beside the label with this share of its area at least."""

Defect: TypeAlias = Literal["", "scratch", "spot", "colour"]
"""What is wrong with a face: nothing, a dark line, a dark blot, or another colour."""


class TrueFace(msgspec.Struct, frozen=True, eq=False):
    """The face of a part as it is: its defect, and the light (rows, columns, 3) that it reflects, lowest row first."""

    defect: Defect
    reflectance: Array


def draw_faces(parts: Mapping[str, PrintedPart], seed: int) -> dict[str, TrueFace]:
    """Return the faces of parts with labels, by IRI; the same ones for the same seed. It needs OpenCV."""
    return {part: draw_face(part, each.look, each.code, each.defect_rate, seed) for part, each in parts.items()}


def draw_face(part: str, look: PartLook, code: int, defect_rate: float, seed: int) -> TrueFace:
    """Return the face of a part, by IRI, with a label; it has a defect with the probability `defect_rate`."""
    rng = rng_for(part, seed, 4)
    columns, rows = (round(each / PIXEL_M) for each in look.size)
    colour = linear(look.colour)
    defect: Defect = ""
    shade = np.ones((rows, columns, 3))
    if rng.random() < defect_rate:
        defect = ("scratch", "spot", "colour")[rng.integers(3)]
        if defect == "colour":
            colour = _other_colour(colour, rng)
        else:
            shade = _mark(look, (rows, columns), _SHAPES[defect], rng)
    grain = 1.0 + GRAIN * rng.normal(size=(rows, columns, 1))
    return TrueFace(defect, _with_label(colour * shade * grain, look, code))


def _other_colour(colour: Array, rng: np.random.Generator) -> Array:
    """Return a colour (3,) of about the same brightness in which red, green and blue clearly differ."""
    changed = colour * np.exp(rng.permutation([-0.5, 0.0, 0.5]) * rng.uniform(0.8, 1.6))
    return np.asarray(np.clip(changed * colour.mean() / changed.mean(), 0.0, 1.0))


def _mark(
    look: PartLook, shape: tuple[int, int], draw: Callable[[Array, Array, np.random.Generator], Array],
    rng: np.random.Generator,
) -> Array:  # fmt: skip
    """Return by what a face (rows, columns, 3) is darker: a mark that lies within it, and mostly beside the label."""
    y, x = ((np.arange(each) - each / 2 + 0.5) * PIXEL_M for each in shape)
    across, up = np.meshgrid(x, y)
    beside = np.maximum(np.abs(across), np.abs(up)) > look.plate_m / 2
    inside = (np.abs(across) < look.size[0] / 2 - 0.003) & (np.abs(up) < look.size[1] / 2 - 0.003)
    tint = np.array([1.0, 0.9, 0.8]) ** rng.uniform(0.0, 1.0) * rng.uniform(0.1, 0.4)
    while True:
        middle = rng.uniform(-0.5, 0.5, 2) * look.size
        amount = draw(across - middle[0], up - middle[1], rng)
        if (amount * beside * inside).sum() > LEAST_SHARE * amount.sum() > 0.0:
            return np.asarray(1.0 - amount[..., None] * (1.0 - tint))


def _scratch(x: Array, y: Array, rng: np.random.Generator) -> Array:
    """Return how much of each pixel (m, n) a bent line covers, around 0 in m."""
    turn, length, width, bend = (
        rng.uniform(0, np.pi),
        rng.uniform(0.012, 0.03),
        rng.uniform(0.0008, 0.002),
        rng.normal(),
    )
    along, across = np.cos(turn) * x + np.sin(turn) * y, np.cos(turn) * y - np.sin(turn) * x
    away = np.abs(across - 8.0 * bend * along**2) - width / 2
    return np.asarray((away < 0) & (np.abs(along) < length / 2), dtype=float)


def _spot(x: Array, y: Array, rng: np.random.Generator) -> Array:
    """Return how much of each pixel (m, n) a blot covers, around 0 in m."""
    radius, dent, turn = rng.uniform(0.002, 0.005), rng.uniform(0.0, 0.3), rng.uniform(0, 2 * np.pi)
    around = radius * (1.0 + dent * np.cos(3 * np.arctan2(y, x) + turn))
    return np.asarray(np.hypot(x, y) < around, dtype=float)


_SHAPES: Final[Mapping[str, Callable[[Array, Array, np.random.Generator], Array]]] = {
    "scratch": _scratch,
    "spot": _spot,
}


def _with_label(face: Array, look: PartLook, code: int) -> Array:
    """Return a face (rows, columns, 3), lowest row first, with its label in the middle."""
    drawn: NDArray[np.uint8] = draw_label(code, 8)[::-1]
    count = round(look.plate_m / PIXEL_M)
    picked = (np.arange(count) * len(drawn)) // count
    printed = linear(PAPER) * np.where(drawn[picked][:, picked] > 0, 1.0, INK)[..., None]
    low, left = ((each - count) // 2 for each in face.shape[:2])
    pasted = face.copy()
    pasted[low : low + count, left : left + count] = printed
    return pasted
