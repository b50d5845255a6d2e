"""What a tick costs that records signals, against one that does not; in a cell at rest, by format."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from skillc.services.library import libraries
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.recording.signals.files import CsvSink, ParquetSink
from skillc_runtime.recording.signals.sampler import SignalSampler
from skillc_runtime.recording.signals.signal import Signal, SignalSink
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

SCENES, TICKS = ("iiwa_table", "ur5e_whiteboard", "two_robots"), 300


class NoSink:
    """Takes samples and does nothing with them."""

    def write(self, row: object) -> None:
        pass

    def close(self) -> None:
        pass


def main() -> None:
    """Print a row for each scene and format."""
    print(f"{'scene':16} {'to':8} {'signals':>7} {'us a sample':>12} {'of a tick':>10} {'bytes a row':>12}")
    for scene in SCENES:
        vocabulary = libraries.load_vocabulary()
        cell = SimulatedCell(WorldModel(load_scene(catalogue.scene_path(scene), vocabulary)), 0)
        for form in ("nothing", "csv", "parquet"):
            with TemporaryDirectory() as folder:
                measure(scene, form, cell, Path(folder) / "signals")


def measure(scene: str, form: str, cell: SimulatedCell, path: Path) -> None:
    """Print the row of a scene and a format."""
    sinks: dict[str, Callable[[Sequence[Signal]], SignalSink]] = {
        "nothing": lambda signals: NoSink(),
        "csv": lambda signals: CsvSink(path, signals),
        "parquet": lambda signals: ParquetSink(path, signals, TICK_S),
    }
    sampler = SignalSampler(cell, sinks[form])
    ticks = samples = 0.0
    for _ in range(TICKS):
        start = perf_counter()
        cell.advance(TICK_S)
        between = perf_counter()
        sampler.sample()
        ticks, samples = ticks + between - start, samples + perf_counter() - between
    start = perf_counter()
    sampler.close()
    samples += perf_counter() - start
    size = path.stat().st_size / TICKS if path.exists() else 0.0
    share = f"{samples / ticks:.1%}"
    print(f"{scene:16} {form:8} {len(sampler.signals):7} {1e6 * samples / TICKS:12.0f} {share:>10} {size:12.0f}")


if __name__ == "__main__":
    main()
