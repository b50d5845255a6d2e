"""What is around a run: its start, its report, its film, each beside the least that libraries need for it."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median
from tempfile import TemporaryDirectory

from skillc.server.jobs.kinds.rehearsal import Unattended
from skillc.services.recording.picture_making import PictureOrder, Pictures
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run import running
from skillc.services.run.running import RunOptions, run_task
from skillc.services.tasks.loading import load_task
from skillc_runtime.evaluation.report.figure import render_figure
from skillc_runtime.evaluation.report.write import write_figures
from skillc_runtime.execution.pace import Pace
from skillc_runtime.film.footage import Footage
from skillc_runtime.film.framing import Framing, posed
from skillc_runtime.film.render_film import SIZES, render_film
from skillc_runtime.film.rendering import Quality, Renderer
from skillc_runtime.recording.run_spec import RunSpec

TASK = "contact:press_button"
PAIRS = 5
PLAIN = Quality(1.0, 0, 40)
LIBRARIES = "import mcap.writer, mujoco, numba, numpy, rich.console"
STARTED = """
import skillc.cli.commands.run
from skillc_dsl.importing import importing
from skillc_runtime.platforms.python_modules import defer_import

defer_import("glfw")
with importing():
    import skillc.cli.progress.run_output, skillc.services.run.running
"""


class KeptFilms(Pictures):
    """Keeps the orders of films, and makes none."""

    def __init__(self, folder: Path) -> None:
        super().__init__(SilentReporter(), folder)
        self.orders: list[PictureOrder] = []

    def begin(self, order: PictureOrder) -> None:
        self.orders.append(order)


def process_cpu_s(code: str) -> float:
    """Return the CPU time in s of a process that runs code."""
    before = getrusage(RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-c", code], check=True, env=dict(os.environ))
    after = getrusage(RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def cpu_s(function: Callable[[], object]) -> float:
    """Return the CPU time in s that a call takes in this process."""
    began = time.process_time()
    function()
    return time.process_time() - began


def compare_start() -> None:
    """Print what the imports of a run cost, beside those of the libraries."""
    ratios = [process_cpu_s(STARTED) / process_cpu_s(LIBRARIES) for _ in range(PAIRS)]
    print(f"imports of skillc run: {median(ratios):.2f} times those of the libraries")


def run_once(folder: Path) -> PictureOrder:
    """Run the task, print what its report and its figures cost beside an empty figure, and return its film."""
    films, report, cost = KeptFilms(folder), running.report_run, list[float]()

    def measured(*arguments: object) -> object:
        made: list[object] = []
        cost.append(cpu_s(lambda: made.append(report(*arguments))))  # type: ignore[arg-type]
        return made[0]

    running.report_run = measured  # type: ignore[assignment]
    spec = RunSpec(task=TASK, out=str(folder))
    with load_task(spec, SilentReporter()) as task:
        run_task(task, RunOptions(spec, tick_timeout_s=None), Unattended(Pace()), SilentReporter(), films)
    from matplotlib.figure import Figure

    empty = median(cpu_s(lambda: render_figure(lambda: Figure(figsize=(8, 4)))) for _ in range(PAIRS))
    figures = cpu_s(partial(write_figures, folder, films.orders[0].figures))
    print(f"report: {cost[0] / empty:.0f} empty figures, its figures {figures / empty:.0f}")
    return films.orders[0]


def compare_films(order: PictureOrder) -> None:
    """Print what a film costs, in pictures of 1280 x 720 pixels without shadows and smooth edges."""
    for quality in SIZES:
        footage = replace(order.footage, quality=quality)
        picture, film = plain_picture_s(footage), cpu_s(partial(render_film, footage, order.folder))
        print(
            f"film {quality}: {film / picture:.0f} plain pictures for {len(footage.frames)} frames, {film:.1f} s of CPU"
        )


def plain_picture_s(footage: Footage) -> float:
    """Return the CPU time in s of a plain picture, from one direction after the other."""
    frames = footage.frames
    view = next(Framing(footage.model, footage.prefixes, frames, footage.corners, 16 / 9).work_views())
    turned = [replace(view, azimuth_deg=view.azimuth_deg + turn) for turn in range(PAIRS)]
    renderer, data = Renderer(footage.model, 1280, 720, footage.props, PLAIN), posed(footage.model, frames[0].posture)
    times = [cpu_s(partial(renderer.picture, data, each)) for each in turned]
    renderer.close()
    return median(times)


def main() -> None:
    """Print all ratios."""
    compare_start()
    with TemporaryDirectory() as folder:
        compare_films(run_once(Path(folder)))


if __name__ == "__main__":
    main()
