"""Where the first grasp fails, another one is tried; where none is possible, the part stays and a sentence says why."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import numpy as np
import pytest

from bodies.test_own_cells import A_SIZE, CELLS, LAB, PICK_A, carry_out, failure_of, library, place, written
from skillc_compiler.goals.parsing import parse_call
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.recording.events import Event, NodeEnded
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.space.grasping.grasps import find_grasp, grasp_problem
from skillc_runtime.world.space.grasping.grip_force import GraspError
from skillc_runtime.world.state.model import WorldModel

PART, HAND, BLOCKS = LAB + "Part-A", LAB + "Hand-1", [f"Block-{n}" for n in range(1, 5)]
A_PLACE = "skiros:PositionX 0.45 ; skiros:PositionY -0.35 ; skiros:PositionZ 0.63 ."
A_TRAY = (
    "lab:Bin-A a sorting:Bin ;\n    skiros:SizeX 0.16 ; skiros:SizeY 0.16 ; skiros:SizeZ 0.06 ;",
    'lab:Bin-A a sorting:Bin ; skillc:shape "box" ;\n    skiros:SizeX 0.2 ; skiros:SizeY 0.2 ; skiros:SizeZ 0.06 ;',
)

T_PROFILE = [(-0.06, 0.08), (-0.015, 0.08), (-0.015, -0.1), (0.015, -0.1), (0.015, 0.08), (0.06, 0.08), (0.06, 0.1)]


def write_t(path: Path) -> Path:
    """Write a mesh: a lid of 120 x 90 mm on a wall that is 30 mm thick."""
    profile = [*T_PROFILE, (-0.06, 0.1)]
    count = len(profile)
    lines = [f"v {x} {y} {z}" for y in (-0.045, 0.045) for x, z in profile]
    caps = [(3, 4, 5, 2), (1, 2, 5, 6), (1, 6, 7, 8)]
    faces = [*caps, *(tuple(each + count for each in reversed(cap)) for cap in caps)]
    faces += [(j % count + 1, j, j + count, j % count + 1 + count) for j in range(1, count + 1)]
    path.write_text("\n".join([*lines, *("f " + " ".join(map(str, face)) for face in faces)]), encoding="utf-8")
    return path


def with_blocks(*facts: str) -> list[tuple[str, str]]:
    """Return the edits that add blocks of 30 x 30 x 60 mm, which are believed to stand far from the part."""
    names = ", ".join(f"lab:{name}" for name in BLOCKS)
    block = (
        "lab:{0} a sorting:WorkPart ; skiros:SizeX 0.03 ; skiros:SizeY 0.03 ; skiros:SizeZ 0.06 ; skiros:Weight 1.5 ;\n"
        '    skiros:FrameId "{0}" ; skiros:BaseFrameId "map" ;\n'
        "    skiros:PositionX {1} ; skiros:PositionY 0.55 ; skiros:PositionZ 0.63 .\n\n"
    )
    blocks = "".join(block.format(name, 0.35 + 0.1 * n) for n, name in enumerate(BLOCKS))
    return [("lab:Part-A, lab:Part-B .", f"lab:Part-A, lab:Part-B, {names} ."), ("lab:Bin-A a", blocks + "lab:Bin-A a")]


def picked_between(scene: Path, offsets: list[tuple[float, float]]) -> tuple[Execution, list[str]]:
    """Pick the part while blocks really stand at offsets in m from it; return also what failed."""
    compiled = library()
    cell = SimulatedCell(WorldModel(load_scene(scene, compiled.vocabulary)))
    for name, (x, y) in zip(BLOCKS, offsets, strict=False):
        first = cell.model.joint(cell.scene.names[LAB + name] + "/free").qposadr[0]
        cell.data.qpos[first : first + 2] = (0.45 + x, -0.35 + y)
    now = cell.world.snapshot()
    individuals = {each: sorted(now.types(each)) for each in now.individuals}
    call = parse_call(PICK_A, compiled, individuals, now.vocabulary.prefixes)
    assert call.value is not None
    prepared = prepare_task(Assignment("move", now, ExecuteBody(call.value)), compiled)
    assert isinstance(prepared, PreparedTask), prepared
    events = list[Event]()
    ended = execute_task(prepared, compiled, cell, [events.append])
    return ended, [each.name for each in events if isinstance(each, NodeEnded) and each.failure is not None]


@pytest.mark.sim
def test_where_a_block_that_nobody_knows_of_keeps_the_fingers_off_they_close_across(tmp_path: Path) -> None:
    slim = (A_SIZE, A_SIZE.replace("SizeX 0.04", "SizeX 0.05"))
    ended, failed = picked_between(written(tmp_path, [slim, *with_blocks()]), [(0.0, 0.047), (0.0, -0.047)])
    assert ended.status == "succeeded", ended.failure
    assert "MoveLinear" in failed
    assert ended.backend.ground_truth.carried_by(HAND) == PART


@pytest.mark.sim
def test_where_blocks_stand_on_all_sides_the_part_is_left_with_a_reason(tmp_path: Path) -> None:
    around = [(0.0, 0.042), (0.0, -0.042), (0.042, 0.0), (-0.042, 0.0)]
    ended, _ = picked_between(written(tmp_path, with_blocks()), around)
    assert ended.status == "failed" and ended.failure is not None
    tried = {each.alternative for each in ended.failure.causes}
    assert tried >= {"Pick[from_above]", "Pick[across]", "Pick[from_side]"}
    assert "touches something at a height of" in ended.failure.message
    assert ended.backend.ground_truth.carried_by(HAND) is None
    left = ended.backend.ground_truth.body_pose(PART)
    ended.backend.advance(0.5)
    now = ended.backend.ground_truth.body_pose(PART)
    assert np.linalg.norm(now.position - left.position) < 0.001
    assert now.position[2] == pytest.approx(0.63, abs=0.005)


@pytest.mark.slow
@pytest.mark.parametrize("backend", [pytest.param(SimulatedCell, marks=pytest.mark.sim), KinematicCell])
def test_a_thing_with_a_wide_lid_is_held_from_the_side_and_put_down_upright(
    backend: type[SimulatedCell | KinematicCell], tmp_path: Path
) -> None:
    pytest.importorskip("coacd", reason="the extra `meshes` is not installed")
    mesh = write_t(tmp_path / "t.obj")
    shape = (
        "skiros:SizeX 0.12 ; skiros:SizeY 0.09 ; skiros:SizeZ 0.2 ; skiros:Weight 0.2 ;\n"
        f'    skillc:shape "mesh" ; skillc:mesh "{mesh}"'
    )
    stands = "skiros:PositionX 0.45 ; skiros:PositionY -0.3 ; skiros:PositionZ 0.7 ; skillc:yaw 60.0 ."
    scene = written(tmp_path, [*CELLS["iiwa"], (A_SIZE, shape), (A_PLACE, stands), A_TRAY])
    ended = carry_out(scene, [PICK_A, place("Part-A", "Bin-A")], backend)
    assert isinstance(ended, Execution) and ended.status == "succeeded", ended
    ended.backend.advance(0.5)
    stands_at = ended.backend.ground_truth.body_pose(PART)
    assert stands_at.position == pytest.approx([0.45, 0.15, 0.76], abs=0.01)
    assert stands_at.rotation[2, 2] > 0.999


@pytest.mark.parametrize("backend", [pytest.param(SimulatedCell, marks=pytest.mark.sim), KinematicCell])
def test_a_box_that_is_known_to_lie_on_its_side_is_picked_and_put_down_as_it_lies(
    backend: type[SimulatedCell | KinematicCell], tmp_path: Path
) -> None:
    tall = (A_SIZE, "skiros:SizeX 0.04 ; skiros:SizeY 0.04 ; skiros:SizeZ 0.09 ; skiros:Weight 0.15")
    lies = A_PLACE[: A_PLACE.index("0.63")] + "0.62 ; skillc:roll 90.0 ; skillc:yaw 30.0 ."
    scene = written(tmp_path, [tall, (A_PLACE, lies), A_TRAY])
    ended = carry_out(scene, [PICK_A, place("Part-A", "Bin-A")], backend)
    assert isinstance(ended, Execution) and ended.status == "succeeded", ended
    ended.backend.advance(0.5)
    there = ended.backend.ground_truth.body_pose(PART)
    assert abs(there.rotation[2, 2]) < 0.05
    assert there.position == pytest.approx([0.45, 0.15, 0.68], abs=0.01)


def deep(side_m: float, edits: list[tuple[str, str]]) -> list[tuple[str, str]]:
    """Return the edits that put the part into a bin 200 mm deep."""
    size = f"skiros:SizeX {side_m} ; skiros:SizeY {side_m} ; skiros:SizeZ 0.2 ;"
    small = "skiros:SizeX 0.16 ; skiros:SizeY 0.16 ; skiros:SizeZ 0.06 ;"
    frame, spot = '\n    skiros:FrameId "bin_a"', "skiros:PositionX 0.45 ; skiros:PositionY 0.15 ; skiros:PositionZ"
    a_bin, at = (small + frame, size + frame), (f"{spot} 0.63", f"{spot} 0.7")
    part = (A_PLACE, "skiros:PositionX 0.45 ; skiros:PositionY 0.15 ; skiros:PositionZ 0.634 .")
    return [*edits, a_bin, at, part]


@pytest.mark.slow
def test_a_part_in_a_deep_bin_is_grasped_where_the_hand_has_room_else_refused(tmp_path: Path) -> None:
    wide = written(tmp_path, deep(0.26, []))
    assert grasp_problem(load_scene(wide, library().vocabulary), HAND, PART) is None
    ended = carry_out(wide, [PICK_A], KinematicCell)
    assert isinstance(ended, Execution) and ended.status == "succeeded", ended
    narrow = written(tmp_path, deep(0.15, []))
    assert "lab:Bin-A is in the way of lab:Hand-1 around lab:Part-A" in failure_of(
        carry_out(narrow, [PICK_A], KinematicCell)
    )


@pytest.mark.parametrize(
    ("beside_m", "opening_m", "closes_along"),
    [(0.12, 0.08, 1), (0.066, 0.056, 1), (0.056, 0.08, 0)],
    ids=["room", "little room", "none"],
)
def test_fingers_open_less_or_close_across_beside_what_is_known_to_stand_there(
    beside_m: float, opening_m: float, closes_along: int, tmp_path: Path
) -> None:
    slim = (A_SIZE, A_SIZE.replace("SizeX 0.04", "SizeX 0.05"))
    state = load_scene(written(tmp_path, [slim, *with_blocks()]), library().vocabulary)
    beside = placement_changes(LAB + BLOCKS[0], Pose.of((0.45, -0.35 + beside_m, 0.63)))
    grasp = find_grasp(state.with_changes(list(beside)), HAND, PART, "above")
    assert grasp.opening_m == pytest.approx(opening_m)
    assert abs(grasp.tool.rotation[closes_along, 1]) == pytest.approx(1.0)


def test_under_a_board_a_part_is_grasped_from_the_side(tmp_path: Path) -> None:
    board = (
        'lab:Board a skillc:Furniture ; skiros:FrameId "board" ; skiros:BaseFrameId "map" ;\n'
        "    skiros:SizeX 0.3 ; skiros:SizeY 0.3 ; skiros:SizeZ 0.02 ;\n"
        "    skiros:PositionX 0.45 ; skiros:PositionY -0.35 ; skiros:PositionZ 0.85 .\n\nlab:Bin-A a"
    )
    tall = (A_SIZE, "skiros:SizeX 0.04 ; skiros:SizeY 0.04 ; skiros:SizeZ 0.16 ; skiros:Weight 0.15")
    stands = (A_PLACE, A_PLACE.replace("PositionZ 0.63", "PositionZ 0.68"))
    named = ("lab:Part-A, lab:Part-B .", "lab:Part-A, lab:Part-B, lab:Board .")
    scene = written(tmp_path, [("lab:Bin-A a", board), tall, stands, named])
    state = load_scene(scene, library().vocabulary)
    with pytest.raises(GraspError, match="lab:Board is in the way of lab:Hand-1 around lab:Part-A"):
        find_grasp(state, HAND, PART, "above")
    assert grasp_problem(state, HAND, PART) is None
    assert abs(find_grasp(state, HAND, PART, "side").tool.rotation[2, 2]) < 1e-9


@pytest.mark.parametrize("tilt", ["pitch 10", "roll -10"])
@pytest.mark.parametrize("way", ["above", "side"])
def test_fingers_close_across_the_axis_of_a_cylinder_that_leans_where_it_is_as_wide_as_it_is_thick(
    way: Literal["above", "side"], tilt: str, tmp_path: Path
) -> None:
    round_ = (A_SIZE, 'skillc:shape "cylinder" ; skiros:SizeX 0.035 ; skiros:SizeY 0.035 ; skiros:SizeZ 0.12')
    leans = (A_PLACE, A_PLACE.replace("PositionZ 0.63 .", f"PositionZ 0.7 ; skillc:{tilt} ."))
    state = load_scene(written(tmp_path, [round_, leans]), library().vocabulary)
    grasp = find_grasp(state, HAND, PART, way)
    assert grasp.width_m == pytest.approx(0.035)
    assert abs(grasp.tool.rotation[:, 1] @ pose(state, PART).rotation[:, 2]) == pytest.approx(0.0, abs=1e-9)
