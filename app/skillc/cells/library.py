"""The library that a cell runs."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import msgspec

from skillc.cells.settings import CellSettings
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc.services.library.modules import find_modules
from skillc.services.project.backends import adapt_library
from skillc_model.skills import SkillLibrary
from skillc_runtime.platforms.python_modules import import_named
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS, ForeignError, foreign_code


def decode_library(content: bytes) -> SkillLibrary:
    """Read a compiled library that a server has checked."""
    return msgspec.msgpack.decode(content, type=SkillLibrary)


def encode_library(library: SkillLibrary) -> bytes:
    """Return a library for another process."""
    return msgspec.msgpack.encode(library)


def load_library(settings: CellSettings) -> SkillLibrary:
    """Return the library of a cell, with the modules loaded that it was checked with, and all that it names.

    So no tick waits for an import. A module that cannot be imported is named by whoever needs it.
    """
    _import(settings.modules)
    library = (
        decode_library(settings.content) if settings.content else compile_valid(find_library(Path(settings.library)))
    )
    library = adapt_library(library, settings.backend)
    _import(find_modules(library))
    return library


def _import(modules: Iterable[str]) -> None:
    for each in dict.fromkeys(modules):
        with suppress(*FOREIGN_ERRORS, ForeignError), foreign_code:
            import_named(each)
