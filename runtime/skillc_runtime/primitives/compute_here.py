"""Lets a primitive compute in this process, for programs that tick it without a tree."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from skillc_runtime.primitives.primitive import Primitive


def compute_here(primitive: Primitive) -> None:
    """Let a primitive compute in this process, at once: for programs that tick it without a tree.

    SkillFailure as of its `computing`.
    """
    computing, result = primitive.computing, None
    primitive.computing = None
    while computing is not None:
        try:
            wanted = computing.send(result)
        except StopIteration:
            return
        result = None if wanted is None else wanted.function(*wanted.arguments)
