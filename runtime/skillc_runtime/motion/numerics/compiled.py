"""Compiles functions over arrays if numba is installed (the extra `run`); otherwise they run as plain Python.

Each function is compiled at its first call, or with a function that calls it. Loops over numbers compile fast; an
expression over arrays takes ten times as long to compile, an assignment to a slice half a second. Machine code is
stored in the user's cache folder under a name that depends on the sources.
"""

from __future__ import annotations

import logging
import os
import sys
from collections import namedtuple
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import fields, is_dataclass
from functools import cache, cached_property, partial
from hashlib import sha256
from importlib import import_module
from inspect import get_annotations, isfunction
from pathlib import Path
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar, get_args, get_origin, get_type_hints

from skillc_dsl.cache import cache_folder
from skillc_runtime.motion.numerics.places import COMPILES as COMPILES
from skillc_runtime.motion.numerics.places import PLACES, find_place, matrix_at, table_at, vector_at

Parameters = ParamSpec("Parameters")
Result = TypeVar("Result")
First = TypeVar("First")
Returned = TypeVar("Returned", covariant=True)


class Bound(Protocol[Parameters, Returned]):
    """A function with its memory."""

    def __call__(self, *arguments: Parameters.args, **named: Parameters.kwargs) -> Returned:
        """Call it."""
        ...

    @property
    def entry(self) -> tuple[int, int] | None:
        """The addresses of the same as a C function, and of its first argument; None without numba.

        Its other arguments are numbers, integers and booleans, and it returns a 64-bit integer, 0 for None; None for a
        function that has others. The addresses are valid as long as this object; `call_entry` calls them in machine
        code.
        """
        ...


class _BoundOnMemory(partial[Any]):
    """A compiled function with the table of its memory, which keeps its arrays."""

    make_entry: Callable[[], Any] | None = None
    kept: object = None

    @cached_property
    def _c_function(self) -> Any:
        return None if self.make_entry is None else self.make_entry()

    @property
    def entry(self) -> tuple[int, int] | None:
        """As of `Bound`."""
        made = self._c_function
        return None if made is None else (made.address, self.args[0].ctypes.data)


class _BoundInPython(partial[Any]):
    """A function that is not compiled with its memory."""

    entry: None = None


