"""Units and dimensions: the dimension of a quantity, and its value in SI units."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Iterable
from decimal import Decimal
from types import MappingProxyType

import msgspec


class Dimension(msgspec.Struct, frozen=True):
    """A dimension, as exponents of length, mass, time, angle, electric current and temperature.

    `kind` tells apart what has the same exponents: a torque from an energy, a temperature from a difference of two.
    """

    length: int = 0
    mass: int = 0
    time: int = 0
    angle: int = 0
    current: int = 0
    temperature: int = 0
    kind: str = ""

    def __mul__(self, other: Dimension) -> Dimension:
        """Return the dimension of a product; a multiple is of the same kind."""
        return self._combine(other, 1) if self != NUMBER else other

    def __truediv__(self, other: Dimension) -> Dimension:
        """Return the dimension of a quotient; a part is of the same kind."""
        return self._combine(other, -1)

    def _combine(self, other: Dimension, sign: int) -> Dimension:
        if other == NUMBER:
            return self
        names = self.__struct_fields__[:-1]
        return Dimension(**{name: getattr(self, name) + sign * getattr(other, name) for name in names})

    def join(self, other: Dimension) -> Dimension | None:
        """Return the dimension that both are, None if they differ. A force times a length is a torque or an energy."""
        if self == FORCE * LENGTH and other in (TORQUE, ENERGY):
            return other
        if self == other or (other == FORCE * LENGTH and self in (TORQUE, ENERGY)):
            return self
        return None

    @property
    def name(self) -> str:
        """The language's name for this dimension, such as `Force`; a formula such as `m^2 s^-1` if it has none."""
        return _NAMES.get(self) or self._formula()

    def _formula(self) -> str:
        powers = (self.length, self.mass, self.time, self.angle, self.current, self.temperature)
        bases = zip(("m", "kg", "s", "rad", "A", "K"), powers, strict=True)
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
TORQUE = msgspec.structs.replace(FORCE * LENGTH, kind="torque")
STIFFNESS = FORCE / LENGTH
ROTATIONAL_STIFFNESS = TORQUE / ANGLE
ENERGY = msgspec.structs.replace(FORCE * LENGTH, kind="energy")
POWER = ENERGY / TIME
CURRENT = Dimension(current=1)
VOLTAGE = POWER / CURRENT
VOLUME = AREA * LENGTH
FLOW = VOLUME / TIME
PRESSURE = FORCE / AREA
TEMPERATURE = Dimension(temperature=1, kind="absolute")
TEMPERATURE_DIFFERENCE = Dimension(temperature=1)

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
        "Energy": ENERGY,
        "Power": POWER,
        "Current": CURRENT,
        "Voltage": VOLTAGE,
        "Volume": VOLUME,
        "Flow": FLOW,
        "Pressure": PRESSURE,
        "Temperature": TEMPERATURE,
        "TemperatureDifference": TEMPERATURE_DIFFERENCE,
    }
)
LATER_DIMENSIONS = frozenset(list(DIMENSIONS)[list(DIMENSIONS).index("Energy") :])
"""The names that came with edition 2. A class of such a name, where there is one, is what the name means."""

_NAMES = MappingProxyType(
    {**{dimension: name for name, dimension in DIMENSIONS.items()}, FORCE * LENGTH: "Torque or Energy"}
)


def sum_dimension(operator: str, one: Dimension, other: Dimension) -> Dimension | None:
    """Return the dimension of `one + other` or `one - other`, None if there is no such sum.

    Two temperatures have a difference and no sum; a temperature and a difference give a temperature.
    """
    match operator, one == TEMPERATURE, other == TEMPERATURE:
        case "-", True, True:
            return TEMPERATURE_DIFFERENCE
        case ("+" | "-", True, False) if other == TEMPERATURE_DIFFERENCE:
            return TEMPERATURE
        case ("+", False, True) if one == TEMPERATURE_DIFFERENCE:
            return TEMPERATURE
        case _, False, False:
            return one.join(other)
        case _:
            return None


