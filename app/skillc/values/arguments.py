"""Reads what Python programs pass; RequestError for a value that cannot be meant."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeAlias, TypeVar, get_args

from skillc.errors import RequestError
from skillc_runtime.execution.pace import parse_pace

AnyPath: TypeAlias = str | os.PathLike[str]
T = TypeVar("T")


def require_path(value: object, what: str) -> Path:
    """Return a path; RequestError for anything but a text or a path."""
    if isinstance(value, str | os.PathLike):
        path = os.fspath(value)
        if isinstance(path, str) and path and "\0" not in path:
            return Path(path)
    raise wrong_type(value, what, "a path, as a text or as a pathlib.Path")


def optional_path(value: object, what: str) -> Path | None:
    """Return a path or None; RequestError for anything else."""
    return None if value is None else require_path(value, what)


def require_text(value: object, what: str) -> str:
    """Return a text that is not empty; RequestError for anything else."""
    if isinstance(value, str) and value.strip():
        return value
    raise wrong_type(value, what, "a text")


def optional_text(value: object, what: str) -> str | None:
    """Return a text or None; RequestError for anything else."""
    return None if value is None else require_text(value, what)


def read_arguments(value: object) -> dict[str, str]:
    """Return the values of a task's parameters by name, as texts; RequestError for anything but a mapping of such."""
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise wrong_type(value, "`arguments`", "a mapping of names to values")
    return {
        require_text(name, "the name of an argument"): require_text(
            str(each) if isinstance(each, int | float) and not isinstance(each, bool) else each, f"`{name}`"
        )
        for name, each in value.items()
    }


def read_pace(pace: float | str) -> float:
    """Return the factor that `fast`, `real` or a positive number means. RequestError for anything else."""
    try:
        return parse_pace(pace)
    except ValueError as error:
        raise RequestError(str(error)) from error


def require_choice(value: T, choices: object, what: str) -> T:
    """Return a value that is one of a Literal's; RequestError lists them otherwise."""
    return require_one_of(value, get_args(choices), what)


def require_one_of(value: T, known: Sequence[object], what: str) -> T:
    """Return a value that is one of those known; RequestError lists them otherwise."""
    if value not in known:
        raise wrong_type(value, what, " or ".join(f'"{each}"' for each in known))
    return value


def require_flag(value: object, what: str) -> bool:
    """Return True or False; RequestError for anything else."""
    if isinstance(value, bool):
        return value
    raise wrong_type(value, what, "True or False")


def require_count(value: object, what: str, least: int | None, most: int | None = None) -> int:
    """Return a whole number within limits; RequestError for anything else."""
    if isinstance(value, int) and not isinstance(value, bool):
        low, high = value if least is None else least, value if most is None else most
        if low <= value <= high:
            return value
    limits = [f"at {word} {limit}" for word, limit in (("least", least), ("most", most)) if limit is not None]
    raise wrong_type(value, what, f"a whole number of {' and '.join(limits)}")


def optional_seconds(value: object, what: str) -> float | None:
    """Return a positive duration in s, or None; RequestError for anything else."""
    if value is None:
        return None
    if isinstance(value, int | float) and not isinstance(value, bool) and value > 0:
        return float(value)
    raise wrong_type(value, what, "a positive number of seconds")


def wrong_type(value: object, what: str, wanted: str) -> RequestError:
    """Return the error about a value that is not what is wanted."""
    shown = repr(value) if isinstance(value, str | int | float | bytes) or value is None else type(value).__name__
    return RequestError(f"{what} must be {wanted}, not {shown[:80]}")
