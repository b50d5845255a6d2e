"""Cameras by what nodes of ROS 2 publish, and what devices lack on the graph; tf2_msgs is used where it is."""

from __future__ import annotations

from dataclasses import replace
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest

from robots.ros2.nodes import receiving, spun, wait_until
from robots.ros2.test_link import SCENE
from simulation.cells import LAB, vocabulary
from skillc_runtime.backends.ros2.arms.joint_commands import ask_controller
from skillc_runtime.backends.ros2.arms.tool_commands import NAMES, StiffnessParameters
from skillc_runtime.backends.ros2.camera import IMAGE, INFO, Ros2Camera
from skillc_runtime.backends.ros2.device_facts import Quality, Timing
from skillc_runtime.backends.ros2.facts import ARRAY, CameraInterface, CleanShareTopic
from skillc_runtime.backends.ros2.graph_check import check_devices, check_places
from skillc_runtime.backends.ros2.inspection import SHARE, Ros2Inspection
from skillc_runtime.backends.ros2.receiver import Receiver
from skillc_runtime.backends.ros2.session import Session, find_message
from skillc_runtime.backends.ros2.transforms import Transforms
from skillc_runtime.backends.simulation.cameras.camera_spec import CameraErrors, CameraSpec
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.motion.pose import Pose
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.field_of_view import FieldOfView

pytestmark = pytest.mark.slow

needs_tf2 = pytest.mark.skipif(find_spec("tf2_msgs") is None, reason="there is no tf2_msgs: source an installed ROS 2")
ROOT_HALF = 0.5**0.5
SPEC = CameraSpec(
    LAB + "Camera-1",
    Pose(np.zeros(3), np.eye(3)),
    FieldOfView(1.2, 0.1, 3.0),
    period_s=0.1,
    delay_s=0.0,
    least_visible=0.3,
    errors=CameraErrors(position_noise_m=0.002),
)
LOOKS = CameraInterface(
    "lab:Camera-1", "optical", {LAB + "Box-1": "box"}, "", "", "", Timing(5.0, 1.0), Quality(False, True)
)


def frame(session: Session, parent: str, child: str, place: tuple[float, float, float], turned: bool) -> Any:
    """Return the message of a transform, dated now."""
    message = find_message("geometry_msgs/msg/TransformStamped")()
    message.header.frame_id, message.child_frame_id = parent, child
    message.header.stamp = session.node.get_clock().now().to_msg()
    at, turn = message.transform.translation, message.transform.rotation
    at.x, at.y, at.z = place
    turn.w, turn.z = (ROOT_HALF, ROOT_HALF) if turned else (1.0, 0.0)
    return message


@needs_tf2
def test_a_thing_is_where_its_frame_is_seen_from_the_camera(other: Session) -> None:
    kind = "tf2_msgs/msg/TFMessage"
    moving = other.publish("/tf", kind, reliable=True)
    still = other.node.create_publisher(find_message(kind), "/tf_static", _latched())
    still.publish(still.msg_type(transforms=[frame(other, "map", "optical", (1.0, 0.0, 0.0), turned=True)]))

    def tell() -> None:
        moving.publish(moving.msg_type(transforms=[frame(other, "map", "box", (1.0, 2.0, 0.5), turned=False)]))

    def make(receiver: Receiver) -> Ros2Camera:
        return Ros2Camera(SPEC, LOOKS, Transforms(receiver), receiver)

    with receiving(make) as camera:
        since_s = camera.clock_s
        found = wait_until(lambda: camera.locate(LAB + "Box-1", since_s), tell)
        assert found.pose.position == pytest.approx([2.0, 0.0, 0.5], abs=1e-9)
        assert (found.position_m, found.taken_s > since_s) == (0.002, True)
        assert camera.locate(LAB + "Box-1", camera.clock_s + 1.0) is None, "no image is as new as that"
        assert camera.locate(LAB + "Box-2", since_s) is None, "it has no frame"
        with camera._receiver.lock:
            assert camera._transforms.find("optical", "elsewhere") is None


def test_what_devices_lack_on_the_graph_is_reported(other: Session, tmp_path: Any) -> None:
    path, asks = tmp_path / "cell.ttl", Session("asks")
    more = """lab:Camera-1 a skillc:Camera ; skillc:hasSheet skillc:depth-camera-sheet ; skillc:on lab:Cell ;
        ros2:depthTopic "/depth/image" .
        lab:Hand-1 ros2:effortTopic "/force" ."""
    path.write_text(SCENE.read_text("utf-8") + more, "utf-8")
    state = load_scene(path, vocabulary())
    scene = read_scene_spec(state)
    wanted = [
        "lab:Hand-1: nobody publishes /joint_states (sensor_msgs/msg/JointState)",
        "lab:Hand-1: nobody subscribes to /gripper_controller/commands (std_msgs/msg/Float64MultiArray)",
        "lab:Hand-1: nobody subscribes to /force (std_msgs/msg/Float64MultiArray)",
        "lab:Camera-1: nobody publishes /depth/image (sensor_msgs/msg/Image)",
        "lab:Camera-1: nobody publishes /depth/camera_info (sensor_msgs/msg/CameraInfo)",
    ]
    try:
        assert list(check_devices(state, scene, asks)) == wanted
        for topic, kind in (("/joint_states", "sensor_msgs/msg/JointState"), ("/depth/image", IMAGE)):
            other.publish(topic, kind, reliable=True)
        other.publish("/depth/camera_info", IMAGE, reliable=True)
        other.subscribe("/gripper_controller/commands", ARRAY, reliable=True)
        other.subscribe("/force", ARRAY, reliable=True)
        odd = (
            "lab:Camera-1: /depth/camera_info has messages of sensor_msgs/msg/Image, not of sensor_msgs/msg/CameraInfo"
        )
        wait_until(lambda: list(check_devices(state, scene, asks)) == [odd])
    finally:
        asks.close()


