"""Which parts of a simulated cell can touch each other: the contact bits of their geoms.

Two geoms can touch if the kind of one is among those that the other meets:

| kind | parts | meets |
|---|---|---|
| CARRIES | floor, furniture and all other fixed bodies, surfaces, fixtures | WORKS |
| WORKS | working faces of tools | CARRIES |
| HANDLE | what fingers hold of a tool; the caps of buttons are CARRIES as well | PAD |
| PAD | pads of fingers | HANDLE |
| WORKS and HANDLE | movable bodies | CARRIES, WORKS, HANDLE, PAD |

The kind is in `contype`, the kinds that it meets are in `conaffinity`, of one of two partners at least.
"""

from __future__ import annotations

CARRIES, WORKS, HANDLE, PAD = 1, 2, 4, 8
"""The contact bits."""

MOVABLE = WORKS | HANDLE, CARRIES | WORKS | HANDLE | PAD
"""Kind of a movable body that nobody holds, and what it meets."""
