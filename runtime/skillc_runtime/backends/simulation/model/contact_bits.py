"""Which parts of a simulated cell can touch each other: the contact bits of their geoms.

Two geoms can touch if the kind of one is among those that the other meets:

| kind | parts | meets |
|---|---|---|
| CARRIES | floor, furniture and all other fixed bodies, surfaces, fixtures, mobile bases | WORKS, LINK |
| WORKS | working faces of tools | CARRIES, LINK |
| HANDLE | what fingers hold of a tool; the caps of buttons are CARRIES as well | PAD |
| PAD | pads of fingers | HANDLE |
| WORKS and HANDLE | movable bodies | CARRIES, WORKS, HANDLE, PAD, LINK |
| LINK | links, palms, fingers without their pads; the rest of a tool | CARRIES, WORKS, LINK |
| HANDLE and LINK | handles of tools | CARRIES, WORKS, LINK, PAD |

The kind is in `contype`, the kinds that it meets are in `conaffinity`, of one of two partners at least. MuJoCo leaves
out parts of one rigid body and of adjacent ones, `exclude_own_overlaps` those of an arm that overlap by design.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

CARRIES, WORKS, HANDLE, PAD, LINK = 1, 2, 4, 8, 16
"""The contact bits."""

MOVABLE = WORKS | HANDLE, CARRIES | WORKS | HANDLE | PAD
"""Kind of a movable body that nobody holds, and what it meets."""

SOLID = LINK, CARRIES | WORKS | LINK
"""Kind of links, and what they meet."""

LINK_SOLREF, LINK_FRICTION = (0.01, 1.0), 0.3
"""Contact of painted metal."""


def set_solid(geoms: Sequence[Any]) -> None:
    """Let links touch: those geoms of a model that have contact bits, or all if none has.

    Pads and working faces stay as they are; handles become solid as well.
    """
    free = [geom for geom in geoms if geom.contype not in (WORKS, HANDLE, PAD)]
    for geom in [each for each in free if each.contype or each.conaffinity] or free:
        geom.contype, geom.conaffinity = SOLID
        geom.friction = [LINK_FRICTION, 0.005, 0.0001]
        geom.solref[:] = LINK_SOLREF
    for handle in (geom for geom in geoms if geom.contype == HANDLE):
        handle.contype, handle.conaffinity = HANDLE | SOLID[0], PAD | SOLID[1]
