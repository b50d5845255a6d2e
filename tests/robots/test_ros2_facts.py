"""How facts become interfaces of ROS 2: the defaults are those of ros2_control, and what contradicts is refused."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robots.ros2.test_link import MODEL_JOINTS, SCENE
from simulation.cells import LAB, vocabulary
from skillc_runtime.backends.ros2.facts import read_arm, read_base, read_camera, read_gripper, read_inspected
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.world_state import WorldState

ARM, HAND = LAB + "Arm-1", LAB + "Hand-1"


def state(more: str, tmp_path: Path) -> WorldState:
    path = tmp_path / "cell.ttl"
    path.write_text(SCENE.read_text("utf-8") + more, "utf-8")
    return load_scene(path, vocabulary())


def test_what_is_not_stated_is_as_in_ros2_control(tmp_path: Path) -> None:
    here = state("", tmp_path)
    arm = read_arm(here, ARM, MODEL_JOINTS, "velocity")
    assert arm.joints == tuple(f"{each}_joint" for each in MODEL_JOINTS), "the data sheet has them"
    assert (arm.states, arm.command) == ("/joint_states", "/forward_velocity_controller/commands")
    assert arm.wrench is not None
    assert (arm.wrench.topic, arm.wrench.sign) == ("/force_torque_sensor_broadcaster/wrench", 1.0)
    assert not (arm.wrench.in_base or arm.wrench.has_weight)
    assert (arm.quality.reliable_states, arm.quality.reliable_commands) == (False, True)
    hand = read_gripper(here, HAND, ("left_finger", "right_finger"))
    assert (hand.command, hand.per_unit, hand.timing.silence_s) == ("/gripper_controller/commands", 2.0, 1.0)
    base = read_base(here, LAB + "Robot-1")
    assert (base.goal, base.odometry, base.frame) == ("/goal_pose", "/odom", "map")


def test_names_without_a_slash_are_below_the_namespace(tmp_path: Path) -> None:
    more = 'lab:Arm-1 ros2:namespace "left/" ; ros2:jointStateTopic "/all" ; ros2:tareService "zero" .'
    arm = read_arm(state(more, tmp_path), ARM, MODEL_JOINTS, "position")
    assert (arm.states, arm.command) == ("/all", "/left/forward_position_controller/commands")
    assert (arm.services.tare, arm.wrench and arm.wrench.topic) == (
        "/left/zero",
        "/left/force_torque_sensor_broadcaster/wrench",
    )


def test_a_law_on_the_robots_side_has_topics_for_its_targets(tmp_path: Path) -> None:
    more = """lab:Arm-1 ros2:targetPoseTopic "goal" ; skiros:CartesianStiffnessTopic "k" ;
        skiros:LinkedToFrameId "arm_base" ; skiros:MoveItTCPLink "gripper_tcp" ; ros2:complianceFrame "flange" ."""
    tool = read_arm(state(more, tmp_path), ARM, MODEL_JOINTS, "position", on_robot=True).tool
    assert tool is not None
    assert (tool.pose, tool.stiffness, tool.wrench, tool.frame) == ("/goal", "/k", "", "arm_base")
    assert (tool.of_flange, tool.along_flange, tool.flange) == (False, True, "tool0")


def test_commands_of_actions_go_to_those_of_ros2_control(tmp_path: Path) -> None:
    more = """lab:Arm-1 skiros:JointConfigurationController "scaled" ;
        ros2:commandType "control_msgs/action/FollowJointTrajectory" .
        lab:Hand-1 ros2:commandType "control_msgs/action/GripperCommand" ."""
    here = state(more, tmp_path)
    assert read_arm(here, ARM, MODEL_JOINTS, "position").command == "/scaled/follow_joint_trajectory"
    hand = read_gripper(here, HAND, ("left_finger", "right_finger"))
    assert (hand.command, hand.opening(0.02), hand.position(0.04)) == ("/gripper_controller/gripper_cmd", 0.04, 0.02)


def test_a_camera_has_frames_and_images_and_none_without_facts(tmp_path: Path) -> None:
    camera = """lab:Camera-1 a skillc:Camera ; skillc:hasSheet skillc:depth-camera-sheet ; skillc:on lab:Cell"""
    assert read_camera(state(camera + " .", tmp_path), LAB + "Camera-1") is None
    more = """ ; skiros:LinkedToFrameId "optical" ; ros2:depthTopic "left/depth/image_raw" .
        lab:Pedestal skiros:LinkedToFrameId "foot" ."""
    found = read_camera(state(camera + more, tmp_path), LAB + "Camera-1")
    assert found is not None
    assert (found.frame, found.frames[LAB + "Pedestal"]) == ("optical", "foot")
    assert (found.image, found.info) == ("", "/left/depth/camera_info")


def test_the_share_of_a_surface_that_is_clean_may_be_as_old_as_its_facts_say(tmp_path: Path) -> None:
    assert read_inspected(state("", tmp_path)) == {}
    size = "skiros:SizeX 1.0 ; skiros:SizeY 1.0 ; skiros:SizeZ 0.1 ; skillc:friction 0.5"
    board = f'lab:Board-1 a skillc:Surface ; skillc:on lab:Cell ; {size} ; ros2:cleanShareTopic "share"'
    for more, fresh_s in ((" .", 5.0), (" ; skillc:stateTimeout 0.5 .", 0.5)):
        found = read_inspected(state(board + more, tmp_path))[LAB + "Board-1"]
        assert (found.topic, found.fresh_s) == ("/share", fresh_s)


@pytest.mark.parametrize(
    ("more", "mode", "on_robot", "words"),
    [
        ('ros2:jointNames "a b c"', "position", False, "has 3 names; its model has 6 joints"),
        ('ros2:jointNames "a b c d e a"', "position", False, "has 5 names"),
        ('ros2:commandType "x/msg/Y"', "position", False, "it is 'std_msgs/msg/Float64MultiArray' or"),
        ('ros2:commandType "trajectory_msgs/msg/JointTrajectory"', "velocity", False, "its controller gives velocity"),
        ('ros2:stateReliability "good"', "position", False, "it is 'reliable' or 'best-effort'"),
        ("ros2:updateRate 100.0", "torque", False, "state with ros2:carriesWeight whether"),
        (
            'skiros:CartesianGoalAction "go"',
            "position",
            True,
            "go (skiros:CartesianGoalAction) moves the tool by itself",
        ),
        ("ros2:updateRate 100.0", "position", True, "state the topic of its target poses as ros2:targetPoseTopic"),
    ],
)
def test_facts_that_contradict_are_refused(more: str, mode: str, on_robot: bool, words: str, tmp_path: Path) -> None:
    text = SCENE.read_text("utf-8").replace("ros2:updateRate 125.0 ;", "")
    path = tmp_path / "cell.ttl"
    path.write_text(f"{text}\nlab:Arm-1 {more} .\n", "utf-8")
    with pytest.raises(SheetError, match=re.escape(words)):
        read_arm(load_scene(path, vocabulary()), ARM, MODEL_JOINTS, mode, on_robot)  # type: ignore[arg-type]


def test_a_gripper_with_one_service_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SheetError, match="needs both ros2:openService and ros2:closeService"):
        read_gripper(state('lab:Hand-1 ros2:openService "open" .', tmp_path), HAND, ("left_finger",))
