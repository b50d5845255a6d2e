"""A function on memory is called through its address as from Python, also by other machine code."""

from __future__ import annotations

from ctypes import CFUNCTYPE, c_bool, c_double, c_int64
from dataclasses import dataclass, replace

import numpy as np
import pytest

from skillc_runtime.motion.arrays import Integers, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import COMPILES, bind, compiled
from skillc_runtime.motion.numerics.places import call_entry

pytestmark = pytest.mark.skipif(not COMPILES, reason="needs numba")


@dataclass(frozen=True)
class Sums:
    total: OutVector
    table: OutMatrix
    factor: float
    counts: Integers


@compiled
def add(memory: Sums, value: float, twice: bool) -> int:
    memory.total[0] += memory.factor * value * (2.0 if twice else 1.0)
    memory.table[1, 2] = memory.total[0]
    memory.counts[0, 1] += 1
    return memory.total.size + memory.table.shape[1]


@compiled
def clear(memory: Sums) -> None:
    memory.total[0] = 0.0


@compiled
def add_vector(memory: Sums, values: Vector) -> int:
    return values.size


@compiled
def add_often(address: int, memory: int, count: int) -> int:
    found = 0
    for number in range(count):
        found = call_entry(address, memory, float(number), number % 2 == 1)
    return found


def test_machine_code_is_called_through_its_address() -> None:
    memory = Sums(np.zeros(1), np.zeros((2, 3)), 0.5, np.zeros((1, 2), np.int64))
    bound, cleared = bind(add, memory), bind(clear, memory)
    assert bound.entry is not None and cleared.entry is not None
    address, table = bound.entry
    in_c = CFUNCTYPE(c_int64, c_int64, c_double, c_bool)(address)
    assert bound(4.0, False) == in_c(table, 4.0, False) == 4
    assert memory.total == [4.0]
    assert in_c(table, 1.0, True) == 4 and memory.table[1, 2] == 5.0
    assert CFUNCTYPE(c_int64, c_int64)(cleared.entry[0])(cleared.entry[1]) == 0
    assert memory.total == [0.0]
    assert add_often(address, table, 5) == 4
    assert memory.total == [0.5 * (0 + 2 + 2 + 6 + 4)]
    assert memory.counts.tolist() == [[0, 3 + 5]]
    assert bind(add_vector, memory).entry is None
    for wrong in (replace(memory, counts=np.zeros((1, 2))), replace(memory, total=np.zeros(1, np.float32))):
        with pytest.raises(TypeError, match="has elements of the type"):
            bind(add, wrong)
    with pytest.raises(ValueError, match="not in C order"):
        bind(add, replace(memory, table=np.zeros((3, 2)).T))
    with pytest.raises(TypeError, match="add: not an array"):
        add(replace(memory, table=np.zeros((3, 2)).T), 1.0, False)
