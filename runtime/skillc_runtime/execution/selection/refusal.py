"""What is refused before anything moves, with its place and the origins of its values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

import msgspec

from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import Expression, Variable
from skillc_model.skills import Implementation
from skillc_runtime.execution.selection.text_names import UnknownTextName
from skillc_runtime.recording.failure import Rejection

Origin: TypeAlias = tuple[Position, str]
"""Where a value comes from: the call and name of an argument, or an implementation and its parameter or `let`."""


class Refusal(msgspec.Struct, frozen=True):
    """A call or another node that can never run; `within` are the enclosing implementations, outermost first.

    `unknown_names` are the texts, by origin, for which implementations were rejected that could run otherwise.
    """

    skill: str
    message: str
    source: Position
    within: tuple[str, ...] = ()
    rejected: tuple[Rejection, ...] = ()
    unknown_names: Mapping[Origin, UnknownTextName] = msgspec.field(default_factory=dict)

    def __str__(self) -> str:
        within = f" (in {' > '.join(self.within)})" if self.within else ""
        return f"{self.source}: {self.message}{within}"


def join_refusals(each: Iterable[tuple[Refusal, ...]]) -> tuple[Refusal, ...]:
    """Return the refusals of several parts of a body, one after the other."""
    return tuple(refusal for refusals in each for refusal in refusals)


def track_origins(call: tree.Call, implementation: Implementation, around: Mapping[str, Origin]) -> dict[str, Origin]:
    """Return the origin of the value of each parameter; `around` are those of the names at the call."""
    origins: dict[str, Origin] = {each.name: (implementation.source, each.name) for each in implementation.parameters}
    for name, argument in call.arguments.items():
        origins |= track_origin(name, argument, (call.source, name), around)
    return origins


def track_origin(name: str, value: Expression, here: Origin, origins: Mapping[str, Origin]) -> dict[str, Origin]:
    """Return the origin of a named value: `here`, or the origin of the variable that it is."""
    return {name: origins.get(value.name, here) if isinstance(value, Variable) else here}
