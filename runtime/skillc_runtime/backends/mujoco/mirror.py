"""Steps a model in which things are held, and shows its state in the data of the one in which all is free.

So all that measures, records, films and saves a cell knows one model only, whatever is held.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any, Literal

import msgspec
import numpy as np

from skillc_runtime.backends.mujoco.held_load import Held, make_held, take_off_load
from skillc_runtime.backends.mujoco.model_map import ModelMap, Part, Rows
from skillc_runtime.backends.simulation.machine_code import address_of, address_of_time
from skillc_runtime.motion.arrays import Integers, Vector
from skillc_runtime.motion.numerics.compiled import Bound, bind, compiled, inlined
from skillc_runtime.motion.numerics.copying import Copies, copy_pieces
from skillc_runtime.motion.numerics.places import call_entry
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


class Pull(msgspec.Struct, frozen=True):
    """The force (3,) in N, world axes, of a hand on what is held, in the step after which it was computed last.

    called (1, 3): the addresses of MuJoCo's function, of the model and of its data.
    """

    force: Vector
    called: Integers


@inlined
def measure_pull(pull: Pull) -> None:
    """Compute the force."""
    call_entry(pull.called[0, 0], pull.called[0, 1], pull.called[0, 2])


class HalfStep(msgspec.Struct, frozen=True):
    """Half a step of the tight model: what it takes from the free data before, and what it shows there after.

    called (3,): the addresses of MuJoCo's function, of the model and of its data, all exact.
    """

    before: Copies
    called: Vector
    after: Copies
    held: Held


Half = Literal["mj_step1", "mj_step2"]
"""The function of MuJoCo that computes half a step: what follows from positions and speeds; forces and motion."""


@compiled
def run_half(step: HalfStep, now: float) -> int:
    """Run half of the step that begins at `now` s; arms do not know the load that they hold."""
    copy_pieces(step.before)
    call_entry(int(step.called[0]), int(step.called[1]), int(step.called[2]))
    copy_pieces(step.after)
    take_off_load(step.held)
    return 0


@compiled
def take(copies: Copies, now: float) -> int:
    """Take over what was changed before the rest of the step that begins at `now` s."""
    copy_pieces(copies)
    return 0


class Mirror:
    """Steps the tight model, and shows its state in the data of the free one.

    `blocks` are the outermost bodies of what is held, in the free model. `halves` run half a step each; `take_changes`
    puts all where it is in the free data; `pulls` are those on the blocks.
    """

    def __init__(
        self, rows: ModelMap, free_model: Any, free: Any, tight_model: Any, tight: Any, blocks: list[int]
    ) -> None:
        self.rows, self.tight_model, self.tight, self.blocks = rows, tight_model, tight, blocks
        first, second = (
            np.array([address_of(name), tight_model._address, tight._address], dtype=np.float64)
            for name in ("mj_step1", "mj_step2")
        )
        forces = _taken(rows, FORCES, free, tight), _taken(rows, LIMITS, free_model, tight_model)
        time = address_of_time(free), address_of_time(tight), free.energy.itemsize
        moved = copies(_shown(rows, MOVED, free, tight), [time])
        things = (_find_place(rows, each, free_model, free, tight) for each in blocks)
        placed = copies(_shown(rows, PLACED, free, tight), *things)
        held, nothing = (make_held(rows, each, free, tight_model, tight) for each in (blocks, ()))
        self.halves: dict[Half, Bound[[float], int]] = {
            "mj_step1": bind(run_half, HalfStep(copies(), first, placed, held)),
            "mj_step2": bind(run_half, HalfStep(copies(*forces), second, moved, nothing)),
        }
        self.take_changes = bind(take, copies(_taken(rows, CHANGES, free, tight)))
        called = np.array([[address_of("mj_rnePostConstraint"), tight_model._address, tight._address]])
        self.pulls = [Pull(tight.cfrc_int[rows.bodies[block], 3:], called) for block in blocks]


def _find_place(rows: ModelMap, block: int, free_model: Any, free: Any, tight: Any) -> Iterator[Piece]:
    """Yield what shows where a thing is that is held, in its coordinates in the free model."""
    held, first = int(rows.bodies[block]), int(free_model.jnt_qposadr[free_model.body_jntadr[block]])
    for source, start in ((tight.xpos[held], first), (tight.xquat[held], first + 3)):
        every = np.arange(source.size)
        yield from _find_pieces(source, every, free.qpos, start + every)


def _taken(rows: ModelMap, names: Names, free: Any, tight: Any) -> Iterator[Piece]:
    """Yield what the tight model takes from the free one."""
    for part, each in names.items():
        there, here = rows.of(part)
        for name in each:
            yield from _find_pieces(getattr(free, name), there, getattr(tight, name), here)


def _shown(rows: ModelMap, names: Names, free: Any, tight: Any) -> Iterator[Piece]:
    """Yield what the free model shows of the tight one."""
    for part, each in names.items():
        there, here = rows.of(part)
        for name in each:
            yield from _find_pieces(getattr(tight, name), here, getattr(free, name), there)


def _find_pieces(source: Array, rows: Rows, target: Array, to_rows: Rows) -> Iterator[Piece]:
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
