"""A simulated cell behind the topics of ROS 2, as a process of its own: the robot's side, for tests.

`python peer.py OPTIONS`, a JSON object with the fields of `Options`. Joints, grippers and bases are those of a scene,
moved by MuJoCo; nothing of the back end `ros2` is imported. What is commanded beyond the limits of the joints, and what
the tools press on, is written to the file `report` when the process gets SIGTERM.
"""

from __future__ import annotations

import json
import random
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from heapq import heappop, heappush
from itertools import count
from pathlib import Path
from typing import Any, Literal

import numpy as np
import rclpy
from geometry_msgs.msg import PoseStamped, Twist, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Float64, Float64MultiArray
from std_srvs.srv import Trigger
from trajectory_msgs.msg import JointTrajectory

from robots.ros2.cartesian import CartesianImpedance
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.variation import exact_variation
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.devices.arm import Command, JointPosition, JointVelocity, Torque
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import ARM_DEVICE, COMPLIANT_CONTROLLER

BEHIND_S = 0.05
"""A peer that has not been run in time makes up for this much, and loses the rest."""


@dataclass(frozen=True)
class Options:
    """What the peer is.

    rate_hz: how often states are published and commands taken. control: the controllers that are active. loss: the
    share of messages that get lost, in each direction; jitter_s: the greatest delay of those that do not. reverse:
    joint states are in reverse order. degrees: they are in degrees, as no driver should publish them. exact: there are
    no differences from the facts of the scene; otherwise `seed` draws them. seconds: after which the process ends.
    """

    scene: str
    report: str = ""
    rate_hz: float = 250.0
    control: Literal["position", "velocity", "effort", "trajectory", "cartesian", "none"] = "position"
    namespace: str = ""
    joint_names: dict[str, str] = field(default_factory=dict)
    loss: float = 0.0
    jitter_s: float = 0.0
    reverse: bool = False
    degrees: bool = False
    exact: bool = True
    seed: int = 0
    pace: float = 1.0
    seconds: float = 600.0


@dataclass
class Report:
    """What the peer has seen: commands beyond limits, with the first ones in words, and what was pressed on."""

    commands: int = 0
    beyond_limits: int = 0
    examples: list[str] = field(default_factory=list)
    greatest_force_n: float = 0.0
    coverage: dict[str, float] = field(default_factory=dict)
    late_s: float = 0.0
    holds: dict[str, str] = field(default_factory=dict)

    def complain(self, problem: str) -> None:
        """Count a command beyond a limit."""
        self.beyond_limits += 1
        if len(self.examples) < 5:
            self.examples.append(problem)


class Channel:
    """Loses and delays messages."""

    def __init__(self, options: Options) -> None:
        self._options, self._random = options, random.Random(options.seed)
        self._waiting: list[tuple[float, int, Callable[[], None]]] = []
        self._number = count()

    def carry(self, deliver: Callable[[], None]) -> None:
        """Deliver a message now, later or never."""
        if self._random.random() < self._options.loss:
            return
        if self._options.jitter_s == 0.0:
            deliver()
            return
        due = time.monotonic() + self._random.random() * self._options.jitter_s
        heappush(self._waiting, (due, next(self._number), deliver))

    def deliver_due(self) -> None:
        """Deliver what is due."""
        while self._waiting and self._waiting[0][0] <= time.monotonic():
            heappop(self._waiting)[2]()


class PeerCell(SimulatedCell):
    """A cell whose arms do what was commanded last, without any control of ours."""

    commands: dict[str, Callable[[float], Command | None]]

    def _control(self, individual: str, arm: CompliantArmDriver, now: float) -> None:
        command = self.commands[individual](now)
        self.arms[individual].state()
        if command is not None:
            self.arms[individual].command(command)


