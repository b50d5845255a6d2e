"""Estimates the mass and the centre of mass of what a hand holds, from what an arm at rest feels in several postures.

The weight of what is held differs from what the arm counts with by a mass dm in kg, and its first moment about the
tool centre point by ds in kg m, along the axes of the tool. With the axes R of the tool in the world and gravity g, the
arm feels the wrench w = G(R) x, x = (dm, ds), where

    G(R) = [ g   0         ]
           [ 0   -[g]x R   ]

A sensor in the wrist adds a constant wrench b along its own axes, and a drift d of its force:
w = G x + diag(R, R) (b + (d, 0) t). Torque sensors in the joints measure tau = J^T G x + k tau_g + b: they add a
constant b to each joint, and the model of the arm's own weight, tau_g, is wrong by the share k. All of this is found
together, by least squares; what each number adds must differ between the postures.

C. G. Atkeson, C. H. An, J. M. Hollerbach: Estimation of Inertial Parameters of Manipulator Loads and Links,
International Journal of Robotics Research 5(3), 1986; at rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import msgspec
import numpy as np

from skillc_runtime.motion.pose import Array, skew

GRAVITY: Final = np.array([0.0, 0.0, -9.81])
"""m/s^2, in the world."""

SIZE_M: Final = 0.1
"""A length of the size of what hands hold, by which masses and first moments are compared."""

MOST_CONDITION: Final = 50.0
"""A greater condition says that postures hardly tell the payload from the errors of the sensors."""


class LoadSample(msgspec.Struct, frozen=True):
    """What an arm at rest feels: the mean wrench (6,) on its tool in N and N m, world axes, at `at_s` s.

    rotation (3, 3): the axes of the tool in the world, one a column.
    """

    rotation: Array
    wrench: Array
    at_s: float


class LinkSample(msgspec.Struct, frozen=True):
    """What the links of an arm at rest feel.

    rotation (3, 3): the axes of the tool in the world, one a column. torque (nv,): N m, by which its sensors differ
    from the weight that the arm counts with; own (nv,): N m, that weight; jacobian (6, nv): of the tool, world axes.
    """

    rotation: Array
    torque: Array
    own: Array
    jacobian: Array


class PayloadError(msgspec.Struct, frozen=True):
    """By how much a payload differs from what the arm counts with, and how certain that is.

    mass_kg: kg. moment (3,): kg m, about the tool centre point, along its axes. mass_deviation_kg, moment_deviation:
    the standard deviations of the mass and of the least certain part of the moment, by what the measurements leave
    unexplained. condition: of the payload's part of the equations, once the part that errors of the sensors could cause
    is taken off; infinite if nothing is left.
    """

    mass_kg: float
    moment: Array
    mass_deviation_kg: float
    moment_deviation: float
    condition: float


UNKNOWN: Final = PayloadError(0.0, np.zeros(3), np.inf, np.inf, np.inf)
"""What is known before anything is felt."""


def weight_matrix(rotation: Array) -> Array:
    """Return G (6, 4), see above, for the axes (3, 3) of a tool in the world, one a column."""
    matrix = np.zeros((6, 4))
    matrix[:3, 0] = GRAVITY
    matrix[3:, 1:] = -skew(GRAVITY) @ rotation
    return matrix


def estimate_by_wrist(samples: Sequence[LoadSample]) -> PayloadError:
    """Return the error of the payload by a sensor in the wrist, which has a constant error and drifts."""
    rows, errors = [], []
    for each in samples:
        turned = np.kron(np.eye(2), each.rotation)
        rows.append(weight_matrix(each.rotation))
        errors.append(np.hstack([turned, turned[:, :3] * (each.at_s - samples[0].at_s)]))
    felt = np.concatenate([each.wrench for each in samples])
    # A torque of so many N m counts as much as a force of one N.
    scale = np.tile([1.0, 1.0, 1.0, 1.0 / SIZE_M, 1.0 / SIZE_M, 1.0 / SIZE_M], len(samples))
    return _solve(np.vstack(rows), np.vstack(errors), felt, scale)


def estimate_by_links(samples: Sequence[LinkSample], effort: Array) -> PayloadError:
    """Return the error of the payload by torque sensors in the joints, with constant errors, and a wrong own weight.

    effort: (nv,) in N m, the greatest torques of the joints: sensors are as exact as a share of these.
    """
    rows, errors = [], []
    for each in samples:
        rows.append(each.jacobian.T @ weight_matrix(each.rotation))
        errors.append(np.column_stack([each.own, np.eye(each.own.size)]))
    felt = np.concatenate([each.torque for each in samples])
    return _solve(np.vstack(rows), np.vstack(errors), felt, np.tile(1.0 / effort, len(samples)))


def _solve(payload: Array, errors: Array, felt: Array, scale: Array) -> PayloadError:
    """Solve payload x + errors e = felt, rows weighted by `scale`, for x; e is taken off by projection."""
    unit = np.array([1.0, SIZE_M, SIZE_M, SIZE_M])
    wanted, disturbing, measured = payload * unit * scale[:, None], errors * scale[:, None], felt * scale
    basis, sizes, _ = np.linalg.svd(disturbing / np.linalg.norm(disturbing, axis=0).clip(1e-12), full_matrices=False)
    basis = basis[:, sizes > 1e-9 * sizes[0]]
    left = wanted - basis @ (basis.T @ wanted)
    least, most = np.linalg.svd(left, compute_uv=False)[-1], np.linalg.svd(wanted, compute_uv=False)[0]
    if least <= 1e-9 * most:
        return UNKNOWN
    free = measured - basis @ (basis.T @ measured)
    solution = np.linalg.lstsq(left, free, rcond=None)[0]
    unexplained = free - left @ solution
    freedom = max(felt.size - basis.shape[1] - 4, 1)
    spread = np.sqrt(unexplained @ unexplained / freedom * np.diag(np.linalg.inv(left.T @ left))) * unit
    found = solution * unit
    return PayloadError(float(found[0]), found[1:], float(spread[0]), float(spread[1:].max()), float(most / least))
