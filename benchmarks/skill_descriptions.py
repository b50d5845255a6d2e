"""Compares what the skills in the world model cost: beside the start of a cell, and in queries.

A cell of two robots without physics, with the shipped wiping library. A start makes nothing of its skills; the first
query does, which is counted as if it were part of the start. CPU times, all in one process.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from itertools import count
from pathlib import Path
from statistics import median

from skillc.cells.opening import open_cell
from skillc.cells.settings import CellSettings
from skillc.cells.snapshot import CellSnapshot
from skillc.services.library import skill_descriptions
from skillc.services.library.files import SHIPPED, find_scene
from skillc.services.library.skill_descriptions import with_library_prefix
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.views.open_scenes import describe_state
from skillc.services.views.scenes import query_document
from skillc_runtime.execution.selection.robot_skills import match_robots
from skillc_runtime.scene.load import sheet_documents
from skillc_runtime.scene.query import run_query

REPEATS = 9
FACTS = "SELECT ?arm { ?robot skillc:hasArm ?arm }"
CHANGES = "SELECT ?text { :Pick skiros:hasPostCondition/skillc:conditionText ?text }"
ABLE = "SELECT ?robot { ?robot skiros:hasSkill :Wipe }"


def measure(work: Callable[[], object]) -> float:
    """Return the median CPU time of some work in s; it is done once before."""
    times = []
    for _ in range(REPEATS + 1):
        began = time.process_time()
        work()
        times.append(time.process_time() - began)
    return median(times[1:])


def start(folder: Path) -> CellSnapshot:
    """Start a cell in a new folder, end it, and return what it knew."""
    scene = str(find_scene(Path("two_robots")))
    settings = CellSettings(
        name="cell", scene=scene, library=str(SHIPPED / "wiping"), folder=str(folder), backend="kinematic"
    )
    with open_cell(settings, SilentReporter()) as host:
        return CellSnapshot(host.library, host.world.snapshot(), (), 0)


def describe_anew(known: CellSnapshot) -> None:
    """Describe the skills of a library as for its first query."""
    skill_descriptions._describe.cache_clear()
    skill_descriptions.describe_skills(known.library, known.state, CHANGES)


def main() -> None:
    with tempfile.TemporaryDirectory() as parent:
        folders = (Path(parent) / str(number) for number in count())
        known = start(next(folders))
        library, state = known.library, known.state
        document, documents = describe_state("cell", state), sheet_documents()
        vocabulary = with_library_prefix(state.vocabulary, library)

        starting = measure(lambda: start(next(folders)))
        describing = measure(lambda: describe_anew(known))
        matching = measure(lambda: list(match_robots(library, state)))
        plain = measure(lambda: run_query([document, *documents], FACTS, vocabulary))
        whole = (starting + describing + matching) / starting
        print(f"the start of a cell and the first query about skills, to the start alone: {whole:.2f}")
        for name, sparql in (("facts", FACTS), ("descriptions", CHANGES), ("robots", ABLE)):
            asking = measure(lambda sparql=sparql: query_document(document, sparql, library, state))
            print(f"a query for {name + ',':14} to one of a world without skills: {asking / plain:.2f}")


if __name__ == "__main__":
    main()
