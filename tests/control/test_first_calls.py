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
    assert inner.signatures == outer.signatures == []
    value = np.ones(1)
    threads = [Thread(target=outer, args=(value, 3)) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    inner(value, 2)
    assert value == [162.0]
    assert inner.signatures == outer.signatures != []
    with pytest.raises(TypeError, match="No matching definition"):
        outer(np.ones((1, 1)), 3.0)
