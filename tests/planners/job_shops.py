"""Job shops: published instances and random ones, as a library with a world and a goal.

A job is a sequence of operations, each on its own machine for a whole number of minutes; machines and jobs do one at a
time. The optimum is the least makespan.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType
from typing import NamedTuple

from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_model.conditions import And, Compare, Condition, Individual, Literal, PropertyOf
from skillc_model.skills import SkillLibrary
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.world_state import WorldState

SHOP = "https://w3id.org/skillc/benchmarks/shop#"
LIBRARY = f"""use sumo, skiros
prefix shop: <{SHOP}>

class shop:Machine < Device
class shop:Job < Product
class shop:Operation < Process

relation shop:partOf(shop:Operation, shop:Job)  functional
relation shop:needs(shop:Operation, shop:Machine)  functional
relation shop:precedes(shop:Operation, shop:Operation)
property shop:takes(shop:Operation): Time
property shop:isDone(shop:Operation): Bool

skill Work {{
    in    operation: shop:Operation
    infer job:       shop:Job
    infer machine:   shop:Machine
    pre   operation shop:partOf job
    pre   operation shop:needs machine
    pre   forall other: shop:Operation (other shop:precedes operation implies other.shop:isDone == true)
    post  done: operation.shop:isDone == true
    uses  machine
    uses  job
    duration operation.shop:takes
}}

impl plain of Work {{
    do seq {{
        wait 1 s
        apply done
    }}
}}
"""


class JobShop(NamedTuple):
    """Each job as pairs of a machine and a time; the published least makespan, None for one that is not published."""

    jobs: tuple[tuple[tuple[int, int], ...], ...]
    optimum: int | None = None

    @classmethod
    def read(cls, text: str, optimum: int) -> JobShop:
        """Read an instance in the usual format: a line for each job, with a machine and a time for each operation."""
        rows = ([int(word) for word in line.split()] for line in text.strip().splitlines())
        return cls(tuple(tuple(zip(row[::2], row[1::2], strict=True)) for row in rows), optimum)

    @classmethod
    def draw(cls, jobs: int, machines: int, seed: int) -> JobShop:
        """Draw an instance as Taillard ("Benchmarks for basic scheduling problems", 1993) does: times from 1 to 99."""
        chance = random.Random(seed)
        order = range(machines)
        return cls(
            tuple(tuple((each, chance.randint(1, 99)) for each in chance.sample(order, machines)) for _ in range(jobs))
        )


# Muth and Thompson, "Industrial scheduling", 1963 (ft06, ft10, ft20), and Lawrence, 1984 (la01, la16), as in the
# OR-Library of Beasley; optima as in Jain and Meeran, "Deterministic job-shop scheduling", 1999.
PUBLISHED: Mapping[str, JobShop] = MappingProxyType(
    {
        "ft06": JobShop.read(
            """2 1 0 3 1 6 3 7 5 3 4 6
            1 8 2 5 4 10 5 10 0 10 3 4
            2 5 3 4 5 8 0 9 1 1 4 7
            1 5 0 5 2 5 3 3 4 8 5 9
            2 9 1 3 4 5 5 4 0 3 3 1
            1 3 3 3 5 9 0 10 4 4 2 1""",
            55,
        ),
        "la01": JobShop.read(
            """1 21 0 53 4 95 3 55 2 34
            0 21 3 52 4 16 2 26 1 71
            3 39 4 98 1 42 2 31 0 12
            1 77 0 55 4 79 2 66 3 77
            0 83 3 34 2 64 1 19 4 37
            1 54 2 43 4 79 0 92 3 62
            3 69 4 77 1 87 2 87 0 93
            2 38 0 60 1 41 3 24 4 83
            3 17 1 49 4 25 0 44 2 98
            4 77 3 79 2 43 1 75 0 96""",
            666,
        ),
        "ft10": JobShop.read(
            """0 29 1 78 2 9 3 36 4 49 5 11 6 62 7 56 8 44 9 21
            0 43 2 90 4 75 9 11 3 69 1 28 6 46 5 46 7 72 8 30
            1 91 0 85 3 39 2 74 8 90 5 10 7 12 6 89 9 45 4 33
            1 81 2 95 0 71 4 99 6 9 8 52 7 85 3 98 9 22 5 43
            2 14 0 6 1 22 5 61 3 26 4 69 8 21 7 49 9 72 6 53
            2 84 1 2 5 52 3 95 8 48 9 72 0 47 6 65 4 6 7 25
            1 46 0 37 3 61 2 13 6 32 5 21 9 32 8 89 7 30 4 55
            2 31 0 86 1 46 5 74 4 32 6 88 8 19 9 48 7 36 3 79
            0 76 1 69 3 76 5 51 2 85 9 11 6 40 7 89 4 26 8 74
            1 85 0 13 2 61 6 7 8 64 9 76 5 47 3 52 4 90 7 45""",
            930,
        ),
    }
)


def compile_shop() -> SkillLibrary:
    """Return the library of all job shops."""
    with TemporaryDirectory() as folder:
        Path(folder, "shop.skill").write_text(LIBRARY, "utf-8")
        return compile_valid(find_library(Path(folder)))


def make_world(shop: JobShop, library: SkillLibrary) -> WorldState:
    """Return the world before any operation, in which a minute is a second."""
    return WorldState.empty(library.vocabulary).with_changes(tuple(_changes(shop)))


def _changes(shop: JobShop) -> Iterator[Change]:
    for machine in sorted({machine for job in shop.jobs for machine, _ in job}):
        yield AddIndividual(f"{SHOP}m{machine}", (f"{SHOP}Machine",))
    for number, job in enumerate(shop.jobs):
        yield AddIndividual(f"{SHOP}j{number}", (f"{SHOP}Job",))
        names = [f"{SHOP}j{number}o{index}" for index in range(len(job))]
        for name, (machine, time) in zip(names, job, strict=True):
            yield AddIndividual(name, (f"{SHOP}Operation",))
            yield AddRelation(name, f"{SHOP}partOf", f"{SHOP}j{number}")
            yield AddRelation(name, f"{SHOP}needs", f"{SHOP}m{machine}")
            yield SetProperty(name, f"{SHOP}takes", float(time))
        for one, other in pairwise(names):
            yield AddRelation(one, f"{SHOP}precedes", other)


def make_goal(shop: JobShop) -> Condition:
    """Return the condition that the last operation of each job is done."""
    last = (f"{SHOP}j{number}o{len(job) - 1}" for number, job in enumerate(shop.jobs))
    return And(tuple(Compare(PropertyOf(Individual(each), f"{SHOP}isDone"), "==", Literal(True)) for each in last))
