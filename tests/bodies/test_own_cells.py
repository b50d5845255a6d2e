"""Parts and places without any stated grasp are picked and placed, or a sentence with numbers says why not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from backends.kinematic_runs import prepare
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_compiler.goals.parsing import parse_call
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import Assignment, ExecuteBody, NotStarted, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN

LAB = "http://example.org/lab#"
FOLDER = Path(__file__).parent / "sorting"
CELL = (FOLDER / "cell.ttl").read_text(encoding="utf-8")
BACKENDS = [pytest.param(SimulatedCell, marks=pytest.mark.sim), KinematicCell]

IIWA = [("skillc:Panda ;", "skillc:Iiwa14 ;"), ("skillc:panda-sheet", "skillc:iiwa14-sheet")]
ROBOTIQ = [("skillc:PandaHand ;", "skillc:RobotiqGripper ;"), ("skillc:panda-hand-sheet", "skillc:robotiq-3f-sheet")]
UR5E = [
    ("skillc:Panda ;", "skillc:Ur5e ;"),
    (
        'skillc:panda-sheet ; skiros:CompliantController "impedance"',
        "skillc:ur5e-sheet ; " + 'skiros:CompliantController "forward_dynamics" ; skillc:hasSensor lab:Wrist-1',
    ),
    ("lab:Pedestal a", "lab:Wrist-1 a skillc:ForceTorqueSensor .\n\nlab:Pedestal a"),
]
WSG = [("skillc:PandaHand ;", "skillc:WsgGripper ;"), ("skillc:panda-hand-sheet", "skillc:wsg50-sheet")]
CELLS = {"panda": [], "iiwa": [*IIWA, *ROBOTIQ], "ur5e": [*UR5E, *WSG]}
PICK_A = "Pick(arm: lab:Panda-1, object: lab:Part-A)"
PICK_B = "Pick(arm: lab:Panda-1, object: lab:Part-B)"


def place(part: str, to: str) -> str:
    return f"Place(arm: lab:Panda-1, object: lab:{part}, to: lab:{to})"


def library() -> SkillLibrary:
    return compile_valid(find_library(FOLDER))


def written(folder: Path, edits: list[tuple[str, str]]) -> Path:
    """Write the cell with edits, each of which changes something."""
    text = CELL
    for before, after in edits:
        assert before in text, before
        text = text.replace(before, after)
    (folder / "cell.ttl").write_text(text, encoding="utf-8")
    return folder / "cell.ttl"


def carry_out(scene: Path, calls: list[str], backend: type[SimulatedCell | KinematicCell]) -> Execution | NotStarted:
    """Carry out calls one after the other in one cell, as far as they succeed; return how the last one ended."""
    compiled = library()
    cell = backend(WorldModel(load_scene(scene, compiled.vocabulary)))
    ended: Execution | NotStarted | None = None
    for text in calls:
        now = cell.world.snapshot()
        individuals = {each: sorted(now.types(each)) for each in now.individuals}
        call = parse_call(text, compiled, individuals, now.vocabulary.prefixes)
        assert call.value is not None, call.diagnostics
        prepared = prepare_task(Assignment("move", now, ExecuteBody(call.value)), compiled)
        if not isinstance(prepared, PreparedTask):
            return prepared
        ended = execute_task(prepared, compiled, cell)
        if ended.status != "succeeded":
            break
    assert ended is not None
    return ended


def failure_of(ended: Execution | NotStarted) -> str:
    if isinstance(ended, NotStarted):
        return ended.reason
    assert ended.status == "failed" and ended.failure is not None
    return ended.failure.message


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arm", "backend"),
    [pytest.param("panda", SimulatedCell, marks=pytest.mark.sim), *((arm, KinematicCell) for arm in CELLS)],
)
def test_three_arms_sort_parts_without_any_stated_pose(
    arm: str, backend: type[SimulatedCell | KinematicCell], tmp_path: Path
) -> None:
    compiled = library()
    prepared = prepare(compiled, "sort_parts", written(tmp_path, CELLS[arm]))
    cell = backend(WorldModel(prepared.assignment.state))
    execution = execute_task(prepared, compiled, cell)
    assert execution.status == "succeeded", execution.failure
    cell.advance(0.5)
    for letter in "AB":
        bin_, part = (cell.ground_truth.body_pose(LAB + name) for name in (f"Bin-{letter}", f"Part-{letter}"))
        assert np.abs((bin_.inverse() @ part).position[:2]).max() < 0.015


@pytest.mark.slow
@pytest.mark.parametrize("backend", BACKENDS)
def test_a_part_is_put_beside_another_one_on_a_tray(
    backend: type[SimulatedCell | KinematicCell], tmp_path: Path
) -> None:
    tray = [
        (
            "lab:Bin-A a sorting:Bin ;\n    skiros:SizeX 0.16 ; skiros:SizeY 0.16 ; skiros:SizeZ 0.06 ;",
            'lab:Bin-A a sorting:Bin ; skillc:shape "box" ;\n'
            "    skiros:SizeX 0.2 ; skiros:SizeY 0.2 ; skiros:SizeZ 0.02 ;",
        ),
        (
            "skiros:PositionX 0.45 ; skiros:PositionY 0.15 ; skiros:PositionZ 0.63",
            "skiros:PositionX 0.45 ; skiros:PositionY 0.15 ; skiros:PositionZ 0.61",
        ),
    ]
    calls = [PICK_A, place("Part-A", "Bin-A"), PICK_B, place("Part-B", "Bin-A")]
    ended = carry_out(written(tmp_path, tray), calls, backend)
    assert isinstance(ended, Execution) and ended.status == "succeeded", ended
    ended.backend.advance(0.5)
    after = ended.backend.world.snapshot()
    one, other = (LAB + name for name in ("Part-A", "Part-B"))
    assert after.holds(LAB + "Bin-A", CONTAIN, one) and after.holds(LAB + "Bin-A", CONTAIN, other)
    really = [ended.backend.ground_truth.body_pose(each) for each in (one, other)]
    assert np.linalg.norm((really[0].position - really[1].position)[:2]) > 0.04
    for part, true, half in zip((one, other), really, (0.03, 0.035), strict=True):
        assert true.position[2] == pytest.approx(0.62 + half, abs=0.003)
        assert np.linalg.norm(pose(after, part).position - true.position) < 0.01


A_SIZE = "skiros:SizeX 0.04 ; skiros:SizeY 0.04 ; skiros:SizeZ 0.06 ; skiros:Weight 0.15"
BIN_A = "lab:Bin-A a sorting:Bin ;\n    skiros:SizeX 0.16 ; skiros:SizeY 0.16 ; skiros:SizeZ 0.06 ;"
TO_BIN = [PICK_A, place("Part-A", "Bin-A")]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("edits", "calls", "why"),
    [
        (
            [(BIN_A, BIN_A.replace("0.16", "0.05"))],
            TO_BIN,
            "40 x 40 mm do not fit into lab:Bin-A, which is 42 x 42 mm: with room for the hand they need",
        ),
        (
            [(BIN_A, BIN_A.replace("0.16", "0.12").replace("SizeZ 0.06", "SizeZ 0.12"))],
            TO_BIN,
            "40 x 40 mm do not fit into lab:Bin-A, which is 112 x 112 mm: with room for the hand they need",
        ),
        (
            [(BIN_A, BIN_A.replace("0.16", "0.13")),
             ("PositionX 0.5 ; skiros:PositionY -0.2 ; skiros:PositionZ 0.635",
              "PositionX 0.45 ; skiros:PositionY 0.15 ; skiros:PositionZ 0.639")],
            TO_BIN,
            "lab:Bin-A is full: no place of 40 x 40 mm is free",
        ),
        (
            [(BIN_A, "lab:Bin-A a sorting:Bin ;")],
            TO_BIN,
            "lab:Bin-A has no size, and contains nothing that could carry lab:Part-A",
        ),
        (
            [("skiros:PositionX 0.45 ; skiros:PositionY 0.15 ;", "skiros:PositionX 1.45 ; skiros:PositionY 0.15 ;")],
            TO_BIN,
            "no free place on lab:Bin-A is within the 0.85 m that lab:Panda-1 reaches",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_placed_is_said_with_numbers(
    edits: list[tuple[str, str]], calls: list[str], why: str, tmp_path: Path
) -> None:
    assert why in failure_of(carry_out(written(tmp_path, edits), calls, KinematicCell))


def test_a_carton_almost_as_wide_as_the_fingers_open_is_picked(tmp_path: Path) -> None:
    wide = [(A_SIZE, "skiros:SizeX 0.07 ; skiros:SizeY 0.07 ; skiros:SizeZ 0.06 ; skiros:Weight 0.15")]
    ended = carry_out(written(tmp_path, wide), [PICK_A], KinematicCell)
    assert isinstance(ended, Execution) and ended.status == "succeeded", ended
