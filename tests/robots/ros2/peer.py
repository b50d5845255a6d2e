"""A simulated cell behind the topics of ROS 2, as a process of its own: the robot's side, for tests.

`python peer.py OPTIONS`, a JSON object with the fields of `Options`. Joints, grippers and bases are those of a scene,
moved by MuJoCo; nothing of the back end `ros2` is imported. What is commanded beyond the limits of the joints, and what
the hands hold, is written to the file `report` when the process gets SIGTERM.
"""

from __future__ import annotations

import json
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from pathlib import Path
from threading import RLock
from typing import Any

import numpy as np
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Float64, String
from std_srvs.srv import Trigger

from robots.priority import run_promptly
from robots.ros2.channel import Channel, Options, Report
from robots.ros2.controllers import Arm, Base, Hand
from robots.ros2.panel import Panel
from skillc.services.library.files import SHIPPED, find_library
from skillc.services.library.libraries import compile_library
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.steps import InPython
from skillc_runtime.backends.simulation.variation.variation import exact_variation
from skillc_runtime.devices.arm import Command
from skillc_runtime.motion.numerics.program import Part
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import ARM_DEVICE, COMPLIANT_CONTROLLER

BEHIND_S = 0.05
"""A peer that has not been run in time makes up for this much, and loses the rest."""


class PeerCell(SimulatedCell):
    """A cell whose arms do what was commanded last, without any control of ours."""

    commands: dict[str, Callable[[float], Command | None]]

    def _control_part(self, individual: str) -> Part:
        return InPython(partial(self._pass_command, individual))

    def _pass_command(self, individual: str, now: float) -> None:
        command = self.commands[individual](now)
        self.arms[individual].state()
        if command is not None:
            self.arms[individual].command(command)


class Peer:
    """The process: a node, a cell, and what it publishes."""

    def __init__(self, options: Options) -> None:
        self.options, self.report = options, Report()
        self.channel = Channel(options, self.report)
        self._context = Context()
        rclpy.init(context=self._context)
        self._node = Node("robot", context=self._context, enable_rosout=False)
        self._latched = QoSProfile(depth=1, durability=rclpy.qos.DurabilityPolicy.TRANSIENT_LOCAL)
        self._subscriptions: list[tuple[Any, Any, Callable[[Any], None]]] = []
        self._executor = rclpy.executors.SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        steps = round(1000.0 / options.rate_hz)
        state = load_scene(Path(options.scene), _load_vocabulary(options.library))
        remote = [each for each in state.instances(ARM_DEVICE) if state.value(each, COMPLIANT_CONTROLLER) == "on_robot"]
        # The drivers of the cell are not used; they are made for a law that MuJoCo has.
        world = WorldModel(
            state.with_changes([SetProperty(each, COMPLIANT_CONTROLLER, "impedance") for each in remote])
        )
        self.cell = PeerCell(world, 0, steps_per_command=steps, reality=lambda scene, _: exact_variation(scene))
        self.arms = {each.individual: Arm(each.individual, self) for each in self.cell.scene.arms}
        self.cell.commands = {name: arm.command for name, arm in self.arms.items()}
        hands = [each.gripper.individual for each in self.cell.scene.arms if each.gripper is not None]
        self.hands = {each: Hand(each, self) for each in hands}
        self.bases = [Base(each.individual, self) for each in self.cell.scene.bases]
        self._states = self.publisher("joint_states", JointState)
        self._running = self._node.create_publisher(Bool, "robot_program_running", self._latched)
        self._running.publish(Bool(data=True))
        self.serve("stop_program", lambda: self._run_program(False))
        self.serve("resend_program", lambda: self._run_program(True))
        switches = [each.individual for each in self.cell.scene.fixtures if each.switch_travel_m is not None]
        topics = {each: f"{_topic_of(self.cell.scene.names[each])}/switched" for each in switches}
        self._buttons = {
            each: self._node.create_publisher(Bool, topic, self._latched) for each, topic in topics.items()
        }
        self._shares = {
            each: self.publisher(f"{_topic_of(self.cell.scene.names[each])}/clean_share", Float64)
            for each in self.cell.coverage
        }
        self.ended, self._next_call, self.lock = False, 0.0, RLock()
        if options.panel:
            Panel(self, Path(options.panel))

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

    def describe(self, urdf: str) -> None:
        """Publish the URDF of the robot."""
        self._description = self._node.create_publisher(String, "robot_description", self._latched)
        self._description.publish(String(data=urdf))

    def add_controller(self, name: str, joints: list[str], interface: str) -> None:
        """Add a node with the parameters of a controller of ros2_control."""
        node = Node(name, context=self._context, enable_rosout=False)
        node.declare_parameter("joints", joints)
        node.declare_parameter("interface_name", interface)
        self._executor.add_node(node)

    def send(self, publisher: Any, message: Any) -> None:
        """Publish a message through the channel."""
        self.channel.carry(lambda: publisher.publish(message))

    def stamp(self) -> Any:
        """Return the present time as a message."""
        return self._node.get_clock().now().to_msg()

    def run(self) -> None:
        """Run until SIGTERM, in time with the wall clock."""
        period = self.cell.period_s
        due, end = time.monotonic(), time.monotonic() + self.options.seconds
        print("ready", flush=True)
        while not self.ended and time.monotonic() < end:
            self._receive()
            self.channel.deliver_due()
            if (now := time.monotonic()) < due:
                time.sleep(min(due - now, 0.001))
                continue
            if now - due > BEHIND_S:
                due = now
            due += period
            with self.lock:
                self.cell.advance_period()
                self.cell.publish()
                self._publish()

    def write_report(self) -> None:
        """Write what was seen."""
        names = self.cell.scene.names
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
        for button, publisher in self._buttons.items():
            publisher.publish(Bool(data=self.cell.button(button).switched))


def _load_vocabulary(library: str) -> Vocabulary:
    if library:
        return compile_library(find_library(SHIPPED / library)).value.vocabulary
    return load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value


def _topic_of(name: str) -> str:
    return name.rpartition(":")[2].replace("-", "_")


def main() -> None:
    """Be the robot."""
    run_promptly()
    peer = Peer(Options(**json.loads(sys.argv[1])))

    def end(*_: object) -> None:
        peer.ended = True

    signal.signal(signal.SIGTERM, end)
    signal.signal(signal.SIGINT, end)
    peer.run()
    peer.write_report()


if __name__ == "__main__":
    main()
