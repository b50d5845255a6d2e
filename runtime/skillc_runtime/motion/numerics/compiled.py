"""Compiles functions over arrays if numba is installed (the extra `run`); otherwise they run as plain Python.

Each function is compiled at its first call, when it is bound, or before by `compile_imported`, and then stored in the
user's cache folder: what is stored is loaded without numba. Loops over numbers compile fast; an expression over arrays
takes ten times as long to compile, an assignment to a slice half a second.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial, update_wrapper
from importlib import import_module
from importlib.util import find_spec
from inspect import get_annotations
from mmap import mmap
from threading import RLock
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar

from skillc_dsl.garbage import gc_disabled
from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.numerics.code_key import CALLABLE, key_of
from skillc_runtime.motion.numerics.machine_code import MachineCode, link, load_stored, store_code
from skillc_runtime.motion.numerics.places import find_place, is_record, list_arrays, list_leaves

Parameters = ParamSpec("Parameters")
Result = TypeVar("Result")
Returned = TypeVar("Returned", covariant=True)
First = TypeVar("First")

COMPILES: bool = os.environ.get("SKILLC_COMPILED", "1") != "0" and find_spec("numba") is not None
"""Whether functions are compiled; SKILLC_COMPILED=0 in the environment turns it off."""

LISTENERS: list[Callable[[int], None]] = []
"""Called with 1 when a function begins to be compiled, which may take longer than a tick, and with -1 after it."""

_announced = mmap(-1, 1)  # forks share it
_lock = RLock()
if hasattr(os, "register_at_fork"):  # a child of a process in which another thread compiles would wait for ever
    os.register_at_fork(before=_lock.acquire, after_in_parent=_lock.release, after_in_child=_lock.release)


class Bound(Protocol[Parameters, Returned]):
    """A function with its memory."""

    def __call__(self, *arguments: Parameters.args, **named: Parameters.kwargs) -> Returned:
        """Call it."""
        ...

    @property
    def entry(self) -> tuple[int, int] | None:
        """The addresses of the same as a C function, and of its first argument; None without numba.

        Its other arguments are numbers, integers and booleans, and it returns an integer of 64 bits, 0 for None; None
        for a function with others. The addresses are valid as long as this object; see `places.call_entry`.
        """
        ...

    @property
    def rows(self) -> tuple[tuple[int, int, int], ...] | None:
        """The entry as the row of a `program`, always the same object; None without one."""
        ...


class _BoundFunction(partial[Any]):
    """As `Bound`; keeps the memory."""

    entry: tuple[int, int] | None = None
    rows: tuple[tuple[int, int, int], ...] | None = None
    kept: object = None


class _Compiled(partial[Any]):
    """A function of machine code, which it is from its first call on."""

    code: MachineCode | None = None
    is_rare = False
    __wrapped__: Callable[..., Any]

    def compile_now(self) -> MachineCode:
        """Compile the function, or load it, unless that was done."""
        with _lock:  # wait ends: when another thread has compiled what it calls
            if self.code is None:
                self.code = _make(self.__wrapped__)
            return self.code

    def call_first(self, *arguments: Any) -> Any:
        """Call the function, which is compiled before; many are only bound, and need no form to be called in."""
        self.call_from_now_on(_flattening(self.__wrapped__, self.compile_now().call))
        return self(*arguments)

    def call_from_now_on(self, function: Callable[..., Any]) -> None:
        """Be the same as another function."""
        state: Any = self
        state.__setstate__((function, (), {}, self.__dict__))

    @property
    def _numba_type_(self) -> Any:
        return import_module("skillc_runtime.motion.numerics.emission").find_type(self.__wrapped__)


_imported: list[_Compiled] = []
"""All there are, in the order in which they were imported."""


def compiled(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Compile a function for the types of its annotations: those of `arrays`, numbers, bool, and tuples as a result.

    Arguments are passed by position. Parameters may be structs, or dataclasses, whose fields have these types or
    are such; fields are read-only, the contents of arrays are not. If only the first parameter is one, it is memory:
    all arrays there are in C order, and the function may be called as `bind` returns it, which costs less. Functions
    that it calls are `compiled` or `inlined` themselves, for the types that it passes.
    """
    inlined(function)
    if not COMPILES:
        return function
    made: Any = _Compiled(function)
    update_wrapper(made, function)
    made.call_from_now_on(made.call_first)
    _imported.append(made)
    lazy: Callable[Parameters, Result] = made
    return lazy


def compiled_when_called(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Compile a function that no loop calls, as `compiled` does, but not before it is called."""
    made = compiled(function)
    if isinstance(made, _Compiled):
        made.is_rare = True
    return made


def inlined(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Let compiled functions call this one; it is compiled with them, for the types that they pass."""
    CALLABLE[function] = None
    return function


def bind(function: Callable[Concatenate[First, Parameters], Result], first: First) -> Bound[Parameters, Result]:
    """Return the function with its first parameter fixed: a struct whose arrays keep their places in memory.

    A compiled function gets the places of all arrays in one table, so that a call costs the same with any number of
    them. Numbers in the struct are read once, here.
    """
    if not isinstance(function, _Compiled):
        return _BoundFunction(function, first)
    code = function.compile_now()
    arrays = list_arrays(first)
    table = np.array([find_place(each) for each in arrays])
    assert code.bound is not None
    bound = _BoundFunction(code.bound, table.ctypes.data)
    bound.kept = first, arrays, table
    if code.entry is not None:
        bound.entry = (code.entry, table.ctypes.data)
        bound.rows = ((*bound.entry, 0),)
    return bound


def compile_imported() -> None:
    """Compile, or load, the functions of all modules that are imported, as their first calls would.

    So nothing is compiled later, where it would hold up a loop: each takes up to seconds once for a version.
    """
    for each in list_imported():
        each.compile_now()


def list_imported() -> list[_Compiled]:
    """Return the compiled functions that loops may call, of all modules of this package that are imported."""
    return [each for each in _imported if each.__module__.startswith("skillc_runtime.") and not each.is_rare]


def _make(function: Callable[..., Any]) -> MachineCode:
    """Load or compile a function."""
    key = key_of(function)
    code = load_stored(key)
    if code is None:
        _announce()
        with _telling(), gc_disabled():
            emission: Any = import_module("skillc_runtime.motion.numerics.emission")
            emission.let_be_called(CALLABLE)
            code = emission.emit(function, key)
        store_code(key, code)
    return link(key, code)


def _announce() -> None:
    """Say why it takes so long, once in this process and its forks: a plan is looked at beside what begins to run."""
    if not _announced[0]:
        _announced[0] = 1
        logging.getLogger("skillc").warning("compiling the control laws, once for this version, for about 20 s")


@contextmanager
def _telling() -> Iterator[None]:
    listeners = tuple(LISTENERS)
    for tell in listeners:
        tell(1)
    try:
        yield
    finally:
        for tell in listeners:
            tell(-1)


def _flattening(function: Callable[..., Any], call: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that passes the fields of structs one by one to machine code."""
    annotations = get_annotations(function, eval_str=True)
    del annotations["return"]
    if not any(map(is_record, annotations.values())):
        return call
    leaves = [path for name, annotation in annotations.items() for path, _ in list_leaves(name, annotation)]
    names: dict[str, Any] = {"call": call}
    exec(f"def flat({', '.join(annotations)}):\n    return call({', '.join(leaves)})\n", names)
    made: Callable[..., Any] = names["flat"]
    return made
