"""Imports hundreds of modules in less time: no garbage is looked for, and methods of dataclasses are compiled once.

`dataclasses` compiles the methods of each class from a text, which takes a fifth of the time of a start.
Here the code of each text is kept in the user's cache folder. The same text gives the same code in a version of Python.
"""

from __future__ import annotations

import dataclasses
import gc
import marshal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import MAGIC_NUMBER
from pathlib import Path
from types import CodeType
from typing import Any

from skillc_dsl.cache import cache_folder, load, store
from skillc_dsl.garbage import gc_disabled

_MOST = 10_000
"""The most texts that are kept under a name; beyond it those are that were used last."""
_EXEC = "exec"
"""What `dataclasses` calls with a text: the built-in function, unless the module has one of this name."""


@contextmanager
def importing(program: str) -> Iterator[None]:
    """Import what a program of some name needs in the block, which does nothing else.

    What it leaves, which stays, is exempt from collections of garbage for ever.
    """
    before = len(sys.modules)
    with gc_disabled(), keeping_code(program):
        yield
        if len(sys.modules) > before:
            gc.freeze()


@contextmanager
def keeping_code(name: str) -> Iterator[None]:
    """Keep the code of dataclasses whose modules are imported in the block; it is found again by a name."""
    path, names = _find_path(name), vars(dataclasses)
    if path is None or _EXEC in names:
        yield
        return
    kept, used = _read(path), dict[str, CodeType]()

    def execute(text: str, *namespaces: dict[str, Any]) -> None:
        code = used.get(text) or kept.get(text) or compile(text, "<string>", "exec", dont_inherit=True)
        used[text] = code
        exec(code, *namespaces)

    names[_EXEC] = execute
    try:
        yield
    finally:
        del names[_EXEC]
        if not used.keys() <= kept.keys():
            every = {**kept, **used}
            store(path, marshal.dumps(every if len(every) <= _MOST else used))


def _find_path(name: str) -> Path | None:
    folder = cache_folder()
    return None if folder is None else folder / "dataclasses" / f"{name}-{MAGIC_NUMBER.hex()}"


def _read(path: Path) -> dict[str, CodeType]:
    """Return the code that is kept in a file, by text; none if there is no file, or a damaged one."""
    body = load(path)
    found: dict[str, CodeType] = {} if body is None else marshal.loads(body)
    return found
