"""Whatever fact is taken out of a cell that has a plan: the first answer names it, and nothing that holds."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from planning.breaking import break_one
from planning.test_why_no_plan import CLEAN, FOLDER, PUT
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import load_task
from skillc_ontology import catalogue
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.recording.run_spec import RunSpec

BOARD = "lab:Whiteboard-1.isClean == true"
UNNAMED = ("BaseFrameId", "FrameId")
"""What is said of these names the frame, or what is placed in it, and not who has it."""


@pytest.mark.slow
@pytest.mark.parametrize("goal", [CLEAN, PUT, BOARD])
def test_the_first_answer_names_what_is_missing(goal: str, tmp_path: Path) -> None:
    library, scene = tmp_path / "why", FOLDER / "cell.ttl"
    library.mkdir()
    shutil.copy(FOLDER / "mopping.skill", library / "why.skill")
    spec = RunSpec(library=str(library), scene=str(scene), goal=goal)
    if goal == BOARD:
        spec = RunSpec(library="wiping", scene=str(catalogue.ROOT / "scenes" / "ur5e_whiteboard.ttl"), goal=goal)
    with load_task(spec, SilentReporter()) as task:
        objective = task.assignment.objective
        assert isinstance(objective, AchieveGoal)
        found = list(break_one(task.library, task.assignment.state, objective.goal, seed=1, most=8))
        assert len(found) == 8
        wrong = [each.says for each in found if not each.is_named and not each.term.endswith(UNNAMED)]
        assert not wrong
        assert not any(each.is_claimed_wrongly(task.library) for each in found)
