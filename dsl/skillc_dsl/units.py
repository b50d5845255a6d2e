"""Units and dimensions: the dimension of a quantity, and its value in SI units."""

from __future__ import annotations

import difflib
import math
from decimal import Decimal
from types import MappingProxyType

import msgspec


class Dimension(msgspec.Struct, frozen=True):
    """A dimension, as exponents of length, mass, time and angle."""

    length: int = 0
    mass: int = 0
    time: int = 0
    angle: int = 0

    def __mul__(self, other: Dimension) -> Dimension:
        """Return the dimension of a product."""
        return Dimension(
            self.length + other.length, self.mass + other.mass, self.time + other.time, self.angle + other.angle
        )

    def __truediv__(self, other: Dimension) -> Dimension:
        """Return the dimension of a quotient."""
        return Dimension(
            self.length - other.length, self.mass - other.mass, self.time - other.time, self.angle - other.angle
        )

    @property
    def name(self) -> str:
        """The language's name for this dimension, such as `Force`; a formula such as `m^2 s^-1` if it has none."""
        return _NAMES.get(self) or self._formula()

    def _formula(self) -> str:
        bases = (("m", self.length), ("kg", self.mass), ("s", self.time), ("rad", self.angle))
        return " ".join(base if power == 1 else f"{base}^{power}" for base, power in bases if power)


NUMBER = Dimension()
LENGTH = Dimension(length=1)
MASS = Dimension(mass=1)
TIME = Dimension(time=1)
ANGLE = Dimension(angle=1)
AREA = LENGTH * LENGTH
FREQUENCY = NUMBER / TIME
SPEED = LENGTH / TIME
ANGULAR_SPEED = ANGLE / TIME
ACCELERATION = SPEED / TIME
FORCE = MASS * ACCELERATION
TORQUE = FORCE * LENGTH
STIFFNESS = FORCE / LENGTH
ROTATIONAL_STIFFNESS = TORQUE / ANGLE

DIMENSIONS = MappingProxyType(
    {
        "Number": NUMBER,
        "Length": LENGTH,
        "Area": AREA,
        "Angle": ANGLE,
        "Time": TIME,
        "Frequency": FREQUENCY,
        "Speed": SPEED,
        "AngularSpeed": ANGULAR_SPEED,
        "Acceleration": ACCELERATION,
        "Mass": MASS,
        "Force": FORCE,
        "Torque": TORQUE,
        "Stiffness": STIFFNESS,
        "RotationalStiffness": ROTATIONAL_STIFFNESS,
    }
)
_NAMES = MappingProxyType({dimension: name for name, dimension in DIMENSIONS.items()})


class Unit(msgspec.Struct, frozen=True):
    """A unit: its dimension, and its value in SI units."""

    dimension: Dimension
    in_si: float


UNITS = MappingProxyType(
    {
        "m": Unit(LENGTH, 1.0),
        "cm": Unit(LENGTH, 1e-2),
        "mm": Unit(LENGTH, 1e-3),
        "m2": Unit(AREA, 1.0),
        "cm2": Unit(AREA, 1e-4),
        "mm2": Unit(AREA, 1e-6),
        "s": Unit(TIME, 1.0),
        "ms": Unit(TIME, 1e-3),
        "min": Unit(TIME, 60.0),
        "Hz": Unit(FREQUENCY, 1.0),
        "kHz": Unit(FREQUENCY, 1e3),
        "rad": Unit(ANGLE, 1.0),
        "deg": Unit(ANGLE, math.pi / 180.0),
        "m/s": Unit(SPEED, 1.0),
        "cm/s": Unit(SPEED, 1e-2),
        "mm/s": Unit(SPEED, 1e-3),
        "rad/s": Unit(ANGULAR_SPEED, 1.0),
        "deg/s": Unit(ANGULAR_SPEED, math.pi / 180.0),
        "m/s2": Unit(ACCELERATION, 1.0),
        "kg": Unit(MASS, 1.0),
        "g": Unit(MASS, 1e-3),
        "N": Unit(FORCE, 1.0),
        "Nm": Unit(TORQUE, 1.0),
        "N/m": Unit(STIFFNESS, 1.0),
        "Nm/rad": Unit(ROTATIONAL_STIFFNESS, 1.0),
    }
)

_SPELLINGS = MappingProxyType(
    {
        "newton": "N", "newtons": "N", "n": "N", "kn": "N", "nm": "Nm",
        "meter": "m", "metre": "m", "meters": "m", "metres": "m", "millimeter": "mm", "centimeter": "cm",
        "sec": "s", "secs": "s", "second": "s", "seconds": "s", "minute": "min", "minutes": "min", "h": "min",
        "degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad", "hertz": "Hz", "hz": "Hz",
        "kilogram": "kg", "kilograms": "kg", "gram": "g", "grams": "g",
        "km/h": "m/s", "mps": "m/s", "rpm": "rad/s", "m²": "m2", "cm²": "cm2", "m/s²": "m/s2", "n/mm": "N/m",
    }
)  # fmt: skip


def to_si(value: float, unit: str) -> float:
    """Return `value` in the SI unit of its dimension, rounded once: 9 mm is the same number as 0.009 m.

    Raises KeyError for a unit that is not in UNITS.
    """
    return float(Decimal(repr(value)) * Decimal(repr(UNITS[unit].in_si)))


def dimension_of(unit: str) -> Dimension:
    """Return the dimension of `unit`. Raises KeyError for a unit that is not in UNITS."""
    return UNITS[unit].dimension


def suggest_units(wrong: str) -> tuple[str, ...]:
    """Return the units an author may have meant by `wrong`, the most likely first; empty if none is close."""
    meant = _SPELLINGS.get(wrong.lower())
    alike = difflib.get_close_matches(wrong, list(UNITS), n=3, cutoff=0.5)
    return tuple(dict.fromkeys((meant, *alike))) if meant else tuple(alike)
