"""Checks that what is known of a tool or a fixture is what its model has: size, width between the fingers, weight."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import FIXTURE, GRASP_WIDTH, HAS_SHEET, SIZE, TOOL, WEIGHT
from skillc_runtime.world.state.world_state import WorldState

HANDLE = "handle"
"""What the fingers hold of a tool; it is not part of the size of a tool."""

ROUND_ENDED = 3
"""The number of capsules among the types of geoms of MuJoCo."""

TOLERANCE_M = 0.002
SHARE_OF_WEIGHT = 0.1


@dataclass(frozen=True, slots=True)
class ModelSizes:
    """The size (3,) in m of a model without its handle, that of its handle (None without one), its mass in kg."""

    size: tuple[float, ...]
    handle: tuple[float, ...] | None
    mass_kg: float


def check_model_sizes(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield sizes, widths and weights of tools and fixtures that differ from their readable models."""
    for thing in sorted({each for cls in (TOOL, FIXTURE) for each in state.instances(cls)}):
        if HAS_SHEET not in state.facts or all(state.value(thing, name) is None for name in (*SIZE, WEIGHT)):
            continue
        try:
            sizes = read_model_sizes(sheet_of(state, thing).model)
        except (SheetError, ValueError):
            continue
        yield from _differences(state, thing, sizes)


@cache
def read_model_sizes(path: Path) -> ModelSizes:
    """Return the sizes of an MJCF file; ValueError if it cannot be read."""
    # The simulator is slow to import.
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    names = [model.geom(index).name for index in range(model.ngeom)]
    low, high = _extents(model, data)
    held = [index for index, name in enumerate(names) if name == HANDLE]
    rest = [index for index, name in enumerate(names) if name != HANDLE]
    return ModelSizes(
        size=_size(low, high, rest),
        handle=_size(low, high, held) if held else None,
        mass_kg=float(model.body_mass.sum()),
    )


def _extents(model: object, data: object) -> tuple[Array, Array]:
    """Return the lowest and highest corners (ngeom, 3) in m of the geoms, along the axes of the model."""
    middle, half = model.geom_aabb[:, :3], model.geom_aabb[:, 3:]  # type: ignore[attr-defined]
    rotation = data.geom_xmat.reshape(-1, 3, 3)  # type: ignore[attr-defined]
    centre = data.geom_xpos + np.einsum("nij,nj->ni", rotation, middle)  # type: ignore[attr-defined]
    # Round ends reach as far in all directions, which the box around a capsule that is turned does not.
    round_m = np.where(model.geom_type == ROUND_ENDED, model.geom_size[:, 0], 0.0)[:, None]  # type: ignore[attr-defined]
    reach = np.einsum("nij,nj->ni", np.abs(rotation), half - round_m) + round_m
    return centre - reach, centre + reach


def _size(low: Array, high: Array, chosen: list[int]) -> tuple[float, ...]:
    if not chosen:
        return (0.0, 0.0, 0.0)
    return tuple((high[chosen].max(axis=0) - low[chosen].min(axis=0)).tolist())


def _differences(state: WorldState, thing: str, sizes: ModelSizes) -> Iterator[SceneViolation]:
    for name, actual_m in zip(SIZE, sizes.size, strict=True):
        yield from _length(state, thing, name, actual_m)
    if sizes.handle is not None:
        stated = state.value(thing, GRASP_WIDTH)
        widths = sizes.handle[:2]
        if isinstance(stated, int | float):
            yield from _length(state, thing, GRASP_WIDTH, min(widths, key=lambda each: abs(each - stated)))
    weight = state.value(thing, WEIGHT)
    if isinstance(weight, int | float) and abs(weight - sizes.mass_kg) > SHARE_OF_WEIGHT * sizes.mass_kg > 0:
        yield _differs(state, thing, WEIGHT, f"{sizes.mass_kg:g}", "kg")


def _length(state: WorldState, thing: str, name: str, actual_m: float) -> Iterator[SceneViolation]:
    stated = state.value(thing, name)
    if isinstance(stated, int | float) and abs(stated - actual_m) > TOLERANCE_M:
        yield _differs(state, thing, name, f"{actual_m:.4g}", "m")


def _differs(state: WorldState, thing: str, name: str, actual: str, unit: str) -> SceneViolation:
    short = state.vocabulary.short
    sheet = short(sheet_of(state, thing).individual)
    stated = f"{short(thing)}.{short(name)} is {state.value(thing, name):g} {unit}"
    message = f"{stated}, and its model in {sheet} has {actual} {unit}"
    cure = f"write `{short(name)} {actual}`, or name the sheet of this thing"
    return SceneViolation(thing, name, "size-differs", message, cure, "warning")
