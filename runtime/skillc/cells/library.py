"""The library that a cell runs."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import msgspec

from skillc.cells.settings import CellSettings
from skillc.services.libraries import compile_valid
from skillc.services.library_files import find_library
from skillc_model.skills import SkillLibrary
from skillc_runtime.platforms.python_modules import import_named
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS, ForeignError, foreign_code


def decode_library(content: bytes) -> SkillLibrary:
    """Read a compiled library that a server has checked."""
    return msgspec.msgpack.decode(content, type=SkillLibrary)


def load_library(settings: CellSettings) -> SkillLibrary:
    """Return the library of a cell, with the modules loaded that it was checked with."""
    for each in settings.modules:
        with suppress(*FOREIGN_ERRORS, ForeignError), foreign_code:  # the skill that needs it reports the reason
            import_named(each)
    return decode_library(settings.content) if settings.content else compile_valid(find_library(Path(settings.library)))
