"""A reader in another process gets whole versions only; missed cycles are counted."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from skillc_runtime.backends.control_process.periods.pacing import CycleClock
from skillc_runtime.backends.control_process.shared_memory import SharedRecord, SharedRing, make_memory, map_memory

WRITER = """
import sys
from itertools import count
import numpy as np
from skillc_runtime.backends.control_process.shared_memory import SharedRecord, map_memory
record = SharedRecord(map_memory(int(sys.argv[1])))
for number in count(1):
    record.write(np.full(300, float(number)))
"""


@pytest.mark.slow
def test_a_record_is_whole_whenever_it_is_read() -> None:
    file = make_memory(301)
    with subprocess.Popen([sys.executable, "-c", WRITER, str(file)], pass_fds=[file]) as writer:
        record, seen = SharedRecord(map_memory(file)), set[float]()
        while len(seen) < 1000:
            assert writer.poll() is None
            copy = record.read()
            assert np.ptp(copy) == 0.0
            seen.add(copy[0])
        writer.kill()
    assert np.ptp(record.read()) == 0.0


def test_a_record_left_half_written_is_the_last_whole_one() -> None:
    memory = np.zeros(4)
    record = SharedRecord(memory)
    record.write(np.ones(3))
    assert record.read().tolist() == [1.0, 1.0, 1.0]
    memory[0] += 1.0
    memory[1] = 9.0
    assert record.read().tolist() == [1.0, 1.0, 1.0]


def test_a_ring_gives_each_row_once_and_leaves_old_ones_out() -> None:
    ring = SharedRing(np.zeros(1 + 10 * 2), 2)
    for number in range(3):
        ring.write(np.full(2, float(number)))
    assert ring.take()[:, 0].tolist() == [0.0, 1.0, 2.0]
    assert len(ring.take()) == 0
    for number in range(100):
        ring.write(np.full(2, float(number)))
    assert ring.take()[:, 0].tolist() == [95.0, 96.0, 97.0, 98.0, 99.0]


@pytest.mark.parametrize(
    ("stamps", "seen", "lost", "now"),
    [
        ([0.0, 0.001, 0.002], [0.0, 0.001, 0.002], 0, 0.002),
        ([0.0, 0.001, 0.004], [0.0, 0.001, 0.002], 2, 0.004),
        ([0.0, 0.001, 0.001], [0.0, 0.001, 0.002], 1, 0.002),
        ([0.0, 0.0, 0.0], [0.0, 0.003, 0.004], 4, 0.004),
    ],
)
def test_lost_cycles_are_counted_by_the_clock_of_the_device(
    stamps: list[float], seen: list[float], lost: int, now: float
) -> None:
    clock = CycleClock(0.001)
    for stamp_s, seen_s in zip(stamps, seen, strict=True):
        clock.advance(stamp_s, seen_s)
    assert clock.lost == lost
    assert clock.now_s == pytest.approx(now)
