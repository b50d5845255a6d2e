"""Dataclasses are the same whether the code of their methods was kept or is compiled."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import pytest

from skillc_dsl import importing
from skillc_dsl.cache import load
from skillc_dsl.importing import keeping_code

VARIABLE = "SKILLC_CACHE"


def make_point() -> Any:
    """Return a new class, made while code is kept."""
    with keeping_code("test"):

        @dataclasses.dataclass(frozen=True, slots=True, order=True)
        class Point:
            x: float
            y: float = 2.0

    return Point


def refuse(*_: object, **__: object) -> None:
    raise AssertionError("it is compiled")


def test_what_was_compiled_once_is_not_compiled_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    first = make_point()
    monkeypatch.setattr(importing, "compile", refuse, raising=False)
    again = make_point()
    assert not hasattr(dataclasses, "exec"), "others compile as ever"
    for point in (first, again):
        assert repr(point(1.0)).endswith("Point(x=1.0, y=2.0)")
        assert point(1.0) == point(1.0, 2.0) != point(2.0) and point(1.0) < point(2.0)
        assert hash(point(1.0)) == hash(point(1.0))
        with pytest.raises(dataclasses.FrozenInstanceError):
            point(1.0).x = 3.0


def test_what_is_damaged_or_cannot_be_stored_is_compiled_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    make_point()
    (kept,) = (tmp_path / "dataclasses").iterdir()
    kept.write_bytes(kept.read_bytes()[:-1])
    assert load(kept) is None
    assert make_point()(1.0).y == 2.0 and load(kept) is not None
    monkeypatch.setenv(VARIABLE, str(kept))
    assert make_point()(1.0).y == 2.0
