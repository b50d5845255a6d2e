"""Estimates the light on a surface: its colour from the white of the markers, its brightness as a smooth field."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array
from skillc_runtime.vision.inspected_surface import CORNERS, InspectedSurface, linear, marker_centres
from skillc_runtime.vision.lens import Lens, project
from skillc_runtime.vision.locate import LocatedSurface
from skillc_runtime.vision.markers import Image
from skillc_runtime.vision.rectify import BLACK, SATURATED

PER_SIDE = 6
"""Points on each side of a marker's white rim."""

ROUNDS, SCALE = 8, 0.06
"""Rounds of weighing, and the error of the logarithm of brightness from which on a point counts less."""

ENOUGH = 3001
"""So many places tell the light as well as more do."""

ANCHOR_SHARE = 0.3
"""How much the white of the markers counts, of all that counts."""

ROUGHNESS = 2e-3
"""Keeps terms of higher order small, and slopes too, where few points tell them."""


class Whites(msgspec.Struct, frozen=True):
    """The light on white paper: places (n, 2) in m on the surface, its colours (n, 3), on which of 4 markers."""

    places: Array
    light: Array
    markers: NDArray[np.int_]


def sample_whites(
    image: Image,
    lens: Lens,
    surface: InspectedSurface,
    located: LocatedSurface,
    hidden: NDArray[np.bool_] | None = None,
) -> Whites:
    """Return the light on the white rims of the markers that were seen, as if these reflected all light."""
    assert surface.markers is not None
    middle = (surface.markers.plate_m + surface.markers.side_m) / 4
    steps = np.linspace(-middle, middle, PER_SIDE)
    sides = [
        (sign * middle, at) if turned else (at, sign * middle) for turned in (0, 1) for sign in (-1, 1) for at in steps
    ]
    rim = np.array([(*each, 0.0) for each in sides])
    centres = marker_centres(surface)
    points = np.concatenate([centres[number] + rim for number in located.markers])
    owners = np.repeat(np.array(located.markers), len(rim))
    at = np.rint(np.nan_to_num(project(lens, located.pose, points), nan=-1e6)).astype(int)
    inside = ((at >= 1) & (at < (lens.width - 1, lens.height - 1))).all(axis=1)
    rows, columns = at[inside, 1], at[inside, 0]
    around = np.stack([image[rows + i, columns + j] for i in (-1, 0, 1) for j in (-1, 0, 1)])
    kept = (around < SATURATED).all(axis=(0, 2)) & (around > BLACK).any(axis=(0, 2))
    if hidden is not None:
        kept &= ~hidden[rows, columns]
    light = np.median(linear(around), axis=0) / linear(surface.look.paper)
    return Whites(points[inside][kept, :2], light[kept], owners[inside][kept])


def colour_of_light(whites: Whites, places: Array) -> Array:
    """Return the colour (n, 3) of the light at places (n, 2) in m, green 1: a plane through the medians of markers."""
    medians, at = [], []
    for number in np.unique(whites.markers):
        own = whites.markers == number
        medians.append(np.median(np.log(whites.light[own] / whites.light[own][:, 1:2]), axis=0))
        at.append(np.median(whites.places[own], axis=0))
    if len(medians) < len(CORNERS) - 1:
        return np.asarray(np.exp(np.broadcast_to(np.mean(medians, axis=0), (len(places), 3))))
    size = np.abs(np.array(at)).max()
    known = np.column_stack([np.ones(len(at)), np.array(at) / size])
    plane = np.linalg.lstsq(known, np.array(medians), rcond=None)[0]
    return np.asarray(np.exp(np.column_stack([np.ones(len(places)), places / size]) @ plane))


def fit_brightness(places: Array, brightness: Array, weights: Array, whites: Whites, size: Array) -> Array:
    """Return the brightness (n,) of a smooth light at places (n, 2) in m, from what is seen there, and from whites.

    brightness, weights (n,): what each place shows and how much it counts at most. size (2,) in m. The logarithm is a
    polynomial of third order, fitted with Cauchy weights, so that shadows, reflections and dirt count little.
    """
    step = max(1, len(places) // ENOUGH)
    at, count = np.concatenate([places[::step], whites.places]), len(whites.places)
    terms = _terms(at, size)
    seen = np.log(np.maximum(np.concatenate([brightness[::step], whites.light[:, 1]]), 1e-6))
    total = float(weights[::step].sum())
    most = np.concatenate([weights[::step] / max(total, 1e-9), np.full(count, ANCHOR_SHARE / max(count, 1))])
    degree = np.array([i + j for i in range(4) for j in range(4) if i + j < 4])
    rough = ROUGHNESS * np.diag(np.array([1e-6, 0.05, 1.0, 2.0])[degree])
    weighing, found = most, np.zeros(len(degree))
    for _ in range(ROUNDS):
        A = terms.T @ (weighing[:, None] * terms)
        found = np.linalg.solve(A + rough, terms.T @ (weighing * seen))
        error = seen - terms @ found
        weighing = most / (1.0 + (error / SCALE) ** 2)
    return np.asarray(np.exp(_terms(places, size) @ found))


def _terms(places: Array, size: Array) -> Array:
    """Return the terms (n, 10) of a polynomial of third order, of places (n, 2) on a surface of size (2,) in m."""
    x, y = (2.0 * places / size).T
    return np.stack([x**i * y**j for i in range(4) for j in range(4) if i + j < 4], axis=1)
