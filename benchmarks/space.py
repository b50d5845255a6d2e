"""Poses and relations that follow from them, in scenes of ten to ten thousand boxes on shelves.

Run it as `python benchmarks/space.py`; it prints microseconds of processor time and how they grow.
"""

from __future__ import annotations

import sys
import timeit
from collections.abc import Callable
from itertools import cycle
from pathlib import Path
from time import process_time

from skillc_runtime.world.space.frames import move_changes, placement_changes, pose, relative_pose
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.world_state import WorldState

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from space.rooms import EMPTY, at, lab, skillc, thing

SIZES = (10, 100, 1_000, 10_000)
PER_SHELF = 10
ROUNDS = 20_000


def scene(boxes: int) -> WorldState:
    """Return a world of so many boxes: ten on each shelf, each shelf in the frame of a rack."""
    changes: list[Change] = []
    for number in range(boxes // PER_SHELF):
        changes += thing(f"rack-{number}", at(2.0 * number, 0, 0))
        changes += thing(f"shelf-{number}", at(0, 0, 1), f"rack-{number}", size=(1.0, 0.4, 0.02))
        for place in range(PER_SHELF):
            name = f"box-{number * PER_SHELF + place}"
            changes += thing(name, at(0.09 * place - 0.4, 0, 0.06), f"shelf-{number}", size=(0.08, 0.1, 0.1))
    return EMPTY.with_changes(changes)


def microseconds(work: Callable[[], object], rounds: int) -> float:
    """Return the processor time of one call, the best of three measurements."""
    return min(timeit.repeat(work, timer=process_time, number=rounds, repeat=3)) / rounds * 1e6


def measured(boxes: int) -> dict[str, float]:
    """Return microseconds of what is done with one scene."""
    state, pairs = scene(boxes), [(lab(f"box-{n}"), lab(f"shelf-{n // PER_SHELF}")) for n in range(boxes)]
    some, relation = cycle(pairs[:1000]), skillc("restsOn")
    assert all(state.holds(*_asked(pair, relation)) for pair in pairs)
    here = lab("rack-0")
    return {
        "pose": microseconds(lambda: pose(state, next(some)[0]), ROUNDS),
        "seen from another": microseconds(lambda: relative_pose(state, here, next(some)[0]), ROUNDS),
        "restsOn": microseconds(lambda: state.holds(*_asked(next(some), relation)), ROUNDS // 10),
        "pose after a write": microseconds(lambda: pose(_written(state), next(some)[0]), 100),
        "move and look": microseconds(lambda: _moved(state), 100),
    }


def _asked(pair: tuple[str, str], relation: str) -> tuple[str, str, str]:
    return pair[0], relation, pair[1]


def _written(state: WorldState) -> WorldState:
    """Return a version in which a thing has been put elsewhere."""
    return state.with_changes(placement_changes(lab("rack-0"), at(0, 1, 0)))


def _moved(state: WorldState) -> object:
    after = state.with_changes(move_changes(state, lab("box-0"), at(0, 0, 0.06), lab("shelf-0")))
    return after.holds(lab("box-0"), skillc("restsOn"), lab("shelf-0"))


def main() -> None:
    """Measure each size and print a table."""
    found = {size: measured(size) for size in SIZES}
    print(f"{'microseconds':<20}" + "".join(f"{size:>10,}" for size in SIZES) + "    growth")
    for name in found[SIZES[0]]:
        row = [found[size][name] for size in SIZES]
        print(f"{name:<20}" + "".join(f"{value:>10.2f}" for value in row) + f"{row[-1] / row[0]:>9.1f}x")


if __name__ == "__main__":
    main()
