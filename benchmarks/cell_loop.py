"""Cost of a tick of a cell's loop with one task run, beside ticking its tree and letting time pass directly.

Run it as `python benchmarks/cell_loop.py`; it prints a table with microseconds and ratios. Most cells have no devices,
so that nothing is measured but the loop; the last line is a cell with an arm.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from tree_tick import measure_best

from execution import actors
from execution.loops import LatePlanner, StagedCell, submit
from skillc_model import tree
from skillc_runtime.devices.backend import Backend
from skillc_runtime.execution.assignment import Assignment, ExecuteBody
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.tree.gate import Gate
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from tree.library import Library, act, par, seq, world

LIBRARY = Library("tree_tick:Leaf").build()


def main() -> None:
    """Print one line for each shape."""
    print(f"{'shape':34} {'loop':>10} {'tree':>10} {'ratio':>6}")
    for name, (body, make) in SHAPES.items():
        loop, direct = measure_best(make_loop_tick(body, make()), make_direct_tick(body, make()))
        print(f"{name:34} {loop:7.2f} us {direct:7.2f} us {loop / direct:5.2f}x")


def make_loop_tick(body: tree.Node, backend: Backend) -> Callable[[], object]:
    """Return the tick of a loop with one run, which never ends."""
    loop = CellLoop(backend, LIBRARY, LatePlanner(LIBRARY))
    watched = submit(loop, Assignment("act", backend.cell.world.snapshot(), ExecuteBody(body)))
    watched.until("running")
    return loop.tick


def make_direct_tick(body: tree.Node, backend: Backend) -> Callable[[], object]:
    """Return what ticks a tree and lets time pass, and does nothing else."""
    run = TreeRun(body, LIBRARY, backend.cell, [lambda event: None], gate=Gate())

    def tick() -> None:
        assert run.tick() is Status.RUNNING
        backend.advance(TICK_S)

    tick()
    return tick


def make_stage() -> Backend:
    """Return a cell without devices."""
    return StagedCell(world())  # type: ignore[return-value]


SHAPES: dict[str, tuple[tree.Node, Callable[[], Backend]]] = {
    "one leaf": (act("busy"), make_stage),
    "3 sequences, one leaf": (seq(seq(seq(act("busy")))), make_stage),
    "parallel, 20 leaves": (par("all", *(act("busy") for _ in range(20))), make_stage),
    "one leaf, kinematic arm": (act("busy"), actors.cell),
}

if __name__ == "__main__":
    main()
