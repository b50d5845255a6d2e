"""A scene of any size in the shipped vocabulary and what is measured in it; `world_model.py` runs this per size."""

from __future__ import annotations

import gc
import json
import resource
import sys
import time
import timeit
from collections.abc import Callable, Iterator
from itertools import count, cycle
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

import pyoxigraph as ox

from skillc.services.library import libraries
from skillc_dsl.position import Position
from skillc_model.conditions import Condition, HasProperty, Holds, IsA, Variable
from skillc_model.skills import Parameter, Requirement
from skillc_rdf.vocabulary.types import ClassType, Vocabulary
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import load_scene, load_sheets, read_documents, sheet_documents
from skillc_runtime.scene.saving import save_scene
from skillc_runtime.store.disk import DiskStore
from skillc_runtime.store.world_from_triples import build_world
from skillc_runtime.store.world_index import LEAST, read_index, write_index
from skillc_runtime.world.eval.conditions import compile_condition
from skillc_runtime.world.eval.inference import Inferred, infer
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.state.elements import find_element
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent
from skillc_runtime.world.state.world_state import WorldState

Result = TypeVar("Result")
LAB, SKIROS = "http://example.org/lab#", "http://rvmi.aau.dk/ontologies/skiros.owl#"
CAREFUL_AT_MOST = 20_000
"""In how many objects at most all that is wrong is looked for: that takes a minute in a million triples."""
PARTS_IN_A_PLACE = 9
HEAD = f"@prefix skiros: <{SKIROS}> . @prefix lab: <{LAB}> .\n"
PLACE = """lab:place-{0} a skiros:Location ; skiros:FrameId "place-{0}" ; skiros:BaseFrameId "map" ;
 skiros:PositionX {0}e0 ; skiros:PositionY 1.5 ; skiros:PositionZ 0.0 ; skiros:OrientationX 0.0 ;
 skiros:OrientationY 0.0 ; skiros:OrientationZ 0.0 ; skiros:OrientationW 1.0 .
"""
PART = """lab:part-{0} a skiros:Part ; skiros:Weight 0.{0}5 ; skiros:SizeX 0.1 ; skiros:SizeY 0.2 ; skiros:SizeZ 0.3 ;
 skiros:CadModel "part-{0}.stl" . lab:place-{1} skiros:contain lab:part-{0} .
"""
HERE = Position("benchmark.skill", 1, 1)
PLACES, PRODUCT = f"{SKIROS}Location", f"{SKIROS}Part"
CONTAIN, WITHIN, WEIGHT = f"{SKIROS}contain", "https://w3id.org/skillc/core#within", f"{SKIROS}Weight"
BOUND = {"a": f"{LAB}place-0", "b": f"{LAB}part-0"}
CONDITIONS: dict[str, Condition] = {
    "a contain b": Holds(Variable("a"), CONTAIN, Variable("b")),
    "b within a": Holds(Variable("b"), WITHIN, Variable("a")),
    "b has Weight": HasProperty(Variable("b"), WEIGHT),
    "a is Location": IsA(Variable("a"), PLACES),
}
THERE, WHOLE = Holds(Variable("from"), CONTAIN, Variable("b")), Holds(Variable("b"), WITHIN, Variable("whole"))
WANTED = tuple(
    Parameter(name=name, direction="infer", type=ClassType(PLACES), source=HERE) for name in ("from", "whole")
)
LINKED = tuple(Requirement(label="", condition=each, text="", source=HERE) for each in (THERE, WHOLE))


