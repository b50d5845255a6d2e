"""What the world model says of a robot that drives."""

from __future__ import annotations

from functools import cache

from cells import LAB, world

from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, find_library
from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import Individual
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.selection.select import NoneSelected, select_implementation
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import AT

ROBOT, DOCK, STORE = LAB + "Heron-1", LAB + "Dock", LAB + "Store"


@cache
def library() -> SkillLibrary:
    return compile_valid(find_library(SHIPPED / "wiping"))


def test_a_drive_halted_half_way_has_left_and_not_arrived() -> None:
    cell = SimulatedCell(WorldModel(world("ur5e_whiteboard")))
    drive = tree.Call(
        skill="Drive",
        implementation=None,
        arguments={"robot": Individual(ROBOT), "to": Individual(STORE)},
        out=None,
        source=Position("task.skill", 3, 1),
    )
    run = TreeRun(drive, library(), cell)
    started = cell.base(ROBOT).pose.position
    while abs(cell.base(ROBOT).pose.position - started).max() < 0.05:
        assert run.tick() is Status.RUNNING
        cell.advance(0.05)
    run.halt("enough")
    assert cell.world.snapshot().objects(ROBOT, AT) == frozenset()


def test_nobody_drives_to_where_the_robot_is() -> None:
    result = select_implementation(library(), "Drive", {"robot": ROBOT, "to": DOCK}, world("ur5e_whiteboard"))
    assert isinstance(result, NoneSelected)
    assert "not from == to" in result.rejected[0].reason, result.rejected[0].reason
