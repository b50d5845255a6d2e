"""A package with a back end for the toy robot, and a server of a cell with it: what the package of a robot is."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from control_process.toy_link import Toy
from docs.installing import install, use
from server.running import RunningServer, serving
from skillc_ontology import catalogue

SCENE = "iiwa_table"
PROJECT = """[build-system]
requires = ["setuptools"]
build-backend = "setuptools.build_meta"

[project]
name = "toy-backend"
version = "0.1.0"

[project.entry-points."skillc.backends"]
toy = "toy_backend:make_backend"

[tool.setuptools]
py-modules = ["toy_backend"]
"""
BACKEND = '''"""Opens the cell of a toy robot that runs."""

from control_process.toy_link import Toy


def make_backend(world, start):
    return Toy({scene!r}, running=({port}, {panel})).open_world(world)
'''
LIBRARY = """# Takes the eraser, and moves.

use skiros, skillc
import "handling.skill"
import "motion.skill"
prefix lab: <http://example.org/lab#>

## Take the eraser.
task fetch {
    scene "yard.ttl"
    goal  lab:Robotiq-1 contain lab:Eraser-1
}

## Move to and fro until somebody stops it.
task swing {
    scene "yard.ttl"
    do repeat 200 {
        seq {
            TakePosture(arm: lab:Iiwa-1, pace: 0.2)
            MoveTo(arm: lab:Iiwa-1, target: lab:Eraser-1-approach.pose, pace: 0.2)
        }
    }
}
"""


def write_toy(folder: Path, toy: Toy) -> None:
    """Write the project of the package."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "pyproject.toml").write_text(PROJECT, "utf-8")
    text = BACKEND.format(scene=toy.scene, port=toy.port, panel=toy.panel_port)
    (folder / "toy_backend.py").write_text(text, "utf-8")


def write_cell(folder: Path, _takes_ms: int) -> None:
    """Write the library and the scene of the cell."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "toy.skill").write_text(LIBRARY, "utf-8")
    scene = catalogue.scene_path(f"{SCENE}.ttl").read_text("utf-8")
    (folder / "yard.ttl").write_text(scene, "utf-8")


@contextmanager
def serving_toy(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[Toy, RunningServer]]:
    """Yield a toy robot and the server of its cell `yard`."""
    toy = Toy(SCENE)
    try:
        write_toy(folder / "package", toy)
        install(folder / "package", folder / "site")
        use(folder / "site", monkeypatch)
        with serving(folder / "served", options=("--backend", "toy"), write=write_cell) as server:
            yield toy, server
    finally:
        toy.close()
