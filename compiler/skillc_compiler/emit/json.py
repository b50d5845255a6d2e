"""library.json: what the runtime loads."""

from __future__ import annotations

from skillc_compiler.library.codec import dumps
from skillc_compiler.library.skills import SkillLibrary


def emit(library: SkillLibrary) -> dict[str, str]:
    """Return the library as JSON."""
    return {"library.json": dumps(library).decode()}
