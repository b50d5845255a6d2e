"""Names for machine code that depend on all that it is made from."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from functools import cache
from hashlib import sha256
from importlib import import_module
from importlib.util import find_spec
from inspect import get_annotations
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.numerics.places import list_leaves

CALLABLE: dict[Callable[..., Any], None] = {}
"""The functions that compiled functions may call and are compiled with them."""


@cache
def key_of(function: Callable[..., Any]) -> str:
    """Return a name for the machine code of a function: of its source, with all that it refers to, and of versions."""
    digest = sha256(_environment())
    for name, annotation in get_annotations(function, eval_str=True).items():
        digest.update("\n".join(path + _name_kind(kind) for path, kind in list_leaves(name, annotation)).encode())
    assert isinstance(function, FunctionType)
    _add(digest, function, set())
    return f"{function.__name__}_{digest.hexdigest()[:24]}"


@cache
def _name_kind(annotation: Any) -> str:
    """Return the annotation of an array or a number as text: there are few, and `typing` takes long to write one."""
    return f": {annotation!r}"


@cache
def _environment() -> bytes:
    """Return a digest of what machine code depends on beside the function: versions, the processor, how it is made."""
    llvm: Any = import_module("llvmlite.binding")
    numba = find_spec("numba")
    assert numba is not None and numba.origin is not None
    found = repr(
        (
            sys.version, np.__version__, llvm.llvm_version_info, llvm.get_process_triple(), llvm.get_host_cpu_name(),
            llvm.get_host_cpu_features().flatten(), Path(numba.origin).with_name("_version.py").read_bytes(),
            *(path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py"))),
        )
    )  # fmt: skip
    return sha256(found.encode()).digest()


def _add(digest: Any, function: FunctionType, seen: set[FunctionType]) -> None:
    """Add to a digest a function with all that it refers to."""
    if function in seen:
        return
    seen.add(function)
    own, called = _describe(function)
    digest.update(own)
    for each in called:
        _add(digest, each, seen)


@cache
def _describe(function: FunctionType) -> tuple[bytes, tuple[FunctionType, ...]]:
    """Return the code of a function with the names or values of what it refers to, and the functions that it calls."""
    cells = {name: cell.cell_contents for name, cell in zip(
        function.__code__.co_freevars, function.__closure__ or (), strict=True
    )}  # fmt: skip
    names, called = {**function.__globals__, **cells}, list[FunctionType]()
    own = sha256()
    for code in _parts(function.__code__):
        own.update(code.co_code + repr((code.co_names, code.co_varnames, code.co_freevars)).encode())
        own.update(repr([each for each in code.co_consts if not isinstance(each, CodeType)]).encode())
        for name in code.co_names + code.co_freevars:
            if name in names:
                value = getattr(names[name], "__wrapped__", names[name])
                if isinstance(value, FunctionType) and value in CALLABLE:
                    called.append(value)
                else:
                    own.update(_tell(names[name]).encode())
    return own.digest(), tuple(called)


def _tell(value: Any) -> str:
    """Return the name of a class, function or module, whose folder says nothing, or else the value as text."""
    return value.__name__ if isinstance(value, ModuleType) else getattr(value, "__qualname__", repr(value))


def _parts(code: CodeType) -> Iterator[CodeType]:
    """Yield a code and those in it."""
    yield code
    for each in code.co_consts:
        if isinstance(each, CodeType):
            yield from _parts(each)
