"""Machine code is stored once and loaded without numba; what is damaged, or cannot be stored, is compiled again."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from skillc_runtime.motion.numerics import code_key
from skillc_runtime.motion.numerics.code_key import CALLABLE, key_of
from skillc_runtime.motion.numerics.compiled import COMPILES

pytestmark = pytest.mark.skipif(not COMPILES, reason="needs numba")

PROGRAM = """
import os
import sys
import numpy as np
from skillc_runtime.control.filters import step_lag
from skillc_runtime.control.momentum_observer import find_unexplained_torque
from skillc_runtime.motion.paths.profile import trapezoid_at

value = np.zeros(2)
if hasattr(os, "fork"):
    if not (child := os.fork()):
        step_lag(value, np.ones(2), 0.5, 1e-9)
        os._exit(0)
    os.waitpid(child, 0)
print(step_lag(value, np.ones(2), 0.5, 1e-9), value, trapezoid_at(1.0, 1.0, 2.0, 2.0, 1.0, 0.25))
print(find_unexplained_torque(np.arange(7.0), np.eye(6, 7)))
for wrong in ((value, value, 0.5), (value, np.ones(2, np.float32), 0.5, 0.0), (value, [1.0, 2.0], 0.5, 0.0)):
    try:
        step_lag(*wrong)
    except TypeError as error:
        print(error)
print("numba" in sys.modules, file=sys.stderr)
"""


def run(cache: Path) -> tuple[str, bool]:
    """What the program prints, and whether something was compiled, which it and its fork say once."""
    environment = {**os.environ, "SKILLC_CACHE": str(cache)}
    ran = subprocess.run([sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    compiled = ran.stderr.endswith("True\n")
    assert ran.stderr.count("compiling the control laws") == compiled
    return ran.stdout, compiled


@pytest.mark.slow
def test_stored_code_does_the_same_without_numba(tmp_path: Path) -> None:
    first, compiled = run(tmp_path)
    assert compiled
    assert "False [0.5 0.5] (0.0625, 0.5, 2.0)\n" in first and first.count("not an array as it is annotated") == 2
    stored = sorted((tmp_path / "machine-code").iterdir())
    assert len(stored) == 3
    assert run(tmp_path) == (first, False)
    stored[0].write_bytes(stored[0].read_bytes()[:-1])
    assert run(tmp_path) == (first, True)
    assert run(tmp_path) == (first, False)


@pytest.mark.slow
def test_code_that_cannot_be_stored_is_compiled_again(tmp_path: Path) -> None:
    (tmp_path / "machine-code").write_text("no folder")
    first, again = run(tmp_path), run(tmp_path)
    assert first == again and again[1]


FACTOR = 2.0


def scaled(value: float) -> float:
    return FACTOR * value


def twice(value: float) -> float:
    return scaled(value) + scaled(value)


def test_names_depend_on_all_that_is_called(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(CALLABLE, scaled, None)
    monkeypatch.setitem(CALLABLE, twice, None)
    monkeypatch.setattr(sys.modules[__name__], "FACTOR", 2.0)

    def name(function: Callable[[float], float]) -> str:
        """Return the name in another process, in which nothing was read before."""
        code_key._describe.cache_clear()
        return key_of.__wrapped__(function)

    before, other = name(twice), name(scaled)
    assert before == name(twice) != other
    monkeypatch.setattr(sys.modules[__name__], "FACTOR", 3.0)
    assert name(twice) != before


def test_where_packages_are_installed_changes_no_name(tmp_path: Path) -> None:
    """Else each checkout would compile the control laws again."""

    def made(folder: str) -> Callable[[float], float]:
        module = ModuleType("numbers_of_mine")
        module.__file__ = str(tmp_path / folder / "numbers_of_mine.py")
        names: dict[str, object] = {"numbers_of_mine": module}
        exec("def scaled(x: float) -> float:\n    return numbers_of_mine.FACTOR * x\n", names)
        scaled: Any = names["scaled"]
        scaled.__annotations__ = {"x": float, "return": float}
        return scaled

    one, other = made("one"), made("other")
    assert repr(one.__globals__["numbers_of_mine"]) != repr(other.__globals__["numbers_of_mine"])
    assert key_of(one) == key_of(other)