def scene(objects: int) -> Iterator[str]:
    """Yield a scene of so many objects, one place for nine parts."""
    yield HEAD
    places = max(1, objects // (PARTS_IN_A_PLACE + 1))
    yield from (PLACE.format(number) for number in range(places))
    yield from (PART.format(number, number % places) for number in range(objects - places))


def measured(objects: int) -> dict[str, float]:
    """Return what was measured, by name with its unit; processor time, the best of several where it is short."""
    vocabulary = libraries.load_vocabulary()
    load_sheets(vocabulary)
    with TemporaryDirectory() as folder:
        path = Path(folder, "scene.ttl")
        path.write_text("".join(scene(objects)), "utf-8")
        found = {"triples": float(triples(path))}
        before = resident()
        load, state = timed(lambda: load_scene(path, vocabulary))
        found |= {"load s": load, "memory of the world MB": resident() - before}
        found |= reading(state) | writing(WorldModel(state))
        found |= storing(state, vocabulary, Path(folder))
        found["save s"], _ = timed(lambda: save_scene(state, Path(folder, "saved.ttl"), load_sheets(vocabulary)))
        if objects <= CAREFUL_AT_MOST:
            documents = [Document.read(path), *sheet_documents()]
            found["load, all problems reported s"], _ = timed(lambda: read_documents(documents, vocabulary))
    found["most memory of the process MB"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return found


def storing(state: WorldState, vocabulary: Vocabulary, folder: Path) -> dict[str, float]:
    """Measure how a store on disk is opened again, from its facts and, if it is large, from its index."""
    store = DiskStore(folder / "store")
    store.append(ChangeEvent((), "benchmark", WorldState.empty(vocabulary), state), 0)
    place = store.find_index()
    assert place is not None
    found: dict[str, float] = {}
    found["open a store from its facts s"], _ = timed(lambda: build_world(store.read().triples, vocabulary, "it"))
    if len(state.individuals) >= LEAST:
        found["write the index s"], _ = timed(lambda: write_index(place, vocabulary, state))
        found["open a store from its index s"], again = timed(lambda: read_index(place, vocabulary))
        assert again is not None and again.individuals == state.individuals
    store.close()
    return found


def reading(state: WorldState) -> dict[str, float]:
    """Measure conditions and inference."""
    found = {}
    for name, condition in CONDITIONS.items():
        check = compile_condition(condition)
        assert check(state, BOUND)
        found[f"condition `{name}` us"] = microseconds(lambda check=check: check(state, BOUND), 20_000)  # type: ignore[misc]
    assert isinstance(infer(WANTED, LINKED, BOUND, state), Inferred)
    found["infer two parameters us"] = microseconds(lambda: infer(WANTED, LINKED, BOUND, state), 300)
    found["see an element us"] = microseconds(lambda: find_element(state, BOUND["b"]).properties, 300)
    return found


def writing(model: WorldModel) -> dict[str, float]:
    """Measure writes with their checks and listeners."""
    ways = [AddRelation(BOUND["a"], CONTAIN, BOUND["b"]), AddRelation(f"{LAB}dock", CONTAIN, BOUND["b"])]
    model.commit([AddIndividual(f"{LAB}dock", (PLACES,))])
    turns, numbers = cycle(ways), count()
    return {
        "snapshot us": microseconds(model.snapshot, 20_000),
        "commit: move a part us": microseconds(lambda: model.commit([next(turns)]), 300),
        "commit: set a weight us": microseconds(
            lambda: model.commit([SetProperty(BOUND["b"], WEIGHT, 1.0 + next(numbers))]), 300
        ),
        "commit: a new part us": microseconds(
            lambda: model.commit([AddIndividual(f"{LAB}new-{next(numbers)}", (PRODUCT,))]), 20
        ),
        "commit and undo us": microseconds(lambda: (model.commit([ways[0]]), model.undo()), 100),
    }


def microseconds(work: Callable[[], object], rounds: int) -> float:
    """Return the processor time of one call, the best of three measurements."""
    return min(timeit.repeat(work, timer=time.process_time, number=rounds, repeat=3)) / rounds * 1e6


def timed(work: Callable[[], Result]) -> tuple[float, Result]:
    """Return the processor time of one call in s, and what it returned."""
    start = time.process_time()
    result = work()
    return time.process_time() - start, result


def triples(path: Path) -> int:
    """Return how many triples a file has."""
    return sum(1 for _ in ox.parse(path=path))


def resident() -> float:
    """Return the memory of this process that is in use, in MB."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[1])
    return pages * resource.getpagesize() / 1e6


if __name__ == "__main__":
    print(json.dumps(measured(int(sys.argv[1]))))
