"""What a recording costs the loop of a cell in each control period, and how large it is; by scene, beside its tick."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import skillc
from skillc.services import libraries
from skillc.services.run_recordings import make_recorded_cell
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.recording.mcap.contents import RunContents
from skillc_runtime.recording.mcap.recording_file import RecordingFile
from skillc_runtime.recording.mcap.signal_tap import SampledBlock, SignalTap
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

SCENES, TASKS, PERIODS, TICKS, TURNS = (
    ("iiwa_table", "ur5e_whiteboard", "two_robots"),
    ("clean_whiteboard",),
    20_000,
    200,
    4,
)


def main() -> None:
    """Print a row for each scene, then one for each task."""
    print(f"{'scene':18} {'us a period':>12} {'of a period':>12}")
    for scene in SCENES:
        measure_loop(scene)
    print(f"\n{'scene':18} {'wall time':>12}")
    for scene in SCENES:
        measure_share(scene)
    print(f"\n{'task':18} {'MB':>12} {'MB in 60 s':>12}")
    for task in TASKS:
        measure_size(task)


def measure_loop(scene: str) -> None:
    """Print what sampling costs, against the computation of a control period without it."""
    with closing(
        SimulatedCell(WorldModel(load_scene(catalogue.scene_path(scene), libraries.load_vocabulary())))
    ) as cell:
        cell.advance(TICK_S)
        start = perf_counter()
        cell.advance(TICKS * TICK_S)
        period = (perf_counter() - start) / (TICKS * TICK_S / cell.period_s)
        taken: list[SampledBlock] = []
        tap = SignalTap(cell.live)
        tap.add(taken.append)
        (sample,) = cell.live.listeners
        start = perf_counter()
        for _ in range(PERIODS):
            sample()
        cost = (perf_counter() - start) / PERIODS
    print(f"{scene:18} {1e6 * cost:12.2f} {cost / period:12.2%}")


def measure_share(scene: str) -> None:
    """Print the wall time of a cell that is recorded, with the thread that writes, against one that is not."""
    with closing(
        SimulatedCell(WorldModel(load_scene(catalogue.scene_path(scene), libraries.load_vocabulary())))
    ) as cell:
        cell.advance(TICK_S)
        times = [0.0, 0.0]
        for turn in range(2 * TURNS):
            with TemporaryDirectory() as folder:
                recording = RecordingFile(Path(folder) / "a.mcap", lambda: RunContents({}), make_recorded_cell(cell))
                recording.sample(turn % 2 == 1)
                start = perf_counter()
                cell.advance(TICKS * TICK_S)
                times[turn % 2] += perf_counter() - start
                recording.close()
    print(f"{scene:18} {times[1] / times[0]:12.3f}")


def measure_size(task: str) -> None:
    """Print how large the recording of a task is."""
    with TemporaryDirectory() as folder:
        run = skillc.run(task, out=folder)
        size = (Path(folder) / "recording.mcap").stat().st_size / 1e6
        print(f"{task:18} {size:12.2f} {60 * size / run.result.sim_time_s:12.2f}")


if __name__ == "__main__":
    main()