class Unit(msgspec.Struct, frozen=True):
    """A unit: its dimension, and in SI units its value and that of its zero."""

    dimension: Dimension
    in_si: float
    zero: float = 0.0


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
        "h": Unit(TIME, 3600.0),
        "Hz": Unit(FREQUENCY, 1.0),
        "kHz": Unit(FREQUENCY, 1e3),
        "rad": Unit(ANGLE, 1.0),
        "deg": Unit(ANGLE, math.pi / 180.0),
        "m/s": Unit(SPEED, 1.0),
        "cm/s": Unit(SPEED, 1e-2),
        "mm/s": Unit(SPEED, 1e-3),
        "rad/s": Unit(ANGULAR_SPEED, 1.0),
        "deg/s": Unit(ANGULAR_SPEED, math.pi / 180.0),
        "rpm": Unit(ANGULAR_SPEED, math.pi / 30.0),
        "m/s2": Unit(ACCELERATION, 1.0),
        "kg": Unit(MASS, 1.0),
        "g": Unit(MASS, 1e-3),
        "N": Unit(FORCE, 1.0),
        "Nm": Unit(TORQUE, 1.0),
        "N/m": Unit(STIFFNESS, 1.0),
        "Nm/rad": Unit(ROTATIONAL_STIFFNESS, 1.0),
        "J": Unit(ENERGY, 1.0),
        "kJ": Unit(ENERGY, 1e3),
        "Wh": Unit(ENERGY, 3600.0),
        "kWh": Unit(ENERGY, 3.6e6),
        "W": Unit(POWER, 1.0),
        "kW": Unit(POWER, 1e3),
        "A": Unit(CURRENT, 1.0),
        "mA": Unit(CURRENT, 1e-3),
        "V": Unit(VOLTAGE, 1.0),
        "mV": Unit(VOLTAGE, 1e-3),
        "m3": Unit(VOLUME, 1.0),
        "l": Unit(VOLUME, 1e-3),
        "ml": Unit(VOLUME, 1e-6),
        "m3/s": Unit(FLOW, 1.0),
        "l/min": Unit(FLOW, 1e-3 / 60.0),
        "Pa": Unit(PRESSURE, 1.0),
        "kPa": Unit(PRESSURE, 1e3),
        "mbar": Unit(PRESSURE, 1e2),
        "bar": Unit(PRESSURE, 1e5),
        "%": Unit(NUMBER, 0.01),
        "degC": Unit(TEMPERATURE, 1.0, 273.15),
        "K": Unit(TEMPERATURE_DIFFERENCE, 1.0),
    }
)

_QUANTITY = re.compile(
    r"(?<![\w.])(?P<number>\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)[ \t]*"
    rf"(?P<unit>{'|'.join(map(re.escape, sorted(UNITS, key=len, reverse=True)))})(?![\w/])"
)

_SPELLINGS = MappingProxyType(
    {
        "newton": "N", "newtons": "N", "n": "N", "kn": "N", "nm": "Nm",
        "meter": "m", "metre": "m", "meters": "m", "metres": "m", "millimeter": "mm", "centimeter": "cm",
        "sec": "s", "secs": "s", "second": "s", "seconds": "s", "minute": "min", "minutes": "min",
        "degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad", "hertz": "Hz", "hz": "Hz",
        "kilogram": "kg", "kilograms": "kg", "gram": "g", "grams": "g",
        "km/h": "m/s", "mps": "m/s", "m²": "m2", "cm²": "cm2", "m/s²": "m/s2", "n/mm": "N/m",
        "joule": "J", "joules": "J", "watt": "W", "watts": "W", "ampere": "A", "amperes": "A", "amp": "A", "amps": "A",
        "volt": "V", "volts": "V", "liter": "l", "litre": "l", "liters": "l", "litres": "l", "m³": "m3", "dm3": "l",
        "pascal": "Pa", "hpa": "mbar", "mpa": "bar", "c": "degC", "celsius": "degC", "kelvin": "K",
    }
)  # fmt: skip


def to_si(value: float, unit: str) -> float:
    """Return `value` in the SI unit of its dimension, rounded once: 9 mm is the same number as 0.009 m.

    Raises KeyError for a unit that is not in UNITS.
    """
    about = UNITS[unit]
    return float(Decimal(repr(value)) * Decimal(repr(about.in_si)) + Decimal(repr(about.zero)))


def from_si(value: float, unit: str) -> float:
    """Return a value in SI units in `unit`, to 12 digits. Raises KeyError for a unit that is not in UNITS."""
    about = UNITS[unit]
    return float(f"{(Decimal(repr(value)) - Decimal(repr(about.zero))) / Decimal(repr(about.in_si)):.12g}")


def in_units_of(text: str, written: Iterable[str]) -> str:
    """Return a text with its quantities in the units that other texts have for the same dimension, if any.

    Of several, the first one is taken.
    """
    units: dict[Dimension, str] = {}
    for each in _QUANTITY.finditer(" ".join(written)):
        units.setdefault(dimension_of(each["unit"]), each["unit"])

    def convert(found: re.Match[str]) -> str:
        unit = units.get(dimension_of(found["unit"]), found["unit"])
        return f"{from_si(to_si(float(found['number']), found['unit']), unit):.12g} {unit}"

    return _QUANTITY.sub(convert, text)


def dimension_of(unit: str) -> Dimension:
    """Return the dimension of `unit`. Raises KeyError for a unit that is not in UNITS."""
    return UNITS[unit].dimension


def suggest_units(wrong: str) -> tuple[str, ...]:
    """Return the units an author may have meant by `wrong`, the most likely first; empty if none is close."""
    meant = _SPELLINGS.get(wrong.lower())
    alike = difflib.get_close_matches(wrong, list(UNITS), n=3, cutoff=0.5)
    return tuple(dict.fromkeys((meant, *alike))) if meant else tuple(alike)
