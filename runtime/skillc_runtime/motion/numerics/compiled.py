"""Compiles functions over arrays where numba is installed (the extra `fast`); elsewhere they run as they are.

Each is compiled when it is first called, or when another that calls it is compiled. Loops over numbers compile fast;
an expression over arrays costs ten times as much, a slice that is assigned to half a second. The machine code is kept
in the user's cache folder, named after the sources it was made of.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import cache
from hashlib import sha256
from importlib import import_module
from importlib.util import find_spec
from inspect import get_annotations
from pathlib import Path
from typing import Annotated, Any, ParamSpec, TypeVar, get_args, get_origin

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.cache_folder import cache_folder

Vector = Annotated[NDArray[np.float64], 1, "read"]
Matrix = Annotated[NDArray[np.float64], 2, "read"]
OutVector = Annotated[NDArray[np.float64], 1, "written"]
OutMatrix = Annotated[NDArray[np.float64], 2, "written"]
"""What a compiled function takes: arrays of so many dimensions that it reads, of any layout, or writes, in C order."""

Parameters = ParamSpec("Parameters")
Result = TypeVar("Result")

COMPILES: bool = os.environ.get("SKILLC_COMPILED", "1") != "0" and find_spec("numba") is not None
"""Whether functions are compiled; SKILLC_COMPILED=0 in the environment leaves them as they are."""


def compiled(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Compile a function for the types of its annotations: those above, numbers, bool, and tuples as a result.

    Functions it calls are `compiled` or `part` themselves.
    """
    if not COMPILES:
        return function
    made: Any = import_module("numba").njit(error_model="numpy", no_cfunc_wrapper=True)(function)
    compile_for = made.compile

    def compile_once(_first_call: object) -> object:
        """Compile for the annotated types, whatever those of the first call, and for no others."""
        types = get_annotations(function, eval_str=True)
        returns = _type(types.pop("return"))
        with _lock(), _our_settings() as kept:
            if made.overloads:
                return made.overloads[tuple(map(_type, types.values()))].entry_point
            if kept:
                made.enable_caching()
            machine_code = compile_for(returns(*map(_type, types.values())))
            made.disable_compile()
        return machine_code

    made.compile = compile_once
    lazy: Callable[Parameters, Result] = made
    return lazy


def part(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Let compiled functions call this one, compiled with them for whatever they pass; elsewhere it stays as it is."""
    if not COMPILES:
        return function
    callable_inside = import_module("numba.extending").register_jitable(
        error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True
    )
    made: Callable[Parameters, Result] = callable_inside(function)
    return made


def _type(annotation: Any) -> Any:
    """Return numba's type for an annotation."""
    types = import_module("numba").types
    if annotation in (float, int, bool, None):
        return {float: types.float64, int: types.int64, bool: types.boolean, None: types.void}[annotation]
    if get_origin(annotation) is tuple:
        return types.Tuple([_type(each) for each in get_args(annotation)])
    dimensions, access = annotation.__metadata__
    return types.Array(types.float64, dimensions, *(("A", True) if access == "read" else ("C", False)))


def _lock() -> AbstractContextManager[object]:
    """Return what numba holds while it compiles, so that threads never wait for each other in turn."""
    lock: AbstractContextManager[object] = import_module("numba.core.compiler_lock").global_compiler_lock
    return lock


@contextmanager
def _our_settings() -> Iterator[bool]:
    """Let numba keep what it compiles in our folder, and tell if there is one; its settings are put back afterwards.

    Loops over three to seven numbers gain nothing from what numba does for long ones but take longer to compile.
    """
    config: Any = import_module("numba").config
    ours = {"CACHE_DIR": _folder(), "OPT": 1, "LOOP_VECTORIZE": 0}
    before = {name: getattr(config, name) for name in ours}
    try:
        vars(config).update(ours)
        yield config.CACHE_DIR != ""
    finally:
        vars(config).update(before)


@cache
def _folder() -> str:
    """Return where machine code is kept, empty where nothing can be; say so when it has to be made first."""
    base = cache_folder()
    if base is None:
        return ""
    folder = base / f"laws-{_digest()}"
    new = not folder.is_dir()
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except OSError:
        return ""
    if new:
        print("compiling the control laws, once for this version", file=sys.stderr)
    return str(folder) if os.access(folder, os.W_OK) else ""


def _digest() -> str:
    """Return a name for the sources of whatever may be compiled: numba itself looks at one file at a time."""
    runtime = Path(__file__).parent.parent
    sources = sorted(path for path in runtime.glob("*/*.py") if b"numerics.compiled" in path.read_bytes())
    return sha256(b"\0".join(path.read_bytes() for path in sources)).hexdigest()[:16]
