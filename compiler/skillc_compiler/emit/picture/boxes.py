"""A picture before it has a form: boxes that hold boxes, with text in the author's words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

Look: TypeAlias = Literal["heading", "flow", "guard", "call", "time", "code"]
"""What a box stands for: a declaration, an order of children, a condition, a skill, a wait, Python."""


@dataclass(frozen=True, slots=True)
class PictureBox:
    """One box: its symbol (one character), its title, further lines, the boxes under it, the skill it calls, if any."""

    look: Look
    symbol: str
    title: str
    lines: tuple[str, ...] = ()
    children: tuple[PictureBox, ...] = ()
    called: str | None = None
