"""MuJoCo as machine code sees it: where its functions are in memory, and what it has there.

A function that is called through its address ends the process if it fails (`mju_error`), where the Python package
raises an exception. In steps of a model that was checked at its construction only a full stack of the arena does that,
so `has_room` is asked before.
"""

from __future__ import annotations

from ctypes import CDLL, c_int64, c_void_p, cast
from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.numerics.program import Rows

USED_SHARE = 0.5
"""The share of the arena up to which steps have room: more than any step needs suddenly."""

CONTACTS, ITEM = 64, 8
"""How many contacts `find_geoms` has, and the bytes of one of its numbers."""

LIBRARIES = (f"libmujoco.so.{mujoco.__version__}", f"libmujoco.{mujoco.__version__}.dylib", "mujoco.dll")


@cache
def _find_library() -> CDLL | None:
    found = [path for name in LIBRARIES if (path := Path(mujoco.__file__).parent / name).is_file()]
    return CDLL(str(found[0])) if found else None


@cache
def address_of(function: str) -> int:
    """Return the address of a C function in the library that the Python package has loaded; 0 if it is not found."""
    library = _find_library()
    return cast(getattr(library, function), c_void_p).value or 0 if library is not None else 0


def stop_timers() -> None:
    """Let MuJoCo not measure how long the parts of its steps take; `MjData.timer` then has their numbers alone.

    The Python package gives MuJoCo a clock, which is read twice for each part: a sixth of a minimal step.
    `mujoco.set_mjcb_time(None)` gives it back.
    """
    library = _find_library()
    if library is not None:
        c_void_p.in_dll(library, "mjcb_time").value = None


def row_calling(function: str, model: Any, data: Any) -> Rows | None:
    """Return the row of a program that calls a function with a model and its data; None if it cannot be called."""
    address = address_of(function)
    return ((address, model._address, data._address),) if address else None


def has_room(data: Any) -> bool:
    """Tell whether the memory of a simulation is enough for steps like the last ones, and for much larger ones."""
    return bool(data.maxuse_arena < USED_SHARE * data.narena)


def address_of_time(data: Any) -> int:
    """Return where the simulated time is, which in MuJoCo's data comes right before the energy."""
    return int(data.energy.__array_interface__["data"][0]) - int(data.energy.itemsize)


def find_warnings(data: Any) -> NDArray[np.int64]:
    """Return a view (1, n) of what MuJoCo has warned of, not 0 for each warning with a count that is not."""
    return _view(data.warning.lastinfo.__array_interface__["data"][0], len(data.warning.number))


def find_counts(data: Any) -> NDArray[np.int64]:
    """Return a view (1, 1) of how many contacts and equality constraints there are, the former in the lower 32 bits.

    In MuJoCo's data these two integers follow the timers, of 16 bytes each.
    """
    last = data.timer.number[-1:].__array_interface__["data"][0]
    return _view(last + 8, 1)


def find_geoms(data: Any) -> NDArray[np.int64]:
    """Return a view (CONTACTS, n) of what MuJoCo has of contacts, a row each; there has to be one now.

    The first two columns have the numbers of its geoms, of 32 bits each, and what is beside them, which they decide.
    """
    geoms = data.contact.geom
    address, width = geoms.__array_interface__["data"][0], geoms.strides[0] // ITEM
    return _view(address - address % ITEM, CONTACTS * width).reshape(CONTACTS, width)


def _view(address: int, count: int) -> NDArray[np.int64]:
    return np.ctypeslib.as_array((c_int64 * count).from_address(address)).reshape(1, count)
