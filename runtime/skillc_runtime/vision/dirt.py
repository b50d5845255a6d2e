"""Tells dirt from a clean surface by colour and brightness, in uneven light."""

from __future__ import annotations

import msgspec
import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.vision.inspected_surface import SurfaceLook, linear
from skillc_runtime.vision.light import Whites, colour_of_light, fit_brightness
from skillc_runtime.vision.rectify import Spots

COLOUR_ERROR = 0.012
"""Relative error of red, green and blue against each other: noise, the colour of light, the stated look."""

LIGHT_ERROR = 0.08
"""Relative error of the smooth brightness: by how much light differs from it without a shadow or a reflection."""

CLEAN_AMOUNT = 0.12
"""Spots with less dirt tell the light."""

ROUNDS, UNMIXINGS = 6, 4


class Dirt(msgspec.Struct, frozen=True):
    """What the spots (m, n) of a surface show.

    amount: of dirt, 0 for clean, 1 for the dirt of the look. deviation: its standard deviation. brightness: of the
    light there, relative to the smooth light. strange: how far the colour is from any mix of clean and dirty, relative.
    """

    amount: Array
    deviation: Array
    brightness: Array
    strange: Array


def find_dirt(spots: Spots, look: SurfaceLook, whites: Whites) -> Dirt:
    """Return how much dirt each spot has.

    The colour of a spot in white light is a mix p c + q d of the clean colour c and that of dirt d. p + q is the light
    there, which is near the smooth light L. Weighted least squares of both; the amount of dirt is q / (p + q). L and
    the amounts are found in turns.
    """
    shape = spots.usable.shape
    places = np.stack(np.meshgrid(spots.x, spots.y), axis=-1).reshape(-1, 2)
    size = np.array([np.ptp(spots.x), np.ptp(spots.y)]) * 1.02
    colours = spots.light.reshape(-1, 3) / colour_of_light(whites, places)
    usable = spots.usable.ravel()
    clean, dirt = linear(look.clean), linear(look.dirt)
    own = np.maximum(colours @ clean / (clean @ clean), 1e-6)
    # To begin with, the light is that of the markers alone.
    smooth = fit_brightness(places, own, np.zeros(len(own)), whites, size)
    for _ in range(ROUNDS):
        p, q, _ = _unmix(colours, clean, dirt, smooth)
        amount = q / np.maximum(p + q, 1e-6)
        error = colours - p[:, None] * clean - q[:, None] * dirt
        strange = np.linalg.norm(error, axis=1) / np.maximum(np.linalg.norm(colours, axis=1), 1e-6)
        tells = usable * np.exp(-((amount / CLEAN_AMOUNT) ** 2) - (strange / 0.05) ** 2)
        smooth = fit_brightness(places, own, tells, whites, size)
    p, q, deviation = _unmix(colours, clean, dirt, smooth)
    light = np.maximum(p + q, 1e-6)
    error = colours - p[:, None] * clean - q[:, None] * dirt
    strange = np.linalg.norm(error, axis=1) / np.maximum(np.linalg.norm(colours, axis=1), 1e-6)
    # How bright a spot is, if it has the amount of dirt that colour and light together suggest.
    expected = smooth[:, None] * (clean + np.clip(q / light, 0.0, 1.0)[:, None] * (dirt - clean))
    brightness = colours.sum(axis=1) / expected.sum(axis=1)
    values = (q / light, deviation, brightness, strange)
    return Dirt(*(each.reshape(shape) for each in values))


def _unmix(colours: Array, clean: Array, dirt: Array, smooth: Array) -> tuple[Array, Array, Array]:
    """Return p and q (n,) of colours (n, 3), and the standard deviation (n,) of q / (p + q).

    That the light is near the smooth one counts less where the colour says otherwise, as in a shadow (Cauchy weights).
    """
    noise = COLOUR_ERROR * float(np.mean(clean + dirt) / 2)
    rows = np.stack([clean, dirt], axis=1) / noise
    seen = colours / smooth[:, None] / noise @ rows
    weights = np.ones(len(colours))
    for _ in range(UNMIXINGS):
        prior = weights / LIGHT_ERROR**2
        covariance = np.linalg.inv(rows.T @ rows + prior[:, None, None] * np.ones((2, 2)))
        p, q = np.einsum("nij,nj->in", covariance, seen + prior[:, None])
        weights = 1.0 / (1.0 + ((p + q - 1.0) / LIGHT_ERROR) ** 2)
    light = np.maximum(p + q, 1e-6)
    slope = np.stack([-q, p], axis=1) / light[:, None] ** 2
    variance = np.einsum("ni,nij,nj->n", slope, covariance, slope)
    return smooth * p, smooth * q, np.sqrt(variance)