def compiled(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Compile a function for the types of its annotations: those of `arrays`, numbers, bool, and tuples as a result.

    Parameters may be dataclasses whose fields have these types or are such dataclasses; the fields are read-only, the
    contents of arrays are not. Such a function can only be called from Python. If only the first parameter is one, the
    function works on memory: all arrays there are in C order, and it is meant to be called as `bind` returns it.
    Functions that it calls are `compiled` or `inlined` themselves, and stand above it.
    """
    if not COMPILES:
        return function
    packed = [is_dataclass(each) for each in get_annotations(function, eval_str=True).values()]
    if any(packed[1:]):
        return _unpacking(function)
    if packed[0]:
        return _on_memory(function)
    return _compiled_lazily(function)


def bind(function: Callable[Concatenate[First, Parameters], Result], first: First) -> Bound[Parameters, Result]:
    """Return the function with its first parameter fixed: a dataclass whose arrays keep their places in memory.

    A compiled function gets the places of all arrays in one table, so that a call costs the same with any number of
    them. Numbers in the dataclass are read once, here.
    """
    if hasattr(function, "bind"):
        bound: Bound[Parameters, Result] = function.bind(first)
        return bound
    return _BoundInPython(function, first)


def _compiled_lazily(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    made: Any = import_module("numba").njit(error_model="numpy", no_cfunc_wrapper=True)(function)
    compile_for = made.compile

    def compile_once(_first_call: object) -> object:
        """Compile for the annotated types only, not for those of the first call."""
        types = get_annotations(function, eval_str=True)
        returns = _type(types.pop("return"))
        with _lock(), _our_settings() as kept:  # wait ends: when another thread has compiled its function
            if made.overloads:
                return made.overloads[tuple(map(_type, types.values()))].entry_point
            if kept:
                made.enable_caching()
            machine_code = compile_for(returns(*map(_type, types.values())))
            made.disable_compile()
        return machine_code

    made.compile, made.compile_now = compile_once, partial(compile_once, None)
    lazy: Callable[Parameters, Result] = made
    return lazy


def has_stored_code() -> bool:
    """Whether machine code of this version was stored before, or none is needed."""
    base = cache_folder()
    return not COMPILES or (base is not None and (base / f"laws-{_digest()}").is_dir())


def compile_imported() -> None:
    """Compile, or load, the functions of all modules that are imported, as their first calls would.

    So nothing is compiled later, where it would hold up a loop: each takes up to seconds once for a version.
    """
    modules = [module for name, module in sorted(sys.modules.items()) if name.startswith("skillc_runtime.")]
    for each in [value for module in modules for value in vars(module).values() if callable(value)]:
        if (compile_now := getattr(each, "compile_now", None)) is not None:
            compile_now()


def inlined(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Let compiled functions call this one; it is compiled with them, for the types that they pass."""
    if not COMPILES:
        return function
    callable_inside = import_module("numba.extending").register_jitable(
        error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True
    )
    made: Callable[Parameters, Result] = callable_inside(function)
    return made


def _unpacking(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Return a function that passes the fields of dataclasses one by one to a compiled function.

    Numba takes named tuples only if all arrays in them have the same layout and are writable, or none is; it converts
    single arrays.
    """
    annotations = get_annotations(function, eval_str=True)
    returns = annotations.pop("return")
    leaves: dict[str, Any] = {}
    names: dict[str, Any] = {"function": inlined(function), "__name__": function.__module__}
    packed = [_packed(function, annotation, name, leaves, names) for name, annotation in annotations.items()]
    flat = {path.replace(".", "__"): annotation for path, annotation in leaves.items()}
    source = (
        f"def flat({', '.join(flat)}):\n    return function({', '.join(packed)})\n"
        f"def call({', '.join(annotations)}):\n    return flat({', '.join(leaves)})\n"
    )
    unpacking: Callable[Parameters, Result] = _built(function, source, names, "flat", {**flat, "return": returns})
    return unpacking


def _on_memory(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Return a function of a dataclass, whose arrays a compiled function finds by the table of their places."""
    annotations = get_annotations(function, eval_str=True)
    returns = annotations.pop("return")
    first, *others = annotations
    leaves: dict[str, Any] = {}
    names: dict[str, Any] = {"function": inlined(function), "Bound": _BoundOnMemory, "__name__": function.__module__}
    names.update(find_place=find_place, vector_at=vector_at, matrix_at=matrix_at, table_at=table_at)
    names.update(np=import_module("numpy"), make_entry=None)
    packed = _packed(function, annotations[first], first, leaves, names)
    views = [
        f"    {path.replace('.', '__')} = {_view(annotation)}".format(row=row)
        for row, (path, annotation) in enumerate(leaves.items())
    ]
    arguments = "".join(f", {each}" for each in others)
    source = "\n".join(
        (
            f"def at_places(_places{arguments}):", *views, f"    return function({packed}{arguments})",
            f"def bind({first}):",
            f"    kept = [np.asarray(each, np.float64) for each in ({''.join(f'{each}, ' for each in leaves)})]",
            "    call = Bound(at_places, np.array([find_place(each) for each in kept]))",
            f"    call.kept, call.make_entry = (kept, {first}), make_entry",
            "    return call",
            f"def call({first}{arguments}):", f"    return bind({first})({', '.join(others)})", "",
        )
    )  # fmt: skip
    types = {"_places": PLACES, **{each: annotations[each] for each in others}, "return": returns}
    call: Any = _built(function, source, names, "at_places", types)
    call.bind, call.__wrapped__ = names["bind"], function
    numbers = [annotations[each] for each in others]
    if all(each in (float, int, bool) for each in numbers) and returns in (int, bool, None):
        names["make_entry"] = cache(partial(_compile_entry, names, function, numbers, len(leaves), returns is None))
    on_memory: Callable[Parameters, Result] = call
    return on_memory


def _compile_entry(names: dict[str, Any], function: Any, others: list[Any], rows: int, is_void: bool) -> Any:
    """Return the C function of a function on memory: of the address of its table, and of others' numbers."""
    arguments = "".join(f", _{number}" for number in range(len(others)))
    called = f"at_places(table_at(_address, {rows}){arguments})"
    body = f"    {called}\n    return 0\n" if is_void else f"    return int({called})\n"
    source = f"def at_address(_address{arguments}):\n{body}"
    exec(compile(source, function.__code__.co_filename, "exec"), names)
    names["at_address"].__qualname__ = f"{function.__qualname__}_at_address"
    numba = import_module("numba")
    with _lock(), _our_settings() as kept:
        kind = _type(int)(_type(int), *map(_type, others))
        return numba.cfunc(kind, cache=kept, error_model="numpy")(names["at_address"])


def _built(function: Any, source: str, names: dict[str, Any], inner: str, types: dict[str, Any]) -> Any:
    """Return `call` of a source, in which the function `inner`, of these types, is compiled at its first call."""
    exec(compile(source, function.__code__.co_filename, "exec"), names)
    names[inner].__qualname__ = f"{function.__qualname__}_{inner}"
    names[inner].__annotations__ = types
    names[inner] = _compiled_lazily(names[inner])
    call = names["call"]
    call.__doc__, call.__name__, call.compile_now = function.__doc__, function.__name__, names[inner].compile_now
    return call


def _view(annotation: Any) -> str:
    """Return the expression of a field in the table of places: an array there, or a number."""
    if annotation is float:
        return "vector_at(_places, {row})[0]"
    return "vector_at(_places, {row})" if annotation.__metadata__[0] == 1 else "matrix_at(_places, {row})"


@cache
def _names_in(function: Any) -> set[str]:
    """Return the names that a function, and the functions it calls, read from outside, attributes included."""
    found = set(function.__code__.co_names)
    named = (function.__globals__.get(name) for name in found)
    called = (inner for each in named if isfunction(inner := getattr(each, "py_func", each)))
    return found.union(*map(_names_in, called))


def _packed(function: Any, annotation: Any, path: str, leaves: dict[str, Any], names: dict[str, Any]) -> str:
    """Return the expression that builds a parameter from single values; add them to `leaves`, its type to `names`.

    Fields that the function does not use are left out: each argument costs time.
    """
    if not is_dataclass(annotation):
        leaves[path] = annotation
        return path.replace(".", "__")
    assert isinstance(annotation, type)
    hints = get_type_hints(annotation, include_extras=True)
    parts = [(field.name, hints[field.name]) for field in fields(annotation) if field.name in _names_in(function)]
    # Numba distinguishes named tuples only by name and field types, so names must be unique.
    kind = f"{function.__module__}_{function.__name__}_{annotation.__name__}".replace(".", "_")
    names[kind] = namedtuple(kind, [name for name, _ in parts])
    inside = (_packed(function, hint, f"{path}.{each}", leaves, names) for each, hint in parts)
    return f"{kind}({', '.join(inside)})"


def _type(annotation: Any) -> Any:
    """Return numba's type for an annotation."""
    types = import_module("numba").types
    if annotation in (float, int, bool, None):
        return {float: types.float64, int: types.int64, bool: types.boolean, None: types.void}[annotation]
    if get_origin(annotation) is tuple:
        return types.Tuple([_type(each) for each in get_args(annotation)])
    dimensions, access = annotation.__metadata__
    if access == "places":
        return types.Array(types.int64, dimensions, "C", readonly=True)
    return types.Array(types.float64, dimensions, *(("A", True) if access == "read" else ("C", False)))


def _lock() -> AbstractContextManager[object]:
    """Return the lock that numba holds while it compiles; taking it first avoids deadlocks of threads."""
    lock: AbstractContextManager[object] = import_module("numba.core.compiler_lock").global_compiler_lock
    return lock


@contextmanager
def _our_settings() -> Iterator[bool]:
    """Let numba store machine code in our folder, and yield whether there is one; restore its settings afterwards.

    Vectorisation does not speed up loops over three to seven numbers, and makes compiling slower.
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
    """Return the folder of machine code, empty if none can be written; print a message if it is new."""
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
        logging.getLogger("skillc").warning("compiling the control laws, once for this version")
    return str(folder) if os.access(folder, os.W_OK) else ""


def _digest() -> str:
    """Return a digest of the sources of all compiled functions: numba itself checks only the file of each function."""
    runtime = Path(__file__).parents[2]
    sources = sorted(path for path in runtime.rglob("*.py") if b"motion.numerics" in path.read_bytes())
    return sha256(b"\0".join(path.read_bytes() for path in sources)).hexdigest()[:16]