class Arm:
    """The controllers of one arm, and its broadcasters."""

    def __init__(self, individual: str, peer: Peer) -> None:
        self._arm, self._peer = peer.cell.arms[individual], peer
        facts = next(each for each in peer.cell.scene.arms if each.individual == individual)
        prefix = peer.cell.scene.names[individual] + "/"
        model = peer.cell.model
        names = [
            model.joint(j).name.removeprefix(prefix)
            for j in range(model.njnt)
            if model.joint(j).name.startswith(prefix)
        ]
        self.names = [peer.options.joint_names.get(each, each) for each in names]
        self._flange = model.site(prefix + "flange").id
        self._limits, self._last, self._last_at = self._arm.limits, None, 0.0
        self._law = CartesianImpedance(len(names)) if peer.options.control == "cartesian" else None
        control, has_sensor = peer.options.control, facts.force_torque
        self._arm.switch(
            {"velocity": "velocity", "position": "position", "trajectory": "position"}.get(control, self._arm.interface)
        )  # type: ignore[arg-type]
        self._goal: tuple[Any, Any, float, float] | None = None
        topics = {
            "position": ("forward_position_controller/commands", Float64MultiArray, self._take),
            "velocity": ("forward_velocity_controller/commands", Float64MultiArray, self._take),
            "effort": ("forward_effort_controller/commands", Float64MultiArray, self._take),
            "trajectory": ("joint_trajectory_controller/joint_trajectory", JointTrajectory, self._take_trajectory),
        }
        if control in topics:
            peer.subscribe(*topics[control])
        if self._law is not None:
            peer.subscribe("cartesian_controller/joint_trajectory", JointTrajectory, self._take_posture)
            peer.subscribe("cartesian_controller/reference_pose", PoseStamped, self._law.take_pose)
            peer.subscribe("cartesian_controller/set_cartesian_stiffness", WrenchStamped, self._law.take_stiffness)
            peer.subscribe("cartesian_controller/set_cartesian_wrench", WrenchStamped, self._law.take_wrench)
        self._wrench = peer.publisher("force_torque_sensor_broadcaster/wrench", WrenchStamped) if has_sensor else None

    def command(self, now: float) -> Command | None:
        """Return what the active controller commands; the last command counts until there is another one."""
        if self._law is not None:
            state = self._arm.state()
            return Torque(self._law.torques(state, self._find_flange()))
        if self._goal is not None:
            start, goal, begin, span = self._goal
            share = min(1.0, (now - begin) / span)
            return JointPosition(start + share * (goal - start))
        if self._last is None or self._peer.options.control == "trajectory":
            return None
        kind = {"position": JointPosition, "velocity": JointVelocity, "effort": Torque}[self._peer.options.control]  # type: ignore[index]
        return kind(self._last)

    def publish(self) -> tuple[list[str], list[float], list[float], list[float]]:
        """Publish the wrench; return names, positions, speeds and efforts of the joints."""
        state = self._arm.state()
        if self._wrench is not None:
            self._publish_wrench(state)
        return self.names, state.q.tolist(), state.dq.tolist(), state.effort.tolist()

    def _find_flange(self) -> Pose:
        """Return the flange in the base."""
        data = self._peer.cell.data
        return self._arm.base.inverse() @ Pose(data.site_xpos[self._flange], data.site_xmat[self._flange].reshape(3, 3))

    def _publish_wrench(self, state: Any) -> None:
        """Publish the wrench of the environment at the flange, along its axes."""
        flange = self._find_flange()
        force, moment = state.wrench[:3], state.wrench[3:]
        moment = moment + np.cross(state.tool.position - flange.position, force)
        message = WrenchStamped()
        message.header.frame_id, message.header.stamp = "tool0", self._peer.stamp()
        for part, values in ((message.wrench.force, force), (message.wrench.torque, moment)):
            part.x, part.y, part.z = (flange.rotation.T @ values).tolist()
        self._peer.send(self._wrench, message)

    def _take(self, message: Float64MultiArray) -> None:
        values = np.array(message.data)
        self._check(values)
        self._last = values

    def _take_posture(self, message: JointTrajectory) -> None:
        order = [list(message.joint_names).index(each) for each in self.names]
        q = np.array(message.points[-1].positions)[order]
        assert self._law is not None
        self._law.take_posture(q, self._arm.flange_at(q))

    def _take_trajectory(self, message: JointTrajectory) -> None:
        point = message.points[-1]
        order = [list(message.joint_names).index(each) for each in self.names]
        goal, span = np.array(point.positions)[order], point.time_from_start.sec + 1e-9 * point.time_from_start.nanosec
        now = self._peer.cell.now
        self._check(goal)
        command = self.command(now)
        start = command.q if isinstance(command, JointPosition) else self._arm.state().q.copy()
        self._goal = start, goal, now, max(span, 1e-3)

    def _check(self, values: Any) -> None:
        """Complain about what no driver may command."""
        report, limits, control = self._peer.report, self._limits, self._peer.options.control
        report.commands += 1
        if values.size != len(self.names) or not np.isfinite(values).all():
            report.complain(f"a command with {values.size} values, or one that is no number: {values}")
        elif control == "effort" and (np.abs(values) > limits.effort + 1e-6).any():
            report.complain(f"torques {values}")
        elif control == "velocity" and (np.abs(values) > limits.velocity + 1e-6).any():
            report.complain(f"speeds {values}")
        elif control in ("position", "trajectory"):
            if (values < limits.range[:, 0] - 1e-6).any() or (values > limits.range[:, 1] + 1e-6).any():
                report.complain(f"positions {values}")
            now, before = time.monotonic(), self._last
            if before is None:
                before, self._last_at = self._arm.state().q.copy(), now - 0.02
            step = np.abs(values - before)
            # Messages that arrive late come closer together than they were sent.
            span = max(now - self._last_at, 1.0 / self._peer.options.rate_hz) + self._peer.options.jitter_s + 0.01
            if (step > limits.velocity * span + 1e-6).any():
                report.complain(f"a step of {step.max():.4f} rad within {span:.4f} s")
            self._last, self._last_at = values, now


