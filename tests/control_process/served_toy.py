"""A package that offers the back end of the toy robot, and a server of a cell with it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from control_process import toy_backend
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
toy = "control_process.toy_backend:make_backend"

[tool.setuptools]
py-modules = []
"""
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
        toy_backend.choose(toy, monkeypatch)
        package = folder / "package"
        package.mkdir(parents=True, exist_ok=True)
        (package / "pyproject.toml").write_text(PROJECT, "utf-8")
        install(package, folder / "site")
        use(folder / "site", monkeypatch)
        with serving(folder / "served", options=("--backend", "toy"), write=write_cell) as server:
            yield toy, server
    finally:
        toy.close()