@needs_tf2
def test_an_arm_that_stands_elsewhere_by_tf_is_reported(other: Session, tmp_path: Any) -> None:
    path, kind = tmp_path / "cell.ttl", "tf2_msgs/msg/TFMessage"
    path.write_text(SCENE.read_text("utf-8") + 'lab:Arm-1 skiros:LinkedToFrameId "base" .\n', "utf-8")
    state = load_scene(path, vocabulary())
    scene = read_scene_spec(state)
    still = other.node.create_publisher(find_message(kind), "/tf_static", _latched())
    for place, turned, said in (
        ((0.0, 0.0, 0.6), False, []),
        (
            (0.3, 0.0, 1.0),
            True,
            ["lab:Arm-1: tf has base 0.50 m and 90 deg from where the facts have the base of the arm"],
        ),
    ):
        assert scene.arms[0].base.position == pytest.approx([0.0, 0.0, 0.6])
        still.publish(still.msg_type(transforms=[frame(other, "map", "base", place, turned)]))
        assert list(check_places(state, scene)) == said


def _latched() -> Any:
    from rclpy.qos import DurabilityPolicy, QoSProfile

    return QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@pytest.mark.parametrize(("encoding", "kind", "unit_m"), [("32FC1", np.float32, 1.0), ("16UC1", np.uint16, 1e-3)])
def test_depths_are_those_of_the_pixel_in_which_a_point_is_seen(
    encoding: str, kind: Any, unit_m: float, other: Session
) -> None:
    image = find_message("sensor_msgs/msg/Image")(encoding=encoding, width=40, height=30)
    pixels = np.full((30, 40), 2.0 / unit_m, kind)
    pixels[15, 30] = 1.0 / unit_m
    pixels[15, 10] = 0
    image.step, image.data = pixels.strides[0], pixels.tobytes()
    lens = find_message(INFO)(k=[50.0, 0.0, 20.0, 0.0, 50.0, 15.0, 0.0, 0.0, 1.0])
    images, lenses = (
        other.publish(topic, type_, reliable=True)
        for topic, type_ in (("/depth/image", "sensor_msgs/msg/Image"), ("/depth/camera_info", INFO))
    )

    def tell() -> None:
        images.publish(image)
        lenses.publish(lens)

    looks = replace(LOOKS, frame="", depth="/depth/image", info="/depth/camera_info", image="/depth/image")
    with receiving(lambda receiver: Ros2Camera(SPEC, looks, None, receiver)) as camera:
        middle = wait_until(lambda: camera.depth_m(np.array([0.0, 0.0, 1.0])), tell)
        assert middle == pytest.approx(2.0)
        aside = np.array([0.2, 0.0, 1.0])
        assert camera.depth_m(aside) == pytest.approx(np.linalg.norm(aside))
        assert camera.depth_m(np.array([-0.2, 0.0, 1.0])) is None, "that pixel has no depth"
        assert camera.depth_m(np.array([0.0, 0.0, -1.0])) is None, "behind the camera"
        assert wait_until(lambda: camera.images.newest, tell).encoding == encoding
        assert len(camera.feeds) == 2


def test_a_surface_is_as_clean_as_its_topic_has_lately_said(other: Session) -> None:
    shares = other.publish("/share", SHARE, reliable=True)
    board, topics = LAB + "Board-1", {LAB + "Board-1": CleanShareTopic("/share", fresh_s=1.0)}
    silent = r"/share has been silent for 1 s \(skillc:stateTimeout\)"
    with receiving(lambda receiver: Ros2Inspection(topics, receiver)) as inspection:
        with pytest.raises(NoSuchDevice, match=silent):
            inspection.inspect(board)
        wait_until(lambda: inspection._shares, lambda: shares.publish(shares.msg_type(data=0.25)))
        assert inspection.inspect(board) == 0.25
        with pytest.raises(NoSuchDevice, match="state ros2:cleanShareTopic"):
            inspection.inspect(LAB + "Board-2")
        with pytest.raises(NoSuchDevice, match=silent):
            wait_until(lambda: inspection.inspect(board) != 0.25)


def test_stiffness_is_set_as_parameters_of_the_controllers_node(other: Session) -> None:
    from rclpy.node import Node

    controller = Node("cartesian_compliance_controller", context=other.context)
    for name in NAMES:
        controller.declare_parameter(name, 500.0)
    asks = Session("asks")
    parameters = StiffnessParameters(asks, "/cartesian_compliance_controller")
    wanted = np.array([100.0, 200.0, 0.0, 10.0, 20.0, 30.0])

    def are_set() -> bool:
        parameters.send(wanted)
        return [controller.get_parameter(name).value for name in NAMES] == wanted.tolist()

    try:
        with spun(other, controller):
            wait_until(are_set)
            assert parameters.find_obstacle() is None
            controller.undeclare_parameter(NAMES[0])
            wait_until(lambda: parameters.find_obstacle() is not None, lambda: parameters.send(2 * wanted))
            assert "refuses: " in parameters.find_obstacle().sentence  # type: ignore[union-attr]
    finally:
        asks.close()
    assert ask_controller(other, "/nobody/commands").joints == ()