class Hand:
    """A gripper by the position of its first finger; contact of both fingers is a grasp."""

    def __init__(self, individual: str, peer: Peer) -> None:
        self._gripper, self._peer = peer.cell.gripper(individual), peer
        prefix, model = peer.cell.scene.names[individual] + "/", peer.cell.model
        names = [
            model.joint(j).name.removeprefix(prefix)
            for j in range(model.njnt)
            if model.joint(j).name.startswith(prefix)
        ]
        self._names, self._force_n = names, self._gripper.max_force_n
        peer.subscribe("gripper_controller/commands", Float64MultiArray, self._take)
        peer.subscribe("gripper_controller/max_effort", Float64MultiArray, self._take_force)
        peer.serve("open_gripper", lambda: self._move(self._gripper.max_opening_m))
        peer.serve("close_gripper", lambda: self._move(0.0))

    def publish(self) -> tuple[list[str], list[float], list[float], list[float]]:
        """Grasp what the fingers touch from both sides; return names, positions, speeds and efforts of the fingers."""
        gripper, cell = self._gripper, self._peer.cell
        if gripper.blocked and gripper.holding is None:
            for thing in cell.scene.graspable:
                if gripper.touches(thing.individual):
                    gripper.attach(thing.individual, Pose(np.zeros(3), np.eye(3)), 0.0)
        half, number = gripper.opening_m / 2, len(self._names)
        moving = 0.01 if gripper.moving else 0.0
        return self._names, [half] * number, [moving] * number, [0.0] * number

    @property
    def holds(self) -> str:
        """What it holds, by its short name."""
        return self._peer.cell.scene.names.get(self._gripper.carries or "", "")

    def _take(self, message: Float64MultiArray) -> None:
        self._move(2 * message.data[0])

    def _take_force(self, message: Float64MultiArray) -> None:
        self._force_n = message.data[0]

    def _move(self, opening_m: float) -> None:
        if opening_m > self._gripper.opening_m:
            self._gripper.detach()
        self._gripper.move(opening_m, self._force_n)


