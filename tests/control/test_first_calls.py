"""Functions are compiled when they are first called, for the types that they are annotated with, and for no others."""

from __future__ import annotations

from threading import Thread

import numpy as np
import pytest

from skillc_runtime.motion.arrays import OutVector
from skillc_runtime.motion.numerics.compiled import COMPILES, compiled

pytestmark = pytest.mark.skipif(not COMPILES, reason="needs numba")


def double(out: OutVector, factor: float) -> None:
    out[0] = factor * out[0]


def twice(out: OutVector, factor: float) -> None:
    inner(out, factor)
    inner(out, factor)


inner, outer = compiled(double), compiled(twice)


def test_the_first_call_compiles_whichever_thread_comes_first() -> None:
    assert inner.code is outer.code is None
    value = np.ones(1)
    threads = [Thread(target=outer, args=(value, 3)) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    inner(value, 2)
    assert value == [162.0]
    assert inner.code is not None and outer.code is not None
    for wrong in (np.ones((1, 1)), np.ones(1, np.float32), np.ones(4)[::2], [1.0]):
        with pytest.raises(TypeError, match="not an array as it is annotated"):
            outer(wrong, 3.0)
    with pytest.raises(TypeError, match="must be real number"):
        outer(value, "3")
    with pytest.raises(TypeError, match="wrong number of arguments"):
        outer(value)
