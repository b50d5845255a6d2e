"""What a recording costs the loop of a cell in each control period, and how large it is; by scene, beside its tick."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, thread_time

import skillc
from skillc.services.library import libraries
from skillc.services.run.recordings import make_recorded_cell
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.recording.mcap.contents import RunContents
from skillc_runtime.recording.mcap.recording_file import RecordingFile
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

SCENES, TASKS, TICKS, TURNS = ("iiwa_table", "ur5e_whiteboard", "two_robots"), ("clean_whiteboard",), 200, 4


def main() -> None:
    """Print a row for each scene, then one for each task."""
    print(f"{'scene':18} {'us a period':>12} {'loop':>12} {'wall time':>12}")
    for scene in SCENES:
        measure_share(scene)
    print(f"\n{'task':18} {'MB':>12} {'MB in 60 s':>12}")
    for task in TASKS:
        measure_size(task)


def measure_share(scene: str) -> None:
    """Print what recording adds to each period of the loop, and the time of the loop and of the wall by that without.

    The loop is the CPU time of its thread; the wall has the thread beside it that writes.
    """
    with closing(
        SimulatedCell(WorldModel(load_scene(catalogue.scene_path(scene), libraries.load_vocabulary())))
    ) as cell:
        cell.advance(TICK_S)
        loop, wall = [0.0, 0.0], [0.0, 0.0]
        for turn in range(2 * TURNS):
            with TemporaryDirectory() as folder:
                recording = RecordingFile(Path(folder) / "a.mcap", lambda: RunContents({}), make_recorded_cell(cell))
                recording.sample(turn % 2 == 1)
                began, began_loop = perf_counter(), thread_time()
                cell.advance(TICKS * TICK_S)
                loop[turn % 2] += thread_time() - began_loop
                wall[turn % 2] += perf_counter() - began
                recording.close()
                assert recording.problem is None, recording.problem
    added_us = 1e6 * (loop[1] - loop[0]) / (TURNS * TICKS * TICK_S / cell.period_s)
    print(f"{scene:18} {added_us:12.2f} {loop[1] / loop[0]:12.3f} {wall[1] / wall[0]:12.3f}")


def measure_size(task: str) -> None:
    """Print how large the recording of a task is."""
    with TemporaryDirectory() as folder:
        run = skillc.run(task, out=folder)
        size = (Path(folder) / "recording.mcap").stat().st_size / 1e6
        print(f"{task:18} {size:12.2f} {60 * size / run.result.sim_time_s:12.2f}")


if __name__ == "__main__":
    main()
