"""Job shops in which robots carry the jobs between machines: published instances, as a library, a world and a goal.

Bilge and Ulusoy, "A time window approach to simultaneous scheduling of machines and material handling system in an
FMS", Operations Research 43 (1995): two vehicles begin at the load and unload station, as do the jobs; one carries one
job, and drives empty to where the next one is. The makespan is the end of the last operation.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_model.conditions import And, Compare, Condition, Individual, Literal, PropertyOf
from skillc_model.skills import SkillLibrary
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.world_state import WorldState

CELL = "https://w3id.org/skillc/benchmarks/cell#"
LIBRARY = f"""use sumo, skiros, cora
prefix cell: <{CELL}>

class cell:Station < Device
class cell:Vehicle < Robot
class cell:Operation < Process
class cell:Way < Process

relation cell:needs(cell:Operation, cell:Station)  functional
relation cell:comesFrom(cell:Operation, cell:Station)  functional
relation cell:follows(cell:Operation, cell:Operation)  functional
relation cell:stands(cell:Vehicle, cell:Station)  functional
relation cell:begins(cell:Way, cell:Station)  functional
relation cell:ends(cell:Way, cell:Station)  functional
property cell:takes(cell:Operation): Time
property cell:lasts(cell:Way): Time
property cell:isDone(cell:Operation): Bool
property cell:isBrought(cell:Operation): Bool

skill Fetch {{
    in    operation: cell:Operation
    in    vehicle:   cell:Vehicle
    infer from:      cell:Station
    infer to:        cell:Station
    infer way:       cell:Way
    pre   operation cell:comesFrom to
    pre   vehicle cell:stands from
    pre   not from == to
    pre   way cell:begins from
    pre   way cell:ends to
    post  there: vehicle cell:stands to
    uses  vehicle
    duration way.cell:lasts
}}

skill Carry {{
    in    operation: cell:Operation
    in    vehicle:   cell:Vehicle
    infer before:    cell:Operation
    infer from:      cell:Station
    infer to:        cell:Station
    infer way:       cell:Way
    pre   operation cell:follows before
    pre   before.cell:isDone == true
    pre   operation cell:comesFrom from
    pre   operation cell:needs to
    pre   vehicle cell:stands from
    pre   way cell:begins from
    pre   way cell:ends to
    post  there: vehicle cell:stands to
    post  brought: operation.cell:isBrought == true
    uses  vehicle
    duration way.cell:lasts
}}

skill Work {{
    in    operation: cell:Operation
    infer machine:   cell:Station
    pre   operation cell:needs machine
    pre   operation.cell:isBrought == true
    post  done: operation.cell:isDone == true
    uses  machine
    duration operation.cell:takes
}}

impl plain of Fetch {{
    do seq {{
        wait 1 s
        apply there
    }}
}}

impl plain of Carry {{
    do seq {{
        wait 1 s
        apply there, brought
    }}
}}

impl plain of Work {{
    do seq {{
        wait 1 s
        apply done
    }}
}}
"""


class RobotCell(NamedTuple):
    """Jobs as pairs of a machine (from 1; 0 is the load station) and a time; times of the ways between stations."""

    jobs: tuple[tuple[tuple[int, int], ...], ...]
    ways: tuple[tuple[int, ...], ...]
    optimum: int
    vehicles: int = 2


_JOBS = {
    1: (
        ((1, 8), (2, 16), (4, 12)),
        ((1, 20), (3, 10), (2, 18)),
        ((3, 12), (4, 8), (1, 15)),
        ((4, 14), (2, 18)),
        ((3, 10), (1, 15)),
    ),
}
_LAYOUTS = {
    1: ((0, 6, 8, 10, 12), (12, 0, 6, 8, 10), (10, 6, 0, 6, 8), (8, 8, 6, 0, 6), (6, 10, 8, 6, 0)),
    2: ((0, 4, 6, 8, 6), (6, 0, 2, 4, 2), (8, 12, 0, 2, 4), (6, 10, 12, 0, 2), (4, 8, 10, 12, 0)),
}
PUBLISHED = {"EX11": RobotCell(_JOBS[1], _LAYOUTS[1], 96), "EX12": RobotCell(_JOBS[1], _LAYOUTS[2], 82)}
"""The optima are those of the literature that followed, such as Fontes and Homayouni, J. Global Optimization, 2019."""


def compile_cell() -> SkillLibrary:
    """Return the library of all robot cells."""
    with TemporaryDirectory() as folder:
        Path(folder, "cell.skill").write_text(LIBRARY, "utf-8")
        return compile_valid(find_library(Path(folder)))


def make_world(cell: RobotCell, library: SkillLibrary) -> WorldState:
    """Return the world before any operation, in which a minute is a second."""
    return WorldState.empty(library.vocabulary).with_changes(tuple(_changes(cell)))


def _changes(cell: RobotCell) -> Iterator[Change]:
    for station in range(len(cell.ways)):
        yield AddIndividual(f"{CELL}m{station}", (f"{CELL}Station",))
    for vehicle in range(cell.vehicles):
        yield AddIndividual(f"{CELL}v{vehicle}", (f"{CELL}Vehicle",))
        yield AddRelation(f"{CELL}v{vehicle}", f"{CELL}stands", f"{CELL}m0")
    for one, other in product(range(len(cell.ways)), repeat=2):
        way = f"{CELL}w{one}{other}"
        yield AddIndividual(way, (f"{CELL}Way",))
        yield AddRelation(way, f"{CELL}begins", f"{CELL}m{one}")
        yield AddRelation(way, f"{CELL}ends", f"{CELL}m{other}")
        yield SetProperty(way, f"{CELL}lasts", float(cell.ways[one][other]))
    for number, job in enumerate(cell.jobs):
        before, station = f"{CELL}j{number}begin", 0
        yield AddIndividual(before, (f"{CELL}Operation",))
        yield SetProperty(before, f"{CELL}isDone", True)
        for index, (machine, time) in enumerate(job):
            name = f"{CELL}j{number}o{index}"
            yield AddIndividual(name, (f"{CELL}Operation",))
            yield AddRelation(name, f"{CELL}follows", before)
            yield AddRelation(name, f"{CELL}comesFrom", f"{CELL}m{station}")
            yield AddRelation(name, f"{CELL}needs", f"{CELL}m{machine}")
            yield SetProperty(name, f"{CELL}takes", float(time))
            before, station = name, machine


def make_goal(cell: RobotCell) -> Condition:
    """Return the condition that the last operation of each job is done."""
    last = (f"{CELL}j{number}o{len(job) - 1}" for number, job in enumerate(cell.jobs))
    return And(tuple(Compare(PropertyOf(Individual(each), f"{CELL}isDone"), "==", Literal(True)) for each in last))
