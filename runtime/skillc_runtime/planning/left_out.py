"""What a problem leaves out of the scene, and why that is no loss or may be one."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LeftOut:
    """Individuals (IRIs) or skills that a problem leaves out for one reason.

    `harmless` says that it is proved: with them no plan would be cheaper, and there would be none if there is none.
    """

    what: tuple[str, ...]
    why: str
    harmless: bool
