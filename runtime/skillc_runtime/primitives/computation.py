"""What takes a primitive long: computed beside the ticks, in another process, while its devices hold still."""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import Any, TypeAlias

import msgspec

LIMIT_S = 60.0
"""How long a computation may take by default, in s of wall time."""


class Computation(msgspec.Struct, frozen=True):
    """A call of a function of a module, in another process: its arguments and its result are copied, with `pickle`.

    The function uses no devices and starts no programs. So that its result does not depend on the machine, it limits
    its steps, not its time; `limit_s` of wall time is for one that hangs. SkillFailure, raised by it, fails the skill.
    `name` is what messages call it, such as "the search for a path".
    """

    function: Callable[..., object]
    arguments: tuple[object, ...] = ()
    limit_s: float = LIMIT_S
    name: str = ""

    def __str__(self) -> str:
        return self.name or str(getattr(self.function, "__name__", self.function))


Computing: TypeAlias = Generator[Computation | None, Any, None]
"""Yields computations, and is sent their results; after a None it goes on in the next tick."""
