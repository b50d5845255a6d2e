"""Runs one shipped task, recorded, and has the CPU time that it takes after start-up; also in other checkouts.

`python _whole_task.py LIBRARY TASK` prints a line of JSON. It uses only what all commits have that are compared.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

from _calibration import calibration_step_us

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc.services.run.recordings import make_recorded_cell
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.mcap.contents import RunContents
from skillc_runtime.recording.mcap.recording_file import RecordingFile
from skillc_runtime.recording.publisher import Publisher
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel


def run_recorded(
    library_name: str, task: str, make_cell: Callable[[WorldModel], SimulatedCell] = SimulatedCell
) -> tuple[SimulatedCell, float]:
    """Run a task in a new cell; return it, closed, and the CPU time in s: tree, records and world model included.

    Planning and preparing are not. What the first run in a process compiles or loads is part of its time.
    """
    library = libraries.compile_library(find_library(SHIPPED / library_name)).value
    goal, scene = library.tasks[task].goal, library.tasks[task].scene
    assert goal is not None
    assert scene is not None
    state = load_scene(catalogue.scene_path(scene), library.vocabulary)
    prepared = prepare_task(Assignment(task, state, AchieveGoal(goal)), library)
    assert isinstance(prepared, PreparedTask), prepared
    with closing(make_cell(WorldModel(state))) as cell, TemporaryDirectory() as folder:
        recording = RecordingFile(Path(folder) / "run.mcap", lambda: RunContents({}), make_recorded_cell(cell))
        began = process_time()
        recording.sample()
        execute_task(prepared, library, cell, [Publisher(task, [recording])])
        recording.close()
        cpu_s = process_time() - began
        assert recording.problem is None, recording.problem
        return cell, cpu_s


def main(library: str, task: str) -> None:
    """Print CPU time and simulated time in s of the second run, and the calibration step in us, before and after it."""
    run_recorded(library, task)
    before = calibration_step_us()
    cell, cpu_s = run_recorded(library, task)
    measured = {"cpu_s": cpu_s, "simulated_s": cell.now, "calibration_us": (before + calibration_step_us()) / 2}
    print(json.dumps(measured))


if __name__ == "__main__":
    main(*sys.argv[1:])
