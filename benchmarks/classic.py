"""Classic planning problems beside Fast Downward alone, on hand-written PDDL: CPU and wall-clock time, cold.

Run it as `python benchmarks/classic.py [PROBLEMS]`, with the number of random problems of each size, 5 by default.
Before them stand the instances in `classic_problems`, as `skillc import pddl` writes them, beside their own files.
Deliveries on a tree of roads among a thousand objects follow, and by a fleet among ten thousand, for which there is no
PDDL by hand.
`ours` is the whole command `skillc plan`, from the files to the validated plan that is proved optimal; `start` is that
command for a goal that already holds, and `alone` is Fast Downward's driver with `astar(lmcut())`.
"""

from __future__ import annotations

import json
import re
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import NamedTuple

import _roads
from _blocks import DOMAIN, Blocks, library

from skillc_runtime.planning.fast_downward.solver import find_fast_downward

SIZES = (4, 5, 6, 7, 8)
INSTANCES = Path(__file__).parent / "classic_problems"
SKILLC = (sys.executable, "-m", "skillc")
PLAN = (*SKILLC, "plan", "--library", ".", "--scene", "cell.ttl", "--no-plan-cache")
BOUND = 2.0
"""How many times as long as Fast Downward alone, without the start of the program, a proof may take."""


class Took(NamedTuple):
    """What a command has taken, in s, and what it printed."""

    cpu_s: float
    wall_s: float
    output: str


def main() -> None:
    """Measure and print a line for each instance, then for each size of random problems."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    _measure_instances()
    print(f"{'blocks':>6}{'start':>15}{'ours':>15}{'alone':>15}{'(ours-start)/alone':>22}{'proved':>9}")
    print(f"{'':>6}{3 * '     CPU   wall'}{'median':>12}{'worst':>10}")
    for size in SIZES:
        rows = [_measured(Blocks.draw(size, seed)) for seed in range(count)]
        start, ours, alone = (Took(*(median(each[i][j] for each in rows) for j in (0, 1)), "") for i in range(3))  # type: ignore[arg-type]
        ratios = sorted((one.cpu_s - begun.cpu_s) / other.cpu_s for begun, one, other in rows)
        proved = sum("proved optimal" in one.output for _, one, _ in rows)
        times = "".join(f"{each.cpu_s:8.2f}{each.wall_s:7.2f}" for each in (start, ours, alone))
        holds = "holds" if ratios[-1] <= BOUND else "BROKEN"
        print(f"{size:>6}{times}{median(ratios):12.2f}{ratios[-1]:10.2f}{proved:>6}/{count}  {holds}", flush=True)
    _measure_roads()
    _measure_fleet()


def _measure_instances() -> None:
    """Print what each committed instance takes, and what the plans cost."""
    print(f"{'instance':<12}{'start':>15}{'ours':>15}{'alone':>15}{'(ours-start)/alone':>22}{'cost, alone':>13}")
    print(f"{'':<12}{3 * '     CPU   wall'}")
    for problem in sorted(INSTANCES.glob("*/*-*.pddl")):
        files = (str(problem.parent / "domain.pddl"), str(problem))
        with tempfile.TemporaryDirectory() as made:
            project = Path(made, "project")
            _take((*SKILLC, "import", "pddl", *files, "--out", str(project)), Path(made))
            thing = next(re.finditer(r"^(lab:\S+) a ", (project / "cell.ttl").read_text("utf-8"), re.MULTILINE))[1]
            _take((*SKILLC, "check"), project)  # the compiled library is cached from here on
            start = _take((*SKILLC, "plan", "--no-plan-cache", "--goal", f"{thing} == {thing}"), project)
            ours = _take((*SKILLC, "plan", "--no-plan-cache", "--json"), project)
            alone = _alone(files, Path(made))
        ratio = (ours.cpu_s - start.cpu_s) / alone.cpu_s
        answer, found = json.loads(ours.output), re.search(r"Plan cost: (\d+)", alone.output)
        cost = round(answer["cost"] if answer["minimise"] == "cost" else answer["duration_s"])
        proved = answer["plan_optimal"] and found is not None and cost == int(found[1])
        times = "".join(f"{each.cpu_s:8.2f}{each.wall_s:7.2f}" for each in (start, ours, alone))
        verdict = "holds" if proved and ratio <= BOUND else "BROKEN"
        print(f"{problem.stem:<12}{times}{ratio:22.2f}{cost:>7}{found[1] if found else '-':>6}  {verdict}", flush=True)


def _alone(files: tuple[str, str], folder: Path) -> Took:
    """Return what Fast Downward takes for a domain and a problem."""
    programs = find_fast_downward()
    assert programs is not None, "the extra `planner` is needed"
    return _take((*programs.driver, *files, "--search", "astar(lmcut())"), folder)


def _measure_roads() -> None:
    """Print what three deliveries on a tree of 50 places take, with 945 parts."""
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made, "roads")
        folder.mkdir()
        (folder / "roads.skill").write_text(_roads.LIBRARY, "utf-8")
        (folder / "cell.ttl").write_text(_roads.draw_scene(50, 945, 0), "utf-8")
        took = _take((*PLAN, "--goal", _roads.draw_goal(50, 3, 0)), folder)
    print(f"roads: {took.cpu_s:.2f} s of CPU, {took.wall_s:.2f} s; {took.output.strip().splitlines()[-1]}")


def _measure_fleet() -> None:
    """Print what 20 deliveries by 50 robots on a grid of 484 places take, with 10,000 parts, by deadline."""
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made, "roads")
        folder.mkdir()
        (folder / "roads.skill").write_text(_roads.LIBRARY, "utf-8")
        (folder / "cell.ttl").write_text(_roads.draw_fleet(50, 22, 10_000, 0), "utf-8")
        for deadline in ("3", "30"):
            took = _take((*PLAN, "--goal", _roads.draw_goal(484, 20, 0), "--deadline", deadline), folder)
            found = next(each for each in took.output.splitlines() if " expected, " in each)
            print(f"fleet, within {deadline} s: {took.cpu_s:.2f} s of CPU, {took.wall_s:.2f} s; {found}", flush=True)


def _measured(problem: Blocks) -> tuple[Took, Took, Took]:
    """Return what the start of the program, our command and Fast Downward alone have taken."""
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made, "blocks")
        folder.mkdir()
        for name, text in {
            "blocks.skill": library(),
            "cell.ttl": problem.scene,
            "domain.pddl": DOMAIN,
            "problem.pddl": problem.problem,
        }.items():
            (folder / name).write_text(text, "utf-8")
        here = " and ".join(f"lab:{one} on lab:{other}" for one, other in problem.start if other)
        _take((*PLAN, "--goal", "lab:b0 == lab:b0"), folder)  # the compiled library is cached from here on
        start = _take((*PLAN, "--goal", here or "lab:b0.onTable == true"), folder)
        ours = _take((*PLAN, "--goal", problem.goal), folder)
        return start, ours, _alone(("domain.pddl", "problem.pddl"), folder)


def _take(command: Sequence[str], folder: Path) -> Took:
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    after, wall_s = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter() - began
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return Took(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall_s, ended.stdout)


if __name__ == "__main__":
    main()
