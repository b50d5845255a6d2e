"""Functions of machine code: stored in the user's cache folder, loaded by llvmlite alone, called as built-in ones."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import msgspec

from skillc_dsl.cache import cache_folder, delete_oldest, load, store
from skillc_runtime.motion.arrays import np

MOST_STORED, LEFT_STORED = 1000, 500
"""With more files in the folder, those that were stored longest ago are deleted."""

CALL, BOUND, ENTRY = "_call", "_bound", "_entry"
"""How the functions end that are emitted for one: it is called from Python with all parameters, or with the address of
the table of the first one instead; and from C with that."""

KNOWN = np.ndarray, TypeError, RuntimeError
"""Objects that machine code needs; numba gives their names another meaning."""

METH_FASTCALL = 0x80


class _Method(ctypes.Structure):
    """A `PyMethodDef`."""

    _fields_ = (
        ("name", ctypes.c_char_p), ("address", ctypes.c_void_p), ("flags", ctypes.c_int), ("doc", ctypes.c_char_p),
    )  # fmt: skip


class MachineCode(msgspec.Struct, frozen=True):
    """What is loaded of a function: built-in functions of Python, of which `bound` needs memory, and the address of the
    C function; None without one."""

    call: Callable[..., Any]
    bound: Callable[..., Any] | None
    entry: int | None


def pack(needed: Sequence[str], code: bytes) -> bytes:
    """Return machine code from an object file that needs functions of these names."""
    return " ".join(needed).encode() + b"\n" + code


def load_stored(key: str) -> bytes | None:
    """Return the machine code with this name if it is stored, not damaged, and finds in this process what it needs.

    Numba, which compiles it otherwise, may bring that along.
    """
    path = _find_path(key)
    code = None if path is None else load(path)
    if code is None:
        return None
    _engine()  # opens the symbols of the process
    llvm, needed = import_module("llvmlite.binding"), code.partition(b"\n")[0].decode().split()
    return code if all(map(llvm.address_of_symbol, needed)) else None


def store_code(key: str, code: bytes) -> None:
    """Store machine code under a name, if the folder can be written."""
    if (path := _find_path(key)) is not None:
        store(path, code)
        delete_oldest(path.parent, MOST_STORED, LEFT_STORED)


def _find_path(key: str) -> Path | None:
    base = cache_folder()
    return None if base is None else base / "machine-code" / key


@cache
def link(key: str, code: bytes) -> MachineCode:
    """Load the machine code with this name into the process, once."""
    llvm, engine = import_module("llvmlite.binding"), _engine()
    engine.add_object_file(llvm.ObjectFileRef.from_data(code.partition(b"\n")[2]))
    engine.finalize_object()
    call, bound, entry = (engine.get_function_address(key + end) for end in (CALL, BOUND, ENTRY))
    return MachineCode(_built_in(key, call), _built_in(key, bound) if bound else None, entry or None)


@cache
def _engine() -> Any:
    llvm: Any = import_module("llvmlite.binding")
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    target = llvm.Target.from_default_triple().create_target_machine()
    return llvm.create_mcjit_compiler(llvm.parse_assembly(""), target)


_methods: list[_Method] = []


def _built_in(name: str, address: int) -> Callable[..., Any]:
    """Return the function at an address as Python calls it; it gets `KNOWN` as itself."""
    _methods.append(_Method(name.encode(), address, METH_FASTCALL, None))
    make = ctypes.pythonapi.PyCFunction_NewEx
    make.restype, make.argtypes = ctypes.py_object, (ctypes.c_void_p, ctypes.py_object, ctypes.c_void_p)
    made: Callable[..., Any] = make(ctypes.addressof(_methods[-1]), KNOWN, None)
    return made
