"""A camera finds things that lie elsewhere than believed, with errors; what it cannot find is not said to be found."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np
import pytest
from cells import ERASER, LAB, run, world

from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.disturbances import MoveThing
from skillc_runtime.motion.pose import Pose, log, quaternion_from_rotation
from skillc_runtime.primitives.locate import ConfirmPlaced, Locate
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.space.reasoners.can_see import CanSee
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.evidence import DecidingWrite
from skillc_runtime.world.state.facts import PropertyFact, RelationFact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import (
    CAMERA,
    CONTAIN,
    FRAME_ID,
    HAS_SHEET,
    LOCATED,
    POSITION_RANGE,
    SIZE,
    SKILLC,
    SKIROS,
    TURN_RANGE,
)

SCENE, EYE, SHEET, TRAY, SCREEN = (
    "panda_desk",
    LAB + "Camera-1",
    SKILLC + "depth-camera-sheet",
    LAB + "Tray",
    LAB + "Screen",
)
CAN_SEE = SKILLC + "canSee"
OVERHEAD = Pose.of((0.4, -0.45, 1.6), (0.0, 1.0, 0.0, 0.0))
DISPLACED = (SetProperty(ERASER, POSITION_RANGE, 0.02), SetProperty(ERASER, TURN_RANGE, 0.26))


def looking_down(at: tuple[float, float, float]) -> Pose:
    return Pose.of(at, (0.0, 1.0, 0.0, 0.0))


def camera(at: Pose) -> list[Change]:
    return [
        AddIndividual(EYE, (CAMERA,)),
        AddRelation(EYE, HAS_SHEET, SHEET),
        SetProperty(EYE, FRAME_ID, "camera"),
        *placement_changes(EYE, at),
    ]


def seen(seed: int = 0, changes: Sequence[Change] = (), at: Pose = OVERHEAD) -> SimulatedCell:
    """Return a cell with a camera over the table on which the eraser lies, at (0.4, -0.45, 0.715)."""
    return SimulatedCell(WorldModel(world(SCENE).with_changes([*camera(at), *changes])), seed)


def numbers(value: float, *names: str) -> list[Change]:
    return [SetProperty(SHEET, SKILLC + name, value) for name in names]


def true_pose(there: SimulatedCell) -> Pose:
    body = there.data.body(there.scene.names[ERASER] + "/block")
    return Pose(body.xpos.copy(), body.xmat.reshape(3, 3).copy())


def errors(there: SimulatedCell) -> tuple[float, float]:
    """Return by how many m and rad the believed pose of the eraser is wrong."""
    believed, true = pose(there.world.snapshot(), ERASER), true_pose(there)
    return float(np.linalg.norm(believed.position - true.position)), float(
        np.linalg.norm(log(believed.rotation.T @ true.rotation))
    )


def locate(there: SimulatedCell, patience: float = 3.0) -> None:
    run(there, Locate(there, camera=EYE, object=ERASER, patience=patience))


@pytest.mark.parametrize("seed", range(4))
def test_a_thing_that_lies_elsewhere_is_located_within_the_errors_of_the_camera(seed: int) -> None:
    there = seen(seed, DISPLACED)
    before = errors(there)
    locate(there)
    after = errors(there)
    assert before[0] > 0.004 and after[0] < 0.004 < before[0]
    assert after[1] < 0.03
    known = there.world.deciding_write(PropertyFact(ERASER, LOCATED))
    assert isinstance(known, DecidingWrite) and known.evidence == "sensed"
    assert after != pytest.approx((0.0, 0.0), abs=1e-6), "no camera is exact"


def test_things_are_displaced_within_their_ranges_by_the_seed() -> None:
    drawn = [seen(seed, DISPLACED).variation.displacements[0] for seed in range(30)]
    assert drawn[3] == seen(3, DISPLACED).variation.displacements[0]
    shifts, turns = np.array([each.offset_m for each in drawn]), np.array([each.turn_rad for each in drawn])
    assert 0.015 < np.abs(shifts).max() <= 0.02 and 0.2 < np.abs(turns).max() <= 0.26
    assert seen(3).variation.displacements == ()
    assert "lab:Eraser-1 lies " in seen(3, DISPLACED).ground_truth.variation


def test_false_alarms_are_left_out() -> None:
    there = seen(1, [*DISPLACED, *numbers(0.3, "falseAlarmRate")])
    locate(there, patience=5.0)
    assert errors(there)[0] < 0.005


def test_nothing_is_located_where_only_false_alarms_are() -> None:
    there = seen(1, numbers(0.9, "falseAlarmRate"))
    with pytest.raises(SkillFailure, match=r"lab:Camera-1 does not find lab:Eraser-1 within 1.0 s: of \d+ estimates"):
        locate(there, patience=1.0)
    assert there.world.snapshot().value(ERASER, LOCATED) is None


def screen(height: float) -> list[Change]:
    """Return a board of 30 cm, `height` m above the floor over the eraser."""
    sizes = [SetProperty(SCREEN, name, value) for name, value in zip(SIZE, (0.3, 0.3, 0.01), strict=True)]
    kind = [AddIndividual(SCREEN, (SKILLC + "Furniture",)), SetProperty(SCREEN, FRAME_ID, "screen")]
    return [*kind, *sizes, *placement_changes(SCREEN, Pose.of((0.4, -0.45, height)))]


def test_what_is_hidden_is_not_found_and_what_is_behind_does_not_hide() -> None:
    with pytest.raises(SkillFailure, match="of 0 estimates 0 agree"):
        locate(seen(0, [*screen(1.2), *numbers(0.0, "falseAlarmRate")]), patience=1.0)
    locate(seen(0, [*screen(0.3), *numbers(0.0, "falseAlarmRate")]), patience=1.0)


def carried_off(there: SimulatedCell) -> SimulatedCell:
    """Take the eraser out of view."""
    first = there.model.joint(there.scene.names[ERASER] + "/free").qposadr[0]
    there.data.qpos[first : first + 3] = (-1.5, 0.0, 0.1)
    mujoco.mj_forward(there.model, there.data)
    return there


def test_a_camera_that_sees_past_where_a_thing_should_be_knows_that_it_is_not_there() -> None:
    there = carried_off(seen(0, numbers(0.0, "falseAlarmRate")))
    with pytest.raises(SkillFailure, match="lab:Camera-1 sees that lab:Eraser-1 is not where it is believed to be"):
        locate(there, patience=1.0)
    assert there.world.snapshot().value(ERASER, LOCATED) is False


@pytest.mark.parametrize("changes", [screen(1.2), numbers(1.0, "dropoutRate")], ids=["hidden", "without images"])
def test_a_camera_that_cannot_see_the_place_does_not_know_what_is_there(changes: list[Change]) -> None:
    there = carried_off(seen(0, [*changes, *numbers(0.0, "falseAlarmRate")]))
    with pytest.raises(SkillFailure, match="does not find lab:Eraser-1"):
        locate(there, patience=1.0)
    assert there.world.snapshot().value(ERASER, LOCATED) is None


@pytest.mark.parametrize(
    ("at", "words"),
    [
        ((0.4, -0.45, 0.9), "the camera sees from 0.30 m to 2.50 m"),
        ((0.4, -0.45, 4.0), "it is 3.29 m away"),
        ((1.2, -0.45, 1.6), "off the camera's axis, the camera sees up to 34 deg"),
    ],
)
def test_what_is_out_of_view_is_not_seen_and_the_relation_says_why(at: tuple[float, float, float], words: str) -> None:
    there = seen(0, numbers(0.0, "falseAlarmRate"), looking_down(at))
    state = there.world.snapshot()
    assert not state.holds(EYE, CAN_SEE, ERASER)
    assert words in (CanSee().obstacle(state, EYE, ERASER) or "")
    with pytest.raises(SkillFailure, match="of 0 estimates"):
        locate(there, patience=1.0)
    assert seen().world.snapshot().holds(EYE, CAN_SEE, ERASER)


def test_estimates_are_as_old_as_the_camera_is_slow_and_follow_from_the_seed() -> None:
    def found(seed: int) -> list[float]:
        there, places = seen(seed), []
        device = there.pose_camera(EYE)
        for _ in range(100):
            estimate = device.locate(ERASER, 0.0)
            if estimate is not None:
                places.append(estimate.pose.position[0])
                assert there.now - estimate.taken_s >= 0.15 - 1e-6
            there.advance(0.01)
        return places

    assert found(2) == found(2) != found(3)
    assert 5 < len(set(found(2))) < 12, "one each 0.1 s"


def test_an_image_from_before_is_not_used() -> None:
    there = seen(0, numbers(0.0, "falseAlarmRate"))
    locate(there)
    joint = there.model.joint(there.scene.names[ERASER] + "/free").qposadr[0]
    there.data.qpos[joint] += 0.08
    there.advance(0.01)
    locate(there)
    assert errors(there)[0] < 0.004


def tray(at: tuple[float, float, float]) -> list[Change]:
    sizes = [SetProperty(TRAY, name, value) for name, value in zip(SIZE, (0.2, 0.2, 0.02), strict=True)]
    kind = [AddIndividual(TRAY, (SKIROS + "Location",)), SetProperty(TRAY, FRAME_ID, "tray")]
    return [*kind, *sizes, *placement_changes(TRAY, Pose.of(at))]


def confirm(there: SimulatedCell) -> None:
    run(there, ConfirmPlaced(there, camera=EYE, object=ERASER, place=TRAY, patience=3.0))


def test_what_lies_in_a_place_is_sensed_to_be_there() -> None:
    there = seen(0, tray((0.42, -0.45, 0.69)))
    confirm(there)
    known = there.world.deciding_write(RelationFact(TRAY, CONTAIN, ERASER))
    assert known is not None and known.evidence == "sensed"


@pytest.mark.parametrize(
    ("at", "words"),
    [
        ((0.62, -0.45, 0.69), r"its middle is 1[12].\d cm beside lab:Tray"),
        ((0.40, -0.45, 0.60), r"its lowest point is \d.\d cm above lab:Tray"),
        ((0.40, -0.45, 0.80), r"its lowest point is \d.\d cm below lab:Tray"),
    ],
)
def test_what_lies_elsewhere_is_not_said_to_be_there(at: tuple[float, float, float], words: str) -> None:
    there = seen()
    there.world.commit(tray(at), "somebody")  # now, so that it does not hide the eraser
    there.world.commit([AddRelation(LAB + "Cell", CONTAIN, TRAY), AddRelation(TRAY, CONTAIN, ERASER)], "somebody")
    with pytest.raises(SkillFailure, match="lab:Eraser-1 is not where it was put: " + words):
        confirm(there)
    assert not there.world.snapshot().holds(TRAY, CONTAIN, ERASER), "it was retracted"
    assert there.world.snapshot().holds(LAB + "Cell", CONTAIN, ERASER)
    assert there.world.snapshot().value(ERASER, LOCATED) is True, "it was seen, elsewhere"


def test_what_a_camera_sees_to_be_gone_is_not_believed_in_its_place_any_more() -> None:
    there = seen(0, [*tray((0.42, -0.45, 0.69)), *numbers(0.0, "falseAlarmRate")])
    there.world.commit([AddRelation(LAB + "Cell", CONTAIN, TRAY), AddRelation(TRAY, CONTAIN, ERASER)], "Release")
    carried_off(there)
    with pytest.raises(SkillFailure, match="does not find it elsewhere") as failed:
        confirm(there)
    assert failed.value.withdrawn == ("`lab:Tray contain lab:Eraser-1` (assumed by Release)",)
    assert there.world.snapshot().subjects(CONTAIN, ERASER) == {LAB + "Cell"}, "where it can be looked for"
    lost = there.world.deciding_write(RelationFact(TRAY, CONTAIN, ERASER, holds=False))
    assert lost is not None and lost.evidence == "sensed"
    assert lost.origin.startswith("ConfirmPlaced: lab:Camera-1 sees that lab:Eraser-1 is not where it is believed")


def test_what_is_seen_beside_its_place_is_not_in_there_whoever_looks() -> None:
    there = seen(0, tray((0.42, -0.45, 0.69)))
    there.world.commit([AddRelation(LAB + "Cell", CONTAIN, TRAY), AddRelation(TRAY, CONTAIN, ERASER)], "Release")
    move(there, -0.15)
    locate(there)
    assert there.world.snapshot().subjects(CONTAIN, ERASER) == {LAB + "Cell"}
    move(there, -0.03)
    locate(there)
    assert there.world.snapshot().subjects(CONTAIN, ERASER) == {LAB + "Cell"}, "an area contains it wherever it lies"


def move(there: SimulatedCell, by_m: float) -> None:
    there.disturber.disturb(MoveThing(ERASER, (by_m, 0.0, 0.0)))


@pytest.mark.parametrize("by_m", [0.08, 1.5], ids=["in view", "out of view"])
def test_images_of_before_it_was_moved_decide_nothing(by_m: float) -> None:
    there = seen(0, numbers(0.0, "falseAlarmRate", "missRate", "dropoutRate"))
    looking = Locate(there, camera=EYE, object=ERASER, patience=2.0)
    looking.start()
    while there.now < 0.35:  # three or four images
        assert looking.tick() is Status.RUNNING
        there.advance(0.01)
    move(there, by_m)
    try:
        while looking.tick() is Status.RUNNING:
            there.advance(0.01)
    except SkillFailure as failure:
        assert by_m > 1 and "sees that lab:Eraser-1 is not where it is believed" in str(failure)
    else:
        assert by_m < 1 and errors(there)[0] < 0.005


def test_a_place_without_a_size_cannot_be_confirmed() -> None:
    there = seen(0, [AddIndividual(TRAY, (SKIROS + "Location",)), *placement_changes(TRAY, Pose.of((0.4, -0.45, 0.7)))])
    with pytest.raises(SkillFailure, match="lab:Tray"):
        confirm(there)


def test_a_camera_of_a_kinematic_cell_has_no_errors_and_what_it_sees_is_idealised() -> None:
    there = KinematicCell(WorldModel(world(SCENE).with_changes([*camera(OVERHEAD)])))
    before = pose(there.world.snapshot(), ERASER)
    run(there, Locate(there, camera=EYE, object=ERASER, patience=3.0))  # type: ignore[arg-type]
    after = pose(there.world.snapshot(), ERASER)
    assert np.allclose(after.position, before.position, atol=1e-9)
    assert np.allclose(quaternion_from_rotation(after.rotation), quaternion_from_rotation(before.rotation), atol=1e-9)
    known = there.world.deciding_write(PropertyFact(ERASER, LOCATED))
    assert known is not None and known.evidence == "idealised"


def test_a_camera_that_a_robot_moves_is_refused() -> None:
    changes = [*camera(Pose.of((0.0, 0.0, 1.5))), *placement_changes(EYE, Pose.of((0.0, 0.0, 1.5)), "heron")]
    state = world("ur5e_whiteboard").with_changes(changes)
    with pytest.raises((SheetError, FrameError), match="lab:Camera-1 moves with lab:Heron-1; only cameras that stand"):
        SimulatedCell(WorldModel(state))


def test_a_camera_that_the_cell_does_not_have_is_named_with_those_that_it_has() -> None:
    with pytest.raises(KeyError, match="the cell has no camera lab:Eraser-1; it has lab:Camera-1"):
        seen().pose_camera(ERASER)
