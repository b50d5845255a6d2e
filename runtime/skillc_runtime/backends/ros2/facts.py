"""Reads by which topics and services ROS 2 drives the devices of a cell, with the defaults of ros2_control."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from skillc_runtime.backends.ros2.device_facts import DeviceFacts, Quality, Timing
from skillc_runtime.devices.arm import Mode
from skillc_runtime.world.space.frame_tree import WORLD_FRAME
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.terms import FORCE_TORQUE_SENSOR, HAS_SENSOR, SKIROS, SURFACE
from skillc_runtime.world.state.world_state import WorldState

ARRAY, TRAJECTORY = "std_msgs/msg/Float64MultiArray", "trajectory_msgs/msg/JointTrajectory"
FOLLOW = "control_msgs/action/FollowJointTrajectory"
GRIP, GRIP_BY_NAMES = "control_msgs/action/GripperCommand", "control_msgs/action/ParallelGripperCommand"
ENDINGS: Final[Mapping[str, str]] = {
    ARRAY: "commands",
    TRAJECTORY: "joint_trajectory",
    FOLLOW: "follow_joint_trajectory",
}
"""The types of commands of an arm, with the names below its controller of the topic or action that takes them."""
CONTROLLERS: Final[Mapping[Mode, str]] = {
    "position": "forward_position_controller",
    "velocity": "forward_velocity_controller",
    "torque": "forward_effort_controller",
}
"""The controllers of ros2_control that take one kind of commands, by the names that its documentation gives them."""

FLANGES: Final = "flange", "tool0"
LINKED: Final = SKIROS + "LinkedToFrameId"


@dataclass(frozen=True, slots=True)
class WrenchTopic:
    """The topic of a force-torque sensor.

    in_base: along the axes of the base, not those of the flange. sign: -1 for what the robot exerts. has_weight: with
    the weight of the hand; that of what it holds is in any wrench.
    """

    topic: str
    in_base: bool
    sign: float
    has_weight: bool


@dataclass(frozen=True, slots=True)
class ToolTopics:
    """The topics of a Cartesian controller on the robot's side: target pose, stiffness and wrench; empty for none.

    stiffness_node: the node whose parameters are the stiffness, for a controller that has no topic for it. frame,
    flange: the frames of the arm's base and of its flange. of_flange: whether the pose is that of the flange, else of
    the tool. along_flange: whether stiffness and wrench are along the axes of the flange, else along those of the base.
    """

    pose: str
    stiffness: str
    stiffness_node: str
    wrench: str
    frame: str
    flange: str
    of_flange: bool
    along_flange: bool


@dataclass(frozen=True, slots=True)
class Services:
    """Services of std_srvs/srv/Trigger, and the topic (std_msgs/msg/Bool) that says whether commands have effect.

    Empty for none.
    """

    running: str = ""
    recover: str = ""
    tare: str = ""


@dataclass(frozen=True, slots=True)
class ArmInterface:
    """How ROS 2 drives one arm; `joints` are in the order of the model.

    description: the topic with the URDF of the robot. mode: the commands of `command`, a topic with messages of
    `command_type`; empty if only `tool` takes commands.
    carries_weight: whether torques are without those against gravity.
    """

    name: str
    joints: tuple[str, ...]
    states: str
    description: str
    mode: Mode
    command: str
    command_type: str
    rate_hz: float
    carries_weight: bool
    wrench: WrenchTopic | None
    tool: ToolTopics | None
    services: Services
    timing: Timing
    quality: Quality


@dataclass(frozen=True, slots=True)
class GripperInterface:
    """How ROS 2 drives a gripper: by the position of its first joint, or by services that open and close it.

    command: the topic, or the action, by `command_type`. opening = at_zero_m + per_unit * position of the joint.
    """

    name: str
    joints: tuple[str, ...]
    states: str
    command: str
    command_type: str
    effort: str
    open_service: str
    close_service: str
    at_zero_m: float
    per_unit: float
    timing: Timing
    quality: Quality

    def opening(self, position: float) -> float:
        """Return the opening in m for a position of the first joint in m or rad."""
        return self.at_zero_m + self.per_unit * position

    def position(self, opening_m: float) -> float:
        """Return the position of the first joint, in m or rad, for an opening in m."""
        return (opening_m - self.at_zero_m) / self.per_unit


@dataclass(frozen=True, slots=True)
class BaseInterface:
    """How ROS 2 drives a mobile base: goals in the frame `frame`, odometry, and the speed by which it is stopped."""

    name: str
    goal: str
    odometry: str
    velocity: str
    frame: str
    timing: Timing
    quality: Quality


@dataclass(frozen=True, slots=True)
class CameraInterface:
    """How ROS 2 drives a camera: its frame, the frames of things by IRI, and topics of images; empty for none.

    info: the topic with the lens of the depth images.
    """

    name: str
    frame: str
    frames: Mapping[str, str]
    image: str
    depth: str
    info: str
    timing: Timing
    quality: Quality


@dataclass(frozen=True, slots=True)
class CleanShareTopic:
    """The topic with the share of a surface that is clean, and how old the newest message may be in s."""

    topic: str
    fresh_s: float


def read_arm(state: WorldState, arm: str, joints: tuple[str, ...], mode: Mode, on_robot: bool = False) -> ArmInterface:
    """Read how ROS 2 drives an arm whose model has `joints`, and whose law gives commands of a mode; SheetError.

    on_robot: the law runs on the robot's side, and takes targets of the tool.
    """
    facts = DeviceFacts(state, arm)
    tool = _read_tool(facts) if on_robot else None
    controller = facts.skiros("JointConfigurationController") or ("" if tool else CONTROLLERS[mode])
    command_type = facts.choice("commandType", {each: each for each in ENDINGS}, ARRAY)
    if command_type != ARRAY and mode != "position":
        raise SheetError(f"ros2:commandType of {facts.name} takes positions; its controller gives {mode} commands")
    carries = facts.flag("carriesWeight")
    if mode == "torque" and tool is None and carries is None:
        raise SheetError(
            f"{facts.name} takes torques: state with ros2:carriesWeight whether its driver adds those against gravity"
        )
    return ArmInterface(
        name=facts.name,
        joints=facts.joints(joints),
        states=facts.topic("jointStateTopic", "joint_states"),
        description=facts.topic("descriptionTopic", "robot_description"),
        mode=mode,
        command=facts.topic("commandTopic", f"{controller}/{ENDINGS[command_type]}" if controller else ""),
        command_type=command_type,
        rate_hz=facts.number("updateRate", 100.0),
        carries_weight=bool(carries),
        wrench=_read_wrench(state, arm, facts),
        tool=tool,
        services=Services(facts.topic("runningTopic"), facts.topic("recoverService"), facts.topic("tareService")),
        timing=facts.timing(0.1),
        quality=facts.quality(),
    )


def read_gripper(state: WorldState, gripper: str, joints: tuple[str, ...]) -> GripperInterface:
    """Read how ROS 2 drives a gripper whose model has `joints`; SheetError if it has one service and not the other."""
    facts = DeviceFacts(state, gripper)
    opens, closes = facts.topic("openService"), facts.topic("closeService")
    if bool(opens) != bool(closes):
        raise SheetError(f"{facts.name} needs both ros2:openService and ros2:closeService, or none of them")
    kind = facts.choice("commandType", {each: each for each in (ARRAY, GRIP, GRIP_BY_NAMES)}, ARRAY)
    ending = "commands" if kind == ARRAY else "gripper_cmd"
    controller = "" if opens else f"gripper_controller/{ending}"
    return GripperInterface(
        name=facts.name,
        joints=tuple(facts.text("jointNames").split()) or joints,
        states=facts.topic("jointStateTopic", "joint_states"),
        command=facts.topic("commandTopic", controller),
        command_type=kind,
        effort=facts.topic("effortTopic"),
        open_service=opens,
        close_service=closes,
        at_zero_m=facts.number("openingAtZero", 0.0),
        per_unit=facts.number("openingPerUnit", 2.0),
        timing=facts.timing(1.0),
        quality=facts.quality(),
    )


def read_base(state: WorldState, robot: str) -> BaseInterface:
    """Read how ROS 2 drives a mobile base."""
    facts = DeviceFacts(state, robot)
    return BaseInterface(
        name=facts.name,
        goal=facts.topic("goalTopic", "goal_pose"),
        odometry=facts.topic("odometryTopic", "odom"),
        velocity=facts.topic("velocityTopic", "cmd_vel"),
        frame=facts.skiros("LinkedToFrameId") or WORLD_FRAME,
        timing=facts.timing(1.0),
        quality=facts.quality(),
    )


def read_camera(state: WorldState, camera: str) -> CameraInterface | None:
    """Read how ROS 2 drives a camera; None if its facts have neither a frame nor a topic with images."""
    facts = DeviceFacts(state, camera)
    depth = facts.topic("depthTopic")
    found = CameraInterface(
        name=facts.name,
        frame=facts.skiros("LinkedToFrameId"),
        frames={each: str(frame) for each in sorted(state.individuals) if (frame := state.value(each, LINKED))},
        image=facts.topic("imageTopic"),
        depth=depth,
        info=facts.topic("cameraInfoTopic", f"{depth.rpartition('/')[0]}/camera_info"),
        timing=facts.timing(1.0),
        quality=facts.quality(),
    )
    return found if found.frame or found.image or found.depth else None


def read_inspected(state: WorldState) -> dict[str, CleanShareTopic]:
    """Return the topics with the shares of surfaces that are clean, by the IRI of the surface."""
    facts = (DeviceFacts(state, each) for each in sorted(state.instances(SURFACE)))
    return {
        each.individual: CleanShareTopic(topic, each.timing(5.0).silence_s)
        for each in facts
        if (topic := each.topic("cleanShareTopic"))
    }


def _read_tool(facts: DeviceFacts) -> ToolTopics:
    """Return the topics of a Cartesian controller on the robot's side; SheetError if no topic takes its targets."""
    pose, link = facts.topic("targetPoseTopic"), facts.skiros("MoveItTCPLink")
    if not pose:
        action = facts.skiros("CartesianGoalAction")
        other = f"; {action} (skiros:CartesianGoalAction) moves the tool by itself, not as skills ask" if action else ""
        raise SheetError(
            f"the law of {facts.name} runs on the robot's side: state the topic of its target poses as "
            f"ros2:targetPoseTopic{other}"
        )
    return ToolTopics(
        pose=pose,
        stiffness=facts.full_name(facts.skiros("CartesianStiffnessTopic")),
        stiffness_node=facts.topic("stiffnessNode"),
        wrench=facts.full_name(facts.skiros("CartesianWrenchTopic")),
        frame=facts.skiros("LinkedToFrameId") or "base_link",
        flange=link if link in FLANGES else "tool0",
        of_flange=not link or link in FLANGES,
        along_flange=facts.choice("complianceFrame", {"base": False, "flange": True}, False),
    )


def _read_wrench(state: WorldState, arm: str, facts: DeviceFacts) -> WrenchTopic | None:
    sensors = sorted(each for each in state.objects(arm, HAS_SENSOR) if state.is_a(each, FORCE_TORQUE_SENSOR))
    if not sensors:
        return None
    sensor = DeviceFacts(state, sensors[0])
    topic = sensor.text("wrenchTopic", "force_torque_sensor_broadcaster/wrench")
    return WrenchTopic(
        topic=(sensor if sensor.text("namespace") else facts).full_name(topic),
        in_base=sensor.choice("wrenchFrame", {"flange": False, "base": True}, False),
        sign=sensor.choice("wrenchExertedBy", {"environment": 1.0, "robot": -1.0}, 1.0),
        has_weight=bool(sensor.flag("wrenchHasWeight")),
    )
