"""The numbers of the columns with their units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from columns.meaning import Constant


@dataclass(frozen=True)
class Amount(Constant):
    """A number in the base unit, written with another one."""

    written: str

    @property
    def text(self) -> str:
        return self.written


@dataclass(frozen=True)
class Numbers:
    """What a property is compared with and set to, and by what it changes."""

    values: tuple[Constant, ...]
    steps: tuple[Constant, ...]


def _amounts(**written: float) -> tuple[Constant, ...]:
    return tuple(Amount(value, text) for text, value in written.items())


STEPS: Mapping[str, Numbers] = {
    "level": Numbers(tuple(map(Constant, range(4))), (Constant(1), Constant(2))),
    "fill": Numbers(
        _amounts(**{"0 %": 0.0, "25 %": 0.25, "0.5": 0.5, "100 %": 1.0}), _amounts(**{"25 %": 0.25, "0.5": 0.5})
    ),
    "weight": Numbers(
        _amounts(**{"0 g": 0.0, "250 g": 0.25, "0.5 kg": 0.5, "2 kg": 2.0}), _amounts(**{"250 g": 0.25, "0.5 kg": 0.5})
    ),
    "heat": Numbers(
        _amounts(**{"15 degC": 288.15, "20 degC": 293.15, "298.15 K": 298.15}), _amounts(**{"5 K": 5.0, "10 K": 10.0})
    ),
}
UNITS = {"weight": "kg", "heat": "K"}


def exactly(name: str, value: object) -> Constant:
    """Return a value of a property in its base unit."""
    return Amount(value, f"{value} {UNITS[name]}") if name in UNITS else Constant(value)
