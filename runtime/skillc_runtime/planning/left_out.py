"""What a problem leaves out of the scene and of the library, and why that is no loss or may be one."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Literal, TypeAlias

Kind: TypeAlias = Literal["individuals", "skills", "steps"]


@dataclass(frozen=True, slots=True)
class LeftOut:
    """Individuals (IRIs), skills or steps, in any order, that a problem leaves out for one reason.

    `harmless` says that it is proved: with them no plan would be cheaper, and there would be none if there is none.
    """

    members: Collection[str]
    why: str
    harmless: bool
    kind: Kind = "individuals"

    @property
    def what(self) -> tuple[str, ...]:
        """Return them sorted: there may be a million, and most answers tell none."""
        return tuple(sorted(self.members))
