"""Emits library.json, which the runtime loads."""

from __future__ import annotations

from skillc_model.codec import dumps
from skillc_model.skills import SkillLibrary


def emit(library: SkillLibrary) -> dict[str, str]:
    """Return the library as JSON."""
    return {"library.json": dumps(library).decode()}
