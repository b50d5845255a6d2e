"""What two models of one scene exchange: pieces of memory."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from skillc_runtime.backends.mujoco.model_map import ModelMap, Part, Rows
from skillc_runtime.motion.numerics.copying import Copies
from skillc_runtime.motion.pose import Array

Names = Mapping[Part, Sequence[str]]
"""Arrays of a model or its data, by what has a row there."""

FORCES: Names = {"dofs": ("qfrc_applied",), "actuators": ("ctrl",), "bodies": ("xfrc_applied",)}
"""What acts on a cell."""

LIMITS: Names = {"actuators": ("actuator_forcerange",)}
"""What fingers change in the model."""

CHANGES: Names = {"coordinates": ("qpos",), "dofs": ("qvel",), "mocaps": ("mocap_pos", "mocap_quat")}
"""What may be put elsewhere between steps."""

MOVED: Names = {
    "coordinates": ("qpos",),
    "dofs": ("qvel", "qacc", "qfrc_actuator"),
    "actuators": ("actuator_force",),
    "sensors": ("sensordata",),
}
"""What the second half of a step computes."""

PLACED: Names = {
    "dofs": ("qfrc_bias", "qfrc_passive", "cdof"),
    "actuators": ("actuator_length", "actuator_velocity"),
    "sensors": ("sensordata",),
    "bodies": ("xpos", "xquat", "xmat", "xipos", "ximat", "subtree_com"),
    "geoms": ("geom_xpos", "geom_xmat"),
    "sites": ("site_xpos", "site_xmat"),
}
"""What the first half computes, from positions and speeds."""

Piece = tuple[int, int, int]
"""As a row of `Copies`."""


def taken(rows: ModelMap, names: Names, free: Any, tight: Any) -> Iterator[Piece]:
    """Yield what the tight model takes from the free one."""
    for part, each in names.items():
        there, here = rows.of(part)
        for name in each:
            yield from find_pieces(getattr(free, name), there, getattr(tight, name), here)


def shown(rows: ModelMap, names: Names, free: Any, tight: Any) -> Iterator[Piece]:
    """Yield what the free model shows of the tight one."""
    for part, each in names.items():
        there, here = rows.of(part)
        for name in each:
            yield from find_pieces(getattr(tight, name), here, getattr(free, name), there)


def find_pieces(source: Array, rows: Rows, target: Array, to_rows: Rows) -> Iterator[Piece]:
    """Yield the copies that make rows of one array those of another; rows that follow each other are one."""
    if not (source.flags.c_contiguous and target.flags.c_contiguous and source.strides == target.strides):
        raise ValueError(f"memory of the shapes {source.shape} and {target.shape} cannot be copied")
    starts = [0, *(np.flatnonzero((np.diff(rows) != 1) | (np.diff(to_rows) != 1)) + 1).tolist(), len(rows)]
    (begin, width), (to_begin, _) = (
        (each.__array_interface__["data"][0], each.strides[0]) for each in (source, target)
    )
    for first, end in pairwise(starts):
        if end > first:
            yield to_begin + width * int(to_rows[first]), begin + width * int(rows[first]), width * (end - first)


def copies(*pieces: Iterable[Piece]) -> Copies:
    """Return pieces as compiled functions take them; who has them keeps the arrays."""
    return Copies(np.array([piece for each in pieces for piece in each], dtype=np.float64).reshape(-1, 3))
