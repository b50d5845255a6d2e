"""Cost of a tick of the tree engine per active node, beside py_trees on the same shape in the same process.

Run it as `python benchmarks/tree_tick.py`; it prints a table with microseconds and ratios.
"""

from __future__ import annotations

import sys
import timeit
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import py_trees

from skillc_model import tree
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Primitive, Status
from skillc_runtime.recording.history.node_outcome import NodeOutcome

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from tree.library import FLAGS, Library, act, call, par, seq, world
from tree.stage import Stage

LEAF = "tree_tick:Leaf"
REPEATS, ROUNDS = 100, 100


class Busy(py_trees.behaviour.Behaviour):
    """A leaf that runs for ever."""

    def update(self) -> py_trees.common.Status:
        """Go on."""
        return py_trees.common.Status.RUNNING


class Done(py_trees.behaviour.Behaviour):
    """A leaf that succeeds at once."""

    def update(self) -> py_trees.common.Status:
        """Succeed."""
        return py_trees.common.Status.SUCCESS


class Leaf(Primitive):
    """A primitive that runs for ever, or as `done` succeeds at once."""

    def __init__(self, cell: Stage, *, name: str, **rest: object) -> None:
        super().__init__(cell)  # type: ignore[arg-type]
        self.status = Status.SUCCESS if name == "done" else Status.RUNNING

    def tick(self) -> Status:
        """Say how it is."""
        return self.status


def main() -> None:
    """Print one line for each shape."""
    print(f"{'shape':34} {'skillc':>9} {'per node':>9} {'py_trees':>9} {'per node':>9} {'ratio':>6}")
    for name, make in SHAPES.items():
        shape = make()
        ours, theirs = measure_best(shape.ours, shape.theirs)
        print(
            f"{name:34} {ours:6.2f} us {ours / shape.nodes:6.3f} us "
            f"{theirs:6.1f} us {theirs / shape.other_nodes:6.2f} us {theirs / ours:5.0f}x"
        )


def measure_best(*ticks: Callable[[], object]) -> tuple[float, ...]:
    """Return the best time of each tick in microseconds, measured in turns, so that a busy machine slows all alike."""
    times = [[timeit.timeit(tick, number=ROUNDS) for tick in ticks] for _ in range(REPEATS)]
    return tuple(min(column) / ROUNDS * 1e6 for column in zip(*times, strict=True))


def make_chain(depth: int = 20) -> SimpleNamespace:
    """Nested sequences with one leaf that runs at the bottom."""
    body: tree.Node = act("busy")
    other: py_trees.behaviour.Behaviour = Busy("busy")
    for number in range(depth):
        body = seq(body)
        parent = py_trees.composites.Sequence(f"seq{number}", memory=True)
        parent.add_child(other)
        other = parent
    return make_shape(body, other, depth + 2)


def make_parallel(count: int = 20) -> SimpleNamespace:
    """One parallel node with many leaves that run."""
    other = py_trees.composites.Parallel("par", policy=py_trees.common.ParallelPolicy.SuccessOnAll())
    other.add_children([Busy(f"busy{number}") for number in range(count)])
    return make_shape(par("all", *(act("busy") for _ in range(count))), other, 2 * count + 1)


def make_finished_sequence(count: int = 20) -> SimpleNamespace:
    """A sequence whose last child runs: what is done costs nothing."""
    other = py_trees.composites.Sequence("seq", memory=True)
    other.add_children([*(Done(f"done{number}") for number in range(count - 1)), Busy("busy")])
    return make_shape(seq(*(act("done") for _ in range(count - 1)), act("busy")), other, 3)


def make_compounds_with_holds(depth: int = 10) -> SimpleNamespace:
    """Compound skills in each other, each with a hold that is checked; there the hold is a condition and a parallel."""
    library = Library(LEAF)
    body: tree.Node = act("busy")
    other: py_trees.behaviour.Behaviour = Busy("busy")
    for number in range(depth):
        body = call(library.guarded(seq(body)), flag=FLAGS[0])
        parent = py_trees.composites.Sequence(f"held{number}", memory=False)
        parent.add_children([Done(f"hold{number}"), other])
        other = parent
    return make_shape(body, other, 2 * depth + 2, library)


def make_shape(
    body: tree.Node, other: py_trees.behaviour.Behaviour, nodes: int, library: Library | None = None
) -> SimpleNamespace:
    """Start both trees; `nodes` are those of ours that run, a call and its primitive each counting for themselves."""
    library = library or Library(LEAF)
    run = TreeRun(body, library.build(), Stage(world()))
    for _ in range(3):
        assert run.tick() is Status.RUNNING
        other.tick_once()
    assert count_running(run.outcome) == nodes, f"{count_running(run.outcome)} nodes run, not {nodes}"
    return SimpleNamespace(ours=run.tick, theirs=other.tick_once, nodes=nodes, other_nodes=count_visited(other))


def count_running(outcome: NodeOutcome) -> int:
    """Return how many nodes run."""
    return sum(map(count_running, outcome.children)) + (outcome.status == "running")


def count_visited(other: py_trees.behaviour.Behaviour) -> int:
    """Return how many nodes py_trees visits in a tick: those that run, and those of a reactive sequence before them."""
    reactive = isinstance(other, py_trees.composites.Sequence) and not other.memory
    below = [child for child in other.children if reactive or child.status is py_trees.common.Status.RUNNING]
    return 1 + sum(map(count_visited, below))


SHAPES: dict[str, Callable[[], SimpleNamespace]] = {
    "20 sequences, one leaf": make_chain,
    "parallel, 20 leaves": make_parallel,
    "sequence, 19 done and 1 running": make_finished_sequence,
    "10 compounds with holds": make_compounds_with_holds,
}

if __name__ == "__main__":
    main()
