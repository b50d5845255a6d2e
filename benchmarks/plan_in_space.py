"""Planning with looks in space: growth with parts and with failures, and a template cell that is checked.

A part lies under others, and many more stand around. Beside it the baseline, sequential refinement without feedback:
one plan, whose steps are refined one after another; what does not go is not given back to the planner.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from resource import RUSAGE_CHILDREN, RUSAGE_SELF, getrusage
from tempfile import TemporaryDirectory
from typing import Any

from geometry import LIMIT_S, PART_B, Silent, pile

from skillc.services.planning.planning import plan_goal, prepare_planners
from skillc.services.scaffolding.new_library import create_library
from skillc.services.tasks.loading import LoadedTask, load_task
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.refinement.plan_refinement import refine_plan
from skillc_runtime.execution.refinement.replanning import plan_in_space
from skillc_runtime.planning.plan import Excluded, GaveUp, Unsolvable
from skillc_runtime.recording.run_spec import RunSpec

PARTS = (10, 30, 100, 200)
FAILURES = (0, 1, 2, 4, 6)
PITCH_M = 0.07
ROWS = 14
SIDE = "lab:SideTable"


def used_s() -> float:
    """Return the CPU time in s of this process, and of those that it has started and that have ended."""
    used = [getrusage(which) for which in (RUSAGE_SELF, RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


def cell(parts: int, above: int) -> str:
    """Return a cell with so many parts: one to be moved, so many on it, the others on a table beside the arm."""
    text = pile(above) if above else pile(1).replace("skillc:on lab:Part-A .", PART_B, 1)
    more = [
        f"lab:Cell skiros:contain {SIDE} .\n{SIDE} a skillc:Furniture ; skiros:SizeX 1.2 ; skiros:SizeY 1.2 ; "
        'skiros:SizeZ 0.5 ; skiros:FrameId "side_table" ; skiros:BaseFrameId "map" ; '
        "skiros:PositionX -0.9 ; skiros:PositionY 0.0 ; skiros:PositionZ 0.5 ."
    ]
    for number in range(parts - max(above, 1) - 1):
        x, y = PITCH_M * (number // ROWS) - 0.55, PITCH_M * (number % ROWS) - 0.45
        name = f"lab:Other-{number}"
        more.append(
            f"lab:Cell skiros:contain {name} .\n{name} a sorting:WorkPart ; skiros:SizeX 0.03 ; skiros:SizeY 0.03 ; "
            f"skiros:SizeZ 0.04 ; skiros:Weight 0.1 ; skillc:on {SIDE} ; skillc:atX {x:.2f} ; skillc:atY {y:.2f} ."
        )
    return "\n".join([text, *more])


def measure(parts: int, above: int, folder: Path) -> tuple[str, float]:
    """Return a row on a cell, and the CPU time in s with feedback."""
    scene = folder / f"cell_{parts}_{above}.ttl"
    scene.write_text(cell(parts, above))
    spec = RunSpec(scene=str(scene), library="sorting", goal="lab:Box-A contain lab:Part-A")
    with load_task(spec, Silent()) as loaded:  # type: ignore[abstract]
        _refine_once(loaded)  # models are read, and scenes placed, once
        alone_s, (went, steps) = _timed(lambda: _refine_once(loaded))
        whole_s, (plans, planned, solved) = _timed(lambda: _plan_with_feedback(loaded))
    told = f"all {planned} steps go" if solved else "no plan"
    row = (
        f"{parts:5} parts, {above} on top: {told} after {plans} plans, {whole_s:6.2f} s; "
        f"baseline {went} of {steps} steps go, {alone_s:5.2f} s; {whole_s / alone_s:5.1f} times"
    )
    return row, whole_s


def _timed(work: Callable[[], Any]) -> tuple[float, Any]:
    began = used_s()
    found = work()
    return used_s() - began, found


def _refine_once(loaded: LoadedTask) -> tuple[int, int]:
    """Plan once and refine the steps in order; return how many go before the first that does not, and how many are."""
    answer = plan_goal(loaded, prepare_planners(False), CancelToken(LIMIT_S))
    assert not isinstance(answer, Unsolvable | GaveUp), answer
    found = refine_plan(loaded.library, loaded.assignment.state, answer.plan.steps)
    return len(found.steps), len(answer.plan.steps)


def _plan_with_feedback(loaded: LoadedTask) -> tuple[int, int, bool]:
    """Return how often was planned, how many steps the last plan has, and whether all of them go."""
    token, planners, plans = CancelToken(LIMIT_S), prepare_planners(False), 0

    def plan(without: Sequence[Excluded]) -> Any:
        nonlocal plans
        plans += 1
        return plan_goal(loaded, planners, token, without=without)

    answer, found = plan_in_space(loaded.library, loaded.assignment.state, plan, token)
    if isinstance(answer, Unsolvable | GaveUp) or found is None or found.failed is not None:
        return plans, 0, False
    return plans, len(answer.plan.steps), True


def measure_check(folder: Path) -> str:
    """Return what it costs to check the cell of a template: first, unchanged, and after an edit of something else."""
    project, other = folder / "mine", folder / "other"
    create_library(project, "wipe")
    create_library(other, "press")
    tasks = project / "tasks.skill"
    tasks.write_text(tasks.read_text() + "\nskill Rest { noplan }\nimpl idle of Rest { do wait 1 s }\n")
    environment = {**os.environ, "SKILLC_CACHE": str(folder / "cache")}

    def run(*arguments: str) -> float:
        return _timed(lambda: subprocess.run(arguments, env=environment, capture_output=True, check=False, cwd=folder))[
            0
        ]

    check = (sys.executable, "-m", "skillc", "check", str(project))
    start_s = run(sys.executable, "-c", "import click")
    run(*check[:-1], str(other))  # kinematics are compiled, once for a version
    first_s, again_s = run(*check), run(*check)
    tasks.write_text(tasks.read_text().replace("wait 1 s", "wait 2 s"))
    edited_s = run(*check)
    times = (each / start_s for each in (first_s, again_s, edited_s))
    first, again, edited = (f"{each:.1f}" for each in times)
    return (
        f"check of a template cell: first {first_s:.2f} s, {first} times as long as importing click; "
        f"unchanged {again_s:.2f} s, {again} times; after an edit elsewhere {edited_s:.2f} s, {edited} times"
    )


def main() -> None:
    """Print a row for each number of parts and of failures, how they grow, and what a check costs."""
    most = int(sys.argv[1]) if len(sys.argv) > 1 else PARTS[-1]
    with TemporaryDirectory() as name:
        folder, sizes = Path(name), [each for each in PARTS if each <= most]
        for label, rows in (
            ("parts", [(parts, 1) for parts in sizes]),
            ("failures", [(PARTS[0], above) for above in FAILURES]),
        ):
            times = list[float]()
            for parts, above in rows:
                row, seconds = measure(parts, above, folder)
                times.append(seconds)
                print(row, flush=True)
            print(f"growth with {label}: {times[-1] / times[0]:.1f} times")
        print(measure_check(folder))


if __name__ == "__main__":
    main()
