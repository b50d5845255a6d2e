"""Pictures as nested boxes, independent of the output format."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

Look: TypeAlias = Literal["heading", "flow", "guard", "call", "time", "code"]
"""Kinds of boxes: a declaration, control flow, a condition, a skill, a wait, Python code."""


class PictureBox(msgspec.Struct, frozen=True):
    """A box: its symbol (one character), title, further lines, child boxes, and the skill it calls, if any."""

    look: Look
    symbol: str
    title: str
    lines: tuple[str, ...] = ()
    children: tuple[PictureBox, ...] = ()
    called: str | None = None
