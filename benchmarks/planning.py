"""Problems, plans and memory over 10 to 250,000 places and as many parts, a million facts; the goal names three.

Run it as `python benchmarks/planning.py`; it prints seconds, and how often the smallest scene's the largest one's are.
How they grow is drawn in `planning.png` in the folder `build/benchmarks`, or in the one given.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import msgspec

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from planning.samples import CLEAN, CLEANED, DRIVE, LAB, PICK, library, post, skill
from skillc_model.conditions import And, Holds, Individual, Not
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.abstraction.lower_bound import relax_scene
from skillc_runtime.planning.plan import Solved
from skillc_runtime.planning.planners import list_planners
from skillc_runtime.planning.problem.neighbourhood import NARROW
from skillc_runtime.planning.problem.pose import PosedProblem, pose_problem
from skillc_runtime.planning.solve import solve
from skillc_runtime.world.state.bulk import FactTables, build_world_state
from skillc_runtime.world.state.world_state import WorldState
from world.lab import VOCABULARY, holds, iri, parameter, requirement

SIZES = (10, 30, 100, 300, 500, 1_000, 3_000, 10_000, 25_000, 250_000)
WHOLE_AT_MOST = 10_000
"""Of how many places at most the problem of the whole scene is posed."""
PLACE = skill(
    "Place",
    (
        parameter("object", "Product", "in"),
        parameter("to", "Location", "in"),
        parameter("robot", "Robot"),
        parameter("arm", "Arm"),
        parameter("gripper", "Gripper"),
    ),
    (
        requirement("mounted", holds("robot", "hasA", "arm")),
        requirement("has hand", holds("arm", "hasGripper", "gripper")),
        requirement("here", holds("robot", "at", "to")),
        requirement("held", holds("gripper", "contain", "object")),
    ),
    (post(holds("to", "contain", "object")), post(Not(holds("gripper", "contain", "object")))),
    10.0,
)
SKILLS = library(DRIVE, PICK, PLACE, CLEAN)
GOAL = And((CLEANED, *(Holds(Individual(iri("wall")), iri("contain"), Individual(iri(f"part-{n}"))) for n in (1, 2))))


@dataclass(frozen=True)
class Measured:
    """Seconds and mebibytes for one scene, from one process.

    The first plan is that for the near problem, posed and solved; the proof is that no plan of the scene is shorter,
    posed and solved too. Where nothing is left out, there is none to be made.
    """

    triples: int
    load: float
    whole_problem: float | None
    near_problem: float
    first_plan: float
    proof: float | None
    memory_mib: float
    planner_mib: float


def scene(parts: int) -> WorldState:
    """Return a world with so many parts, each in a place of its own."""
    places = [iri(f"place-{n}") for n in range(parts)]
    products = [iri(f"part-{n}") for n in range(parts)]
    related = {relation: list(links.pairs()) for relation, links in LAB.asserted.items()}
    valued = {property_: dict(table.items()) for property_, table in LAB.stored.items()}
    related[iri("contain")] += zip(places, products, strict=True)
    valued[iri("weight")] |= dict.fromkeys(products, 0.1)
    types = {**dict.fromkeys(places, (iri("Location"),)), **dict.fromkeys(products, (iri("Product"),))}
    return build_world_state(VOCABULARY, FactTables({**dict(LAB.direct.items()), **types}, related, valued))


def timed(work: Callable[[], object]) -> float:
    """Return the seconds on the clock that a call takes, the best of three."""

    def once() -> float:
        start = time.perf_counter()
        work()
        return time.perf_counter() - start

    return min(once() for _ in range(3))


def measured(parts: int) -> Measured:
    """Measure one scene."""
    start = time.perf_counter()
    state = scene(parts)
    load = time.perf_counter() - start
    near = pose_problem(SKILLS, state, GOAL, (), NARROW)
    result = solve(SKILLS, state, GOAL)
    assert isinstance(result, Solved) and result.optimal == "proven", result
    return Measured(
        triples=_triples(state),
        load=load,
        whole_problem=timed(lambda: pose_problem(SKILLS, state, GOAL)) if parts <= WHOLE_AT_MOST else None,
        near_problem=timed(lambda: pose_problem(SKILLS, state, GOAL, (), NARROW)),
        first_plan=timed(lambda: first_plan(state)),
        proof=timed(lambda: prove(near, state)) if near.narrowed else None,
        memory_mib=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        planner_mib=resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024,
    )


def _triples(state: WorldState) -> int:
    """Return how many facts were written."""
    links = sum(len(objects) for each in state.asserted.values() for _, objects in each.forward.items())
    values = sum(1 for table in state.stored.values() for _ in table.items())
    return len(state.individuals) + links + values


def prove(near: PosedProblem, state: WorldState) -> None:
    """Find the bound on all plans of the scene."""
    bound = relax_scene(near, state)
    assert bound is not None and isinstance(list_planners()[0].plan(bound, CancelToken(30.0)), Solved)


def first_plan(state: WorldState) -> None:
    """Pose the near problem and solve it with the first planner."""
    answer = list_planners()[0].plan(pose_problem(SKILLS, state, GOAL, (), NARROW).problem, CancelToken(30.0))
    assert isinstance(answer, Solved)


def main(folder: Path) -> None:
    """Measure every size in a process of its own, print a table, plot the growth."""
    found = {size: msgspec.json.decode(_apart(size), type=Measured) for size in SIZES}
    names = [each.name for each in fields(Measured)]
    print(f"{'things of a kind':>16}" + "".join(f"{name:>15}" for name in names))
    for size, each in found.items():
        print(f"{size:16}" + "".join(map(_shown, asdict(each).values())))
    small, large = asdict(found[SIZES[0]]), asdict(found[SIZES[-1]])
    growth = (large[name] / small[name] if large[name] and small[name] else None for name in names)
    print(f"{'growth':>16}" + "".join(map(_shown, growth)))
    folder.mkdir(parents=True, exist_ok=True)
    _plot(found, names, folder / "planning.png")


def _shown(number: float | None) -> str:
    return f"{'-':>15}" if number is None else f"{number:15.3f}"


def _apart(size: int) -> bytes:
    return subprocess.run((sys.executable, __file__, "--one", str(size)), check=True, capture_output=True).stdout


def _plot(found: dict[int, Measured], names: list[str], file: Path) -> None:
    from matplotlib import use

    use("Agg")
    from matplotlib import pyplot

    figure, (seconds, memory) = pyplot.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
    for name in names:
        axes = memory if name.endswith("mib") else seconds
        if name != "triples":
            known = {each.triples: asdict(each)[name] for each in found.values() if asdict(each)[name] is not None}
            axes.loglog(list(known), list(known.values()), "o-", label=name)
    seconds.axhline(1.0, color="grey", linestyle=":", label="1 s")
    memory.axhline(1024.0, color="grey", linestyle=":", label="1 GiB")
    for axes, unit in ((seconds, "seconds"), (memory, "MiB")):
        axes.set(xlabel="triples", ylabel=unit)
        axes.legend()
        axes.grid(alpha=0.3)
    figure.savefig(file, dpi=120)
    print(f"how it grows: {file}")


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["--one", size]:
            sys.stdout.buffer.write(msgspec.json.encode(measured(int(size))))
        case [folder]:
            main(Path(folder))
        case _:
            main(Path("build/benchmarks"))
