"""MuJoCo as machine code sees it: where its functions are in memory, and what it has there.

A function that is called through its address ends the process if it fails (`mju_error`), where the Python package
raises an exception. In steps of a model that was checked at its construction only a full stack of the arena does that,
so `has_room` is asked before.
"""

from __future__ import annotations

from ctypes import CDLL, c_void_p, cast
from functools import cache
from pathlib import Path
from typing import Any

import mujoco

USED_SHARE = 0.5
"""The share of the arena up to which steps have room: more than any step needs suddenly."""

LIBRARIES = (f"libmujoco.so.{mujoco.__version__}", f"libmujoco.{mujoco.__version__}.dylib", "mujoco.dll")


@cache
def address_of(function: str) -> int:
    """Return the address of a C function in the library that the Python package has loaded; 0 if it is not found."""
    found = [path for name in LIBRARIES if (path := Path(mujoco.__file__).parent / name).is_file()]
    return cast(getattr(CDLL(str(found[0])), function), c_void_p).value or 0 if found else 0


def has_room(data: Any) -> bool:
    """Tell whether the memory of a simulation is enough for steps like the last ones, and for much larger ones."""
    return bool(data.maxuse_arena < USED_SHARE * data.narena)


def address_of_time(data: Any) -> int:
    """Return where the simulated time is, which in MuJoCo's data comes right before the energy."""
    return int(data.energy.__array_interface__["data"][0]) - int(data.energy.itemsize)
