"""Names in kebab case, as PDDL writes them."""

from __future__ import annotations

import re
from functools import lru_cache

_KEBAB = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
_WORD_ENDS = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")
_FOREIGN = re.compile(r"[^a-z0-9_./:#\s-]")
_GAPS = re.compile(r"[^a-z0-9]+")


@lru_cache(maxsize=4096)
def to_kebab(text: str) -> str:
    """Return the text in kebab case: `ArmDevice` becomes arm-device, `Ur5e-1` ur5e-1, a non-ASCII letter its code."""
    if _KEBAB.fullmatch(text):
        return text
    spaced = _WORD_ENDS.sub("-", text).lower()
    plain = _FOREIGN.sub(lambda match: f"-u{ord(match.group()):x}-", spaced)
    name = _GAPS.sub("-", plain).strip("-")
    return name if name[:1].isalpha() else f"x-{name}".strip("-")
