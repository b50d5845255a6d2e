"""Judges what a look in space says of wiping a surface."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from judged_looks.looking import judge_task
from judged_looks.verdict import Verdict
from random_cells.drawing import ArmName
from random_surfaces.dense_search import DenseSearch
from random_surfaces.drawing import Surface, draw_surface, format_scene
from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc.services.tasks.loading import LoadedTask
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel


@cache
def load_library() -> SkillLibrary:
    """Return the shipped library of wiping."""
    return libraries.compile_library(find_library(SHIPPED / "wiping")).value


def judge(seed: int, arm: ArmName, folder: Path) -> Verdict:
    """Judge what is said of the surface of a seed; its scene is written into a folder."""
    return judge_surface(draw_surface(seed, arm), seed, arm, folder)


def judge_surface(surface: Surface, seed: int, kind: str, folder: Path) -> Verdict:
    """Judge what is said of a surface; its scene is written into a folder."""

    def search(cell: SimulatedCell) -> str | None:
        start = DenseSearch(cell, surface).solves()
        return None if start is None else f"from {start.round(2).tolist()}"

    return judge_task(load_surface(surface, folder / f"{kind}_{seed}.ttl"), seed, kind, search)


def load_surface(surface: Surface, scene: Path) -> LoadedTask:
    """Return the task to wipe a surface, whose scene is written."""
    scene.parent.mkdir(parents=True, exist_ok=True)
    scene.write_text(format_scene(surface), "utf-8")
    library = load_library()
    state = load_scene(scene, library.vocabulary)
    goal = library.tasks["clean_desk"].goal
    assert goal is not None
    assignment = Assignment("clean_desk", state, AchieveGoal(goal))
    return LoadedTask(library, assignment, WorldModel(state), str(scene))
