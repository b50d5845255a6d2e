"""Conditions, inference, writes and planning problems on two sizes of scene, beside SPARQL on the same facts.

Run it as `python benchmarks/world_model.py`; it prints microseconds and ratios.
"""

from __future__ import annotations

import sys
import time
import timeit
from collections.abc import Callable
from pathlib import Path

import pyoxigraph as ox

from skillc_compiler.library.conditions import Exists, Holds, Not, Variable
from skillc_runtime.planning.problem import pose_problem
from skillc_runtime.world.conditions import compile_condition
from skillc_runtime.world.inference import infer
from skillc_runtime.world.state import WorldState

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from planning.samples import CLEANED, LAB, WIPING
from world.lab import assign, fact, holds, individual, iri, parameter, requirement

SIZES = (500, 20_000)
BOUND = {"a": iri("place-1"), "b": iri("part-1"), "object": iri("part-1"), "arm": iri("arm")}
THERE = requirement("there", holds("from", "contain", "object"))
MOUNTED = requirement("mounted", holds("arm", "hasA", "gripper"))
WANTED = (parameter("from", "Location"), parameter("gripper", "Gripper"))
NOT_EMPTY = Not(Exists("x", iri("Eraser"), Holds(Variable("a"), iri("contain"), Variable("x"))))


def scene(parts: int) -> WorldState:
    """Return a world with so many parts, each in a place of its own."""
    individuals = [individual(f"place-{n}", "Location") for n in range(parts)]
    individuals += [individual(f"part-{n}", "Product") for n in range(parts)]
    contents = [fact(f"place-{n}", "contain", f"part-{n}") for n in range(parts)]
    weights = [assign(f"part-{n}", "weight", 0.1) for n in range(parts)]
    return LAB.changed([*individuals, *contents, *weights])


def microseconds(work: Callable[[], object], rounds: int) -> float:
    """Return the processor time of one call, the best of three measurements."""
    return min(timeit.repeat(work, timer=time.process_time, number=rounds, repeat=3)) / rounds * 1e6


def store(state: WorldState) -> ox.Store:
    """Return the asserted relations as a SPARQL store."""
    quads = [
        ox.Quad(ox.NamedNode(subject), ox.NamedNode(relation), ox.NamedNode(object_))
        for relation, links in state.asserted.items()
        for subject, object_ in links.pairs()
    ]
    result = ox.Store()
    result.extend(quads)
    return result


def measured(parts: int) -> dict[str, float]:
    """Return microseconds by what was measured."""
    start = time.process_time()
    state = scene(parts)
    load = (time.process_time() - start) * 1e6
    graph = store(state)
    ask = f"ASK {{ <{BOUND['a']}> <{iri('contain')}> <{BOUND['b']}> }}"
    relation, quantified = compile_condition(holds("a", "contain", "b")), compile_condition(NOT_EMPTY)
    move = fact("place-0", "contain", "part-1")
    return {
        "a contain b": microseconds(lambda: relation(state, BOUND), 20_000),
        "the same in SPARQL": microseconds(lambda: bool(graph.query(ask)), 500),
        "not exists x: Eraser (a contain x)": microseconds(lambda: quantified(state, BOUND), 5_000),
        "infer two parameters": microseconds(lambda: infer(WANTED, (THERE, MOUNTED), BOUND, state), 500),
        "move a part": microseconds(lambda: state.changed((move,)), 500),
        "pose a planning problem": microseconds(lambda: pose_problem(WIPING, state, CLEANED), 1),
        "load": load,
    }


def main() -> None:
    """Measure both sizes and print a table."""
    small, large = map(measured, SIZES)
    print(f"{'microseconds with so many places and parts':44}{SIZES[0]:>12}{SIZES[1]:>12}{'ratio':>8}")
    for name in small:
        print(f"{name:44}{small[name]:12.1f}{large[name]:12.1f}{large[name] / small[name]:8.1f}")


if __name__ == "__main__":
    main()