class Base:
    """A mobile base that drives to goals and publishes its odometry."""

    def __init__(self, individual: str, peer: Peer) -> None:
        self._base, self._peer, self._pose = peer.cell.base(individual), peer, None
        peer.subscribe("goal_pose", PoseStamped, self._take_goal)
        peer.subscribe("cmd_vel", Twist, self._take_speed)
        self._odometry = peer.publisher("odom", Odometry)

    def publish(self) -> None:
        """Publish the odometry."""
        message, pose = Odometry(), self._base.pose
        message.header.frame_id, message.header.stamp = "map", self._peer.stamp()
        fill_pose(message.pose.pose, pose)
        message.twist.twist.linear.x = 0.0 if self._base.at_rest else 0.1
        self._peer.send(self._odometry, message)

    def _take_goal(self, message: PoseStamped) -> None:
        self._base.drive_to(read_pose(message.pose))

    def _take_speed(self, message: Twist) -> None:
        if message.linear.x == 0.0 and message.angular.z == 0.0:
            self._base.stop()


class Peer:
    """The process: a node, a cell, and what it publishes."""

    def __init__(self, options: Options) -> None:
        self.options, self.report, self.channel = options, Report(), Channel(options)
        self._context = Context()
        rclpy.init(context=self._context)
        self._node = Node("robot", namespace=options.namespace or None, context=self._context, enable_rosout=False)
        self._subscriptions: list[tuple[Any, Any, Callable[[Any], None]]] = []
        self._executor = rclpy.executors.SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        reality = {"reality": lambda scene, _: exact_variation(scene)} if options.exact else {}
        steps = round(1000.0 / options.rate_hz)
        vocabulary = load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value
        state = load_scene(Path(options.scene), vocabulary)
        remote = [each for each in state.instances(ARM_DEVICE) if state.value(each, COMPLIANT_CONTROLLER) == "on_robot"]
        # The drivers of the cell are not used; they are made for a law that MuJoCo has.
        world = WorldModel(
            state.with_changes([SetProperty(each, COMPLIANT_CONTROLLER, "impedance") for each in remote])
        )
        self.cell = PeerCell(world, options.seed, steps_per_command=steps, **reality)
        self.arms = {each.individual: Arm(each.individual, self) for each in self.cell.scene.arms}
        self.cell.commands = {name: arm.command for name, arm in self.arms.items()}
        hands = [each.gripper.individual for each in self.cell.scene.arms if each.gripper is not None]
        self.hands = {each: Hand(each, self) for each in hands}
        self.bases = [Base(each.individual, self) for each in self.cell.scene.bases]
        self._states = self.publisher("joint_states", JointState)
        latched = QoSProfile(depth=1, durability=rclpy.qos.DurabilityPolicy.TRANSIENT_LOCAL)
        self._running = self._node.create_publisher(Bool, "robot_program_running", latched)
        self._running.publish(Bool(data=True))
        self.serve("stop_program", lambda: self._run_program(False))
        self.serve("resend_program", lambda: self._run_program(True))
        self._shares = {
            each: self.publisher(
                f"{self.cell.scene.names[each].rpartition(':')[2].replace('-', '_')}/clean_share", Float64
            )
            for each in self.cell.coverage
        }
        self.ended, self._next_call = False, 0.0

    def subscribe(self, topic: str, kind: Any, take: Callable[[Any], None]) -> None:
        """Take the messages of a topic."""
        quality = QoSProfile(depth=10)
        self._subscriptions.append((self._node.create_subscription(kind, topic, lambda _: None, quality), kind, take))

    def publisher(self, topic: str, kind: Any) -> Any:
        """Return a publisher."""
        return self._node.create_publisher(kind, topic, QoSProfile(depth=10))

    def serve(self, name: str, act: Callable[[], None]) -> None:
        """Offer a service without arguments."""

        def answer(_: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
            act()
            response.success = True
            return response

        self._node.create_service(Trigger, name, answer)

    def send(self, publisher: Any, message: Any) -> None:
        """Publish a message through the channel."""
        self.channel.carry(lambda: publisher.publish(message))

    def stamp(self) -> Any:
        """Return the present time as a message."""
        return self._node.get_clock().now().to_msg()

    def run(self) -> None:
        """Run until SIGTERM, in time with the wall clock."""
        period, pace = self.cell.period_s, self.options.pace
        due, end = time.monotonic(), time.monotonic() + self.options.seconds
        print("ready", flush=True)
        while not self.ended and time.monotonic() < end:
            self._receive()
            self.channel.deliver_due()
            if (now := time.monotonic()) < due:
                time.sleep(min(due - now, 0.001))
                continue
            if now - due > BEHIND_S:
                self.report.late_s += now - due
                due = now
            due += period / pace
            self.cell.advance_period()
            self.cell.publish()
            self._publish()

    def write_report(self) -> None:
        """Write what was seen."""
        names = self.cell.scene.names
        for surface, coverage in self.cell.coverage.items():
            self.report.coverage[names[surface]] = coverage.wiped_share
        self.report.holds = {names[each]: hand.holds for each, hand in self.hands.items()}
        if self.options.report:
            Path(self.options.report).write_text(json.dumps(asdict(self.report), indent=1), encoding="utf-8")

    def _run_program(self, on: bool) -> None:
        self._running.publish(Bool(data=on))

    def _receive(self) -> None:
        """Take what has arrived: services by the executor, which takes ms, topics directly."""
        if time.monotonic() > self._next_call:
            self._executor.spin_once(timeout_sec=0.0)
            self._next_call = time.monotonic() + 0.1
        for subscription, kind, take in self._subscriptions:
            while (found := subscription.handle.take_message(kind, False)) is not None:
                self.channel.carry(lambda message=found[0], take=take: take(message))

    def _publish(self) -> None:
        parts = [each.publish() for each in (*self.arms.values(), *self.hands.values())]
        names, positions, speeds, efforts = ([x for part in parts for x in part[k]] for k in range(4))
        message = JointState()
        message.header.stamp = self.stamp()
        if self.options.degrees:
            positions = np.degrees(positions).tolist()
        order = -1 if self.options.reverse else 1
        message.name, message.position = names[::order], positions[::order]
        message.velocity, message.effort = speeds[::order], efforts[::order]
        self.send(self._states, message)
        for base in self.bases:
            base.publish()
        for surface, publisher in self._shares.items():
            publisher.publish(Float64(data=float(self.cell.coverage[surface].wiped_share)))
        for tool in self.cell.scene.tools:
            force = self._pressing_n(tool.individual)
            self.report.greatest_force_n = max(self.report.greatest_force_n, force)

    def _pressing_n(self, tool: str) -> float:
        live = self.cell.live.sensors
        first = dict(live.faces)[tool]
        return abs(float(self.cell.data.sensordata[first]))


def fill_pose(message: Any, pose: Pose) -> None:
    """Write a pose to a message; quaternions of ROS have w last."""
    message.position.x, message.position.y, message.position.z = pose.position.tolist()
    w, x, y, z = quaternion_from_rotation(pose.rotation).tolist()
    message.orientation.w, message.orientation.x, message.orientation.y, message.orientation.z = w, x, y, z


def read_pose(message: Any) -> Pose:
    """Return the pose of a message."""
    at, turn = message.position, message.orientation
    return Pose.of((at.x, at.y, at.z), (turn.w, turn.x, turn.y, turn.z))


def main() -> None:
    """Be the robot."""
    peer = Peer(Options(**json.loads(sys.argv[1])))

    def end(*_: object) -> None:
        peer.ended = True

    signal.signal(signal.SIGTERM, end)
    signal.signal(signal.SIGINT, end)
    peer.run()
    peer.write_report()


if __name__ == "__main__":
    main()
