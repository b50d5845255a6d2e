"""Why something does not go in space."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.position import Position

Cause: TypeAlias = Literal[
    "out-of-reach",
    "joint-range",
    "torque",
    "in-the-way",
    "no-path",
    "no-way",
    "no-grasp-or-place",
    "no-value",
    "nothing-fits",
]
"""Why it does not go: `no-path` of an arm, `no-way` of a base.

After `no-value` nobody knows: it depends on a value that the world model does not have yet."""


class SpaceFailure(msgspec.Struct, frozen=True):
    """Why a primitive does not get what it needs, as a sentence without its subject.

    `depth` is how many motions went well before, `within` the calls around it, from the outermost on, which begins at
    `source`. If it is `in_any_posture`, it does not go however the arms have come there.
    """

    cause: Cause
    why: str
    depth: int = 0
    within: tuple[str, ...] = ()
    source: Position | None = None
    in_any_posture: bool = False

    @property
    def is_in_space(self) -> bool:
        """Whether it does not go because of space, and not because of facts or values."""
        return self.cause not in ("no-value", "nothing-fits")

    @property
    def message(self) -> str:
        """The failure as a sentence that begins with the innermost skill."""
        return f"{self.within[-1]}: {self.why}" if self.within else self.why
