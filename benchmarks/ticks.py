"""CPU time of the ticks of shipped tasks, by the skill that is active: none may hold up the control of other devices.

`ticks.py [LIBRARY.TASK..]`: for each skill the median tick, the longest, and how many were longer than `LIMIT_MS`, as
multiples of a reference: the median tick of all, in which nothing begins or ends. A tick is what happens between two
control periods; what is computed beside the ticks, in another process, is not part of it.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from pathlib import Path
from statistics import median
from time import thread_time

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

from backends.kinematic_runs import library, prepare
from skillc.services.library.files import SHIPPED
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.execute import WAIT_S
from skillc_runtime.execution.preparation import prepare_after, prepare_here
from skillc_runtime.motion.numerics.compiled import compile_imported
from skillc_runtime.recording.events import Event, NodeStarted
from skillc_runtime.world.state.model import WorldModel

TASKS = ("sorting.sort_parts", "wiping.clean_whiteboard", "contact.polish_sheet", "contact.insert_peg")
LIMIT_MS = 20.0
"""What a tick may take on a machine as fast as one of ours."""


def measure(name: str, found: dict[str, list[float]]) -> None:
    """Run a task, and add the ms of CPU time of each tick to those of the skills that began in it, or are active."""
    owner, _, task = name.partition(".")
    compiled = library(owner)
    scene = compiled.tasks[task].scene
    assert scene is not None
    beside = SHIPPED / owner / scene
    prepared = prepare(compiled, task, beside if beside.exists() else catalogue.scene_path(scene))
    begun, ended = list[str](), [0.0]

    def note(event: Event) -> None:
        if isinstance(event, NodeStarted) and event.kind == "primitive":
            begun.append(event.name.partition("[")[0])

    def end_tick() -> None:
        ended[0] = thread_time()

    cell = SimulatedCell(WorldModel(prepared.assignment.state), seed=1)
    plan = prepare_after(prepared, prepare_here(compiled))
    loop = CellLoop(cell, compiled, plan, commit=end_tick)
    run = loop.submit(prepared.assignment, [note])
    compile_imported()
    while not run.ended:
        begun.clear()
        began = thread_time()
        if not loop.tick():
            loop.wait(WAIT_S)
        elif run.tree is not None:
            active = [f"{each} begins" for each in begun] or [each.skill_name for each in run.tree.active_calls]
            for each in active or ["between skills"]:
                found[each].append(1e3 * (ended[0] - began))
    assert run.end == "succeeded", run.failure
    cell.close()


def main(tasks: list[str]) -> None:
    """Print one line for each skill, the slowest first."""
    found: dict[str, list[float]] = defaultdict(list)
    for each in tasks:
        measure(each, found)
    reference = median(took for ticks in found.values() for took in ticks)
    print(f"the limit is {LIMIT_MS / reference:.0f}x")
    print(f"{'ticks in which':34} {'number':>7} {'median':>8} {'longest':>9} {'> limit':>8}")
    for name, ticks in sorted(found.items(), key=lambda each: -max(each[1])):
        over = sum(took > LIMIT_MS for took in ticks)
        print(f"{name:34} {len(ticks):7} {median(ticks) / reference:7.1f}x {max(ticks) / reference:8.0f}x {over:8}")


if __name__ == "__main__":
    main(sys.argv[1:] or list(TASKS))
