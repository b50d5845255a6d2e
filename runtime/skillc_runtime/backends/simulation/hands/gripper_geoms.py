"""The geoms of a gripper and of what it grasps in the model of a cell."""

from __future__ import annotations

from typing import Any

from skillc_runtime.backends.simulation.model.contact_bits import HANDLE
from skillc_runtime.backends.simulation.names import part_name


def find_handles(model: Any, thing: str) -> frozenset[int]:
    """Return the geoms of an object that pads of fingers touch: the handle of a tool, all solids of a body."""
    block = model.body(part_name(thing, "block")).id
    of_thing = (model.body_rootid[model.geom_bodyid] == block) & ((model.geom_contype & HANDLE) > 0)
    return frozenset(of_thing.nonzero()[0].tolist())


def find_pads(model: Any, gripper: str) -> frozenset[int]:
    """Return the geoms with which the fingers of a gripper touch things."""
    prefix = part_name(gripper, "")
    names = ((number, model.geom(number).name) for number in range(model.ngeom))
    return frozenset(number for number, name in names if name.startswith(prefix) and name.endswith("_pad"))
