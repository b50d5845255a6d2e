"""What a device can never do is refused before anything moves: targets outside a workspace, too much speed or force."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner
from msgspec import structs

from skillc.cli.main import skillc
from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_dsl.position import Position
from skillc_model import skills as model
from skillc_model import tree
from skillc_model.conditions import Expression, Individual, Invoke, Literal, PropertyOf
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.devices.cell import Cell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, NotStarted, PreparedTask
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.primitive import Primitive, Status
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.data_sheet import sheet_of
from skillc_runtime.world.state.terms import FRAME_ID, GRASP_WIDTH, HAS_WORKSPACE, SIZE, SKILLC
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
ARMS = {"clean_table": LAB + "Iiwa-1", "clean_desk": LAB + "Panda-1", "clean_whiteboard": LAB + "Ur5e-1"}
HERE = Position("body.skill", 1, 1)


@cache
def library() -> SkillLibrary:
    outcome = libraries.compile_library(find_library(SHIPPED / "wiping"))
    assert outcome.ok
    return outcome.value


def scene(task: str, *changes: Change) -> WorldState:
    name = library().tasks[task].scene
    assert name is not None
    return load_scene(catalogue.scene_path(name), library().vocabulary).with_changes(changes)


def workspace(
    arm: str, middle: tuple[float, float, float], size: tuple[float, float, float], frame: str = "map"
) -> list[Change]:
    """Say that the tool of an arm stays in a box."""
    box = LAB + "Box"
    sizes = [SetProperty(box, name, value) for name, value in zip(SIZE, size, strict=True)]
    kind = [AddIndividual(box, (SKILLC + "Workspace",)), SetProperty(box, FRAME_ID, "box")]
    return [*kind, *placement_changes(box, Pose.of(middle), frame), *sizes, AddRelation(arm, HAS_WORKSPACE, box)]


def prepare(task: str, *changes: Change) -> PreparedTask | NotStarted:
    goal = library().tasks[task].goal
    assert goal is not None
    return prepare_task(Assignment(task, scene(task, *changes), AchieveGoal(goal)), library())


def refusals(task: str, body: tree.Node, *changes: Change) -> list[str]:
    return [str(each) for each in preflight(body, library(), scene(task, *changes))]


def call(skill: str, **arguments: Expression) -> tree.Call:
    return tree.Call(skill=skill, implementation=None, arguments=arguments, out=None, source=HERE)


def seq(*children: tree.Node) -> tree.Sequence:
    return tree.Sequence(children=children, reactive=False, source=HERE)


def par(*children: tree.Node) -> tree.Parallel:
    return tree.Parallel(policy="all", children=children, source=HERE)


@pytest.mark.parametrize("task", ["clean_table", "clean_desk"])
def test_targets_and_paths_outside_the_workspace_are_refused_with_their_places(task: str) -> None:
    refused = prepare(task, *workspace(ARMS[task], (0.0, -0.2, 0.0), (1.0, 0.7, 4.0)))
    assert isinstance(refused, NotStarted)
    short = library().vocabulary.short(ARMS[task])
    refusal = rf"wipe.skill:\d+: FollowPath: `path` is up to \d+ mm outside the workspace of {short}, at \(0\..*\) m"
    assert re.search(
        refusal + r" in the frame 'map', which is \(.*\) m on lab:\w+-1 \(in Wipe\[wipe_lanes\]\)", refused.reason
    )
    assert "Pick" not in refused.reason, "the eraser is inside"


@pytest.mark.slow
@pytest.mark.parametrize("task", sorted(ARMS))
def test_a_workspace_that_holds_everything_refuses_nothing(task: str) -> None:
    assert isinstance(prepare(task), PreparedTask)
    assert isinstance(prepare(task, *workspace(ARMS[task], (0.0, 0.0, 0.0), (9.0, 9.0, 4.0))), PreparedTask)


def test_the_workspace_of_a_mobile_robot_is_where_it_will_stand() -> None:
    ahead, behind = (0.8, 0.0, 0.8), (-0.8, 0.0, 0.8)
    room = (1.4, 2.0, 1.6)
    task = "clean_whiteboard"
    assert isinstance(prepare(task, *workspace(ARMS[task], ahead, room, "heron")), PreparedTask)
    refused = prepare(task, *workspace(ARMS[task], behind, room, "heron"))
    assert isinstance(refused, NotStarted)
    assert "outside the workspace of lab:Ur5e-1" in refused.reason
    assert "on lab:Whiteboard-1" in refused.reason


class Anything(Primitive):
    """A primitive that does not declare what it moves, in the place of the one that inspects a surface."""

    def __init__(self, cell: Cell, *, surface: str) -> None:
        super().__init__(cell)

    def tick(self) -> Status:
        return Status.SUCCESS


class Careless(Anything):
    """A primitive whose check raises what no check should."""

    @classmethod
    def find_problem(cls, arguments: Mapping[str, Value], state: WorldState) -> str | None:
        raise ZeroDivisionError("too careless")


def library_with(primitive: str) -> SkillLibrary:
    """Return the library with another primitive for `Inspect`."""
    name = "Inspect.by_camera"
    other = structs.replace(library().implementations[name], body=model.Primitive(f"{__name__}:{primitive}"))
    return structs.replace(library(), implementations={**library().implementations, name: other})


TABLE, IIWA, ERASER = (Individual(LAB + name) for name in ("Table-1", "Iiwa-1", "Eraser-1"))
NARROW = workspace(IIWA.iri, (0.0, 0.0, 0.0), (0.5, 0.5, 4.0))
OUTSIDE = Invoke(function="centre", arguments=(TABLE,))
GO = call("MoveLinear", arm=IIWA, target=OUTSIDE)
ANYTHING = call("Inspect", surface=TABLE)
PICK = call("Pick", arm=IIWA, object=ERASER)
TO_ERASER = call("MoveLinear", arm=IIWA, target=PropertyOf(of=ERASER, property=SKILLC + "pose"))


def in_narrow(body: tree.Node, primitive: str = "Anything") -> list[str]:
    return [str(each) for each in preflight(body, library_with(primitive), scene("clean_table", *NARROW))]


@pytest.mark.parametrize(
    ("body", "count"),
    [
        (GO, 1),
        (seq(GO, GO), 2),
        (seq(GO, ANYTHING), 1),
        (par(GO, GO), 2),
        (tree.Retry(count=3, child=GO, source=HERE), 1),
        (tree.Selector(children=(GO, GO), reactive=False, source=HERE), 2),
    ],
)
def test_targets_are_refused_as_long_as_nothing_may_have_moved_them(body: tree.Node, count: int) -> None:
    found = in_narrow(body)
    assert len(found) == count
    assert all("`target` is up to 310 mm outside the workspace of lab:Iiwa-1, at (0.560" in each for each in found)


@pytest.mark.parametrize(
    "body",
    [
        seq(ANYTHING, GO),
        par(ANYTHING, GO),
        par(GO, seq(ANYTHING)),
        tree.Retry(count=3, child=seq(GO, ANYTHING), source=HERE),
        seq(tree.Try(child=ANYTHING, source=HERE), GO),
        seq(tree.Selector(children=(ANYTHING, ANYTHING), reactive=False, source=HERE), GO),
        tree.Selector(children=(GO, ANYTHING), reactive=False, source=HERE),
        tree.Try(child=GO, source=HERE),
    ],
)
def test_what_may_have_been_moved_is_not_refused(body: tree.Node) -> None:
    assert in_narrow(body) == []


def test_a_picked_thing_is_somewhere_else_afterwards() -> None:
    (refused,) = in_narrow(TO_ERASER)
    assert "outside the workspace" in refused
    wide = workspace(IIWA.iri, (0.0, 0.0, 0.0), (9.0, 9.0, 4.0))
    assert refusals("clean_table", seq(PICK, TO_ERASER), *wide) == []
    assert not any("body.skill" in each for each in in_narrow(seq(PICK, TO_ERASER))), (
        "only the steps of Pick are refused"
    )


def test_a_check_that_breaks_is_a_refusal_that_says_so() -> None:
    (refused,) = in_narrow(ANYTHING, "Careless")
    assert "Careless.find_problem fails: ZeroDivisionError: too careless" in refused


def sheet(task: str, device: str, name: str, value: float) -> Change:
    return SetProperty(sheet_of(scene(task), LAB + device).individual, SKILLC + name, value)


def test_arguments_beyond_the_limits_of_a_device_are_refused() -> None:
    fast = call("MoveLinear", arm=IIWA, target=OUTSIDE, speed=Literal(0.3))
    (refused,) = refusals("clean_table", fast, sheet("clean_table", "Iiwa-1", "speedLimit", 0.2))
    assert "MoveLinear: `speed` is 0.3 m/s, more than the 0.2 m/s that lab:Iiwa-1 allows" in refused
    assert refusals("clean_table", fast, sheet("clean_table", "Iiwa-1", "speedLimit", 0.3)) == []


def test_a_force_that_is_a_fact_is_refused_beyond_the_limit_of_the_arm() -> None:
    refused = prepare("clean_table", sheet("clean_table", "Iiwa-1", "forceLimit", 10.0))
    assert isinstance(refused, NotStarted)
    assert "Push: `force` is 18 N, more than the 10 N that lab:Iiwa-1 allows" in refused.reason


def test_a_thing_that_is_wider_than_the_fingers_can_open_is_refused() -> None:
    refused = prepare("clean_table", SetProperty(LAB + "Eraser-1", GRASP_WIDTH, 0.16))
    assert isinstance(refused, NotStarted)
    assert "lab:Eraser-1 is 160 mm wide between the fingers, and lab:Robotiq-1 takes at most 149 mm" in refused.reason


BOX = """
lab:Iiwa-1 skillc:hasWorkspace lab:Box .
lab:Box a skillc:Workspace ; skiros:SizeX 1.0 ; skiros:SizeY 0.7 ; skiros:SizeZ 3.0 ;
    skiros:FrameId "box" ; skiros:BaseFrameId "map" ;
    skiros:PositionX 0.3 ; skiros:PositionY {y} ; skiros:PositionZ 1.1 ;
    skiros:OrientationW 1.0 ; skiros:OrientationX 0.0 ; skiros:OrientationY 0.0 ; skiros:OrientationZ 0.0 .
"""


@pytest.mark.parametrize(
    ("y", "why"),
    [
        (
            -0.25,
            r"FollowPath: `path` is up to 124 mm outside the workspace of lab:Iiwa-1, at \(0.423, 0.224, 0.750\) m",
        ),
        (-2.5, r"Pick\[from_above\]"),
    ],
)
def test_a_run_outside_the_workspace_is_refused(y: float, why: str, tmp_path: Path) -> None:
    cell = tmp_path / "cell.ttl"
    cell.write_text(catalogue.scene_path("iiwa_table").read_text("utf-8") + BOX.format(y=y), "utf-8")
    asked = ("run", "--library", "wiping", "--scene", str(cell), "--goal", "lab:Table-1.isClean == true")
    result = CliRunner().invoke(skillc, asked)
    assert result.exit_code == 3
    assert re.search(why, " ".join(result.stdout.split())), result.stdout
    assert "refused" in result.stdout
