"""Units, dimensions, and what they are called."""

import math

import pytest

from skillc_dsl.units import (
    DIMENSIONS,
    LENGTH,
    MASS,
    NUMBER,
    TIME,
    UNITS,
    Dimension,
    dimension_of,
    from_si,
    suggest_units,
    to_si,
)


@pytest.mark.parametrize(
    ("value", "unit", "si", "dimension"),
    [
        (5, "cm", 0.05, "Length"),
        (20, "ms", 0.02, "Time"),
        (2, "min", 120, "Time"),
        (90, "deg", math.pi / 2, "Angle"),
        (180, "deg/s", math.pi, "AngularSpeed"),
        (400, "N/m", 400, "Stiffness"),
        (30, "Nm/rad", 30, "RotationalStiffness"),
        (3, "Nm", 3, "Torque"),
        (250, "g", 0.25, "Mass"),
        (1.5, "Hz", 1.5, "Frequency"),
        (100, "cm2", 0.01, "Area"),
        (50, "mm/s", 0.05, "Speed"),
        (9.81, "m/s2", 9.81, "Acceleration"),
        (8, "N", 8, "Force"),
        (2, "h", 7200, "Time"),
        (2, "Wh", 7200, "Energy"),
        (3, "kW", 3000, "Power"),
        (250, "mA", 0.25, "Current"),
        (24, "V", 24, "Voltage"),
        (5, "ml", 5e-6, "Volume"),
        (6, "l/min", 1e-4, "Flow"),
        (6, "bar", 6e5, "Pressure"),
        (80, "degC", 353.15, "Temperature"),
        (-20, "degC", 253.15, "Temperature"),
        (5, "K", 5, "TemperatureDifference"),
        (30, "rpm", math.pi, "AngularSpeed"),
        (5, "%", 0.05, "Number"),
    ],
)
def test_values_in_si(value: float, unit: str, si: float, dimension: str) -> None:
    assert to_si(value, unit) == pytest.approx(si)
    assert dimension_of(unit).name == dimension
    assert from_si(si, unit) == pytest.approx(value)


@pytest.mark.parametrize(("unit", "per_si"), [("mm", 1000), ("cm", 100), ("ms", 1000), ("g", 1000), ("mm2", 10**6)])
def test_a_quantity_is_the_number_that_it_is_in_si(unit: str, per_si: int) -> None:
    assert [n for n in range(1, 2000) if to_si(float(n), unit) != n / per_si] == []


def test_every_unit_has_a_dimension_with_a_name() -> None:
    assert {unit.dimension for unit in UNITS.values()} == set(DIMENSIONS.values())


def test_products_and_quotients() -> None:
    force = DIMENSIONS["Force"]
    assert force == MASS * LENGTH / (TIME * TIME)
    assert force / DIMENSIONS["Stiffness"] == LENGTH
    assert (force / force).name == "Number"
    assert Dimension() == NUMBER
    assert (LENGTH * LENGTH * LENGTH * MASS / TIME).name == "m^3 kg s^-1"


def test_products_of_electricity_and_of_what_flows() -> None:
    of = DIMENSIONS
    assert of["Voltage"] * of["Current"] == of["Power"] == of["Force"] * of["Speed"]
    assert of["Pressure"] * of["Flow"] == of["Power"]
    assert of["Volume"] / TIME == of["Flow"]


def test_a_force_times_a_length_is_a_torque_or_an_energy_and_these_differ() -> None:
    torque, energy = DIMENSIONS["Torque"], DIMENSIONS["Energy"]
    product = DIMENSIONS["Force"] * LENGTH
    assert (product.join(torque), energy.join(product)) == (torque, energy)
    assert torque.join(energy) is None and torque != energy
    assert (product.name, (energy * NUMBER).name) == ("Torque or Energy", "Energy")
    assert energy / LENGTH == torque / LENGTH == DIMENSIONS["Force"]


def test_a_foreign_unit() -> None:
    with pytest.raises(KeyError):
        to_si(1, "furlong")
    assert suggest_units("newton")[0] == "N"
    assert suggest_units("N/mm")[0] == "N/m"
    assert suggest_units("furlong") == ()
