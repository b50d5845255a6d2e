"""Reads data sheets of devices and single numbers and texts from the facts of a world."""

from __future__ import annotations

from pathlib import Path

import msgspec

from skillc_ontology.catalogue import model_path
from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.terms import (
    HAS_POSTURE,
    HAS_SHEET,
    JOINT_VALUES,
    POSTURE_NAME,
    SKILLC,
    TO_BE_STATED,
)
from skillc_runtime.world.state.world_state import WorldState


class SheetError(ValueError):
    """A fact about a device is missing or cannot be read; the message names both."""


class DataSheet(msgspec.Struct, frozen=True):
    """A data sheet in one version of the world; properties are called by their `skillc` names without prefix."""

    state: WorldState
    individual: str

    def number(self, name: str) -> float:
        """Return a number in SI units; SheetError when missing."""
        return number_of(self.state, self.individual, SKILLC + name)

    def text(self, name: str) -> str:
        """Return a text; SheetError when missing."""
        return text_of(self.state, self.individual, SKILLC + name)

    @property
    def model(self) -> Path:
        """The device's MJCF file; SheetError when it is not stated or does not exist."""
        try:
            return model_path(self.text("model"))
        except FileNotFoundError as error:
            raise SheetError(f"{self._short(self.individual)}: {error}") from error

    def numbers(self, name: str) -> Array:
        """Return the numbers (n,) of a text in SI units, separated by spaces; SheetError when missing or invalid."""
        return _numbers(self.text(name), f"skillc:{name} of {self._short(self.individual)}")

    def limits(self, name: str, count: int) -> Array:
        """Return numbers (count,) in SI units above 0, one for each joint; SheetError when missing or not like that."""
        found = self.numbers(name)
        if found.size != count or not (found > 0).all():
            what = f"skillc:{name} of {self._short(self.individual)}"
            raise SheetError(f"{what} must be {count} numbers above 0, one for each joint: {self.text(name)!r}")
        return found

    def has(self, name: str) -> bool:
        """Whether the sheet states a property."""
        return self.state.value(self.individual, SKILLC + name) is not None

    @property
    def unstated(self) -> tuple[str, ...]:
        """The properties that the sheet says are still to be stated."""
        return tuple(str(self.state.value(self.individual, TO_BE_STATED) or "").split())

    def require_complete(self) -> None:
        """Raise SheetError if properties are still to be stated."""
        if self.unstated:
            names = ", ".join(f"skillc:{name}" for name in self.unstated)
            raise SheetError(
                f"{self._short(self.individual)} is not complete: {names} are still to be stated; write them, and "
                f"remove them from {self._short(TO_BE_STATED)}"
            )

    def posture(self, name: str) -> Array:
        """Return the joint values (nv,) rad of a named posture; SheetError lists the existing names."""
        names = self._named_postures()
        if name not in names:
            known = ", ".join(self.posture_names) or "none"
            raise SheetError(f"{self._short(self.individual)} has no posture {name!r}; it has {known}")
        values = text_of(self.state, names[name], JOINT_VALUES)
        return _numbers(values, f"posture {name} of {self._short(self.individual)}")

    @property
    def postures(self) -> tuple[str, ...]:
        """The individuals that describe postures."""
        return tuple(sorted(self.state.objects(self.individual, HAS_POSTURE)))

    @property
    def posture_names(self) -> tuple[str, ...]:
        """The names of the postures, sorted."""
        return tuple(sorted(self._named_postures()))

    def _named_postures(self) -> dict[str, str]:
        return {str(self.state.value(each, POSTURE_NAME)): each for each in self.postures}

    def _short(self, individual: str) -> str:
        return self.state.vocabulary.short(individual)


def sheet_of(state: WorldState, individual: str) -> DataSheet:
    """Return the data sheet of a device; SheetError when it has none."""
    sheets = sorted(state.objects(individual, HAS_SHEET))
    if not sheets:
        raise SheetError(f"{state.vocabulary.short(individual)} has no data sheet (skillc:hasSheet)")
    return DataSheet(state, sheets[0])


def number_of(state: WorldState, individual: str, property_: str, default: float | None = None) -> float:
    """Return a number in SI units of an individual; SheetError when missing and no default is given."""
    found = state.value(individual, property_)
    if isinstance(found, int | float):
        return float(found)
    if found is None and default is not None:
        return default
    short = state.vocabulary.short
    raise SheetError(f"{short(individual)} has no number {short(property_)} in the world model")


def range_below(state: WorldState, individual: str, property_: str, middle: float) -> float:
    """Return the range of a number around its middle in SI units, by default 0; SheetError if it includes 0 or less."""
    found = number_of(state, individual, property_, default=0.0)
    if found >= middle:
        short = state.vocabulary.short
        raise SheetError(f"{short(individual)} has a {short(property_)} of {found:g}; it must be below {middle:g}")
    return found


def text_of(state: WorldState, individual: str, property_: str) -> str:
    """Return a text about an individual; SheetError when missing."""
    found = state.value(individual, property_)
    if isinstance(found, str):
        return found
    short = state.vocabulary.short
    raise SheetError(f"{short(individual)} has no {short(property_)} in the world model")


def triple_of(state: WorldState, individual: str, name: str) -> tuple[float, float, float] | None:
    """Return the three numbers of a text, None if there is none; SheetError if it is anything else."""
    text = state.value(individual, name)
    if text is None:
        return None
    try:
        x, y, z = map(float, str(text).split())
    except ValueError as error:
        short = state.vocabulary.short
        raise SheetError(
            f"{short(individual)} has the {short(name)} {text!r}; it is three numbers separated by spaces"
        ) from error
    return x, y, z


def _numbers(text: str, what: str) -> Array:
    try:
        return np.array([float(part) for part in text.split()])
    except ValueError as error:
        raise SheetError(f"{what} is not numbers separated by spaces: {text!r}") from error
