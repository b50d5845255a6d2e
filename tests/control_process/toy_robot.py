"""A robot in a process of its own: a simulated cell behind two sockets, with a controller that enforces its limits.

The stream has a state a cycle, and what comes back: a command, or a request. The panel is what an operator, the fingers
and the camera of the robot are asked by: calls of methods of `Panel`, by name. With `paced` the robot waits no longer
than its period for a command; else for `PATIENCE_S`, twice in a row, so that a slow machine does not disturb what a
test looks at.
A third argument is the socket where it tells what is true.
"""

from __future__ import annotations

import socket
import sys
import threading
import time
from collections import deque
from collections.abc import Sequence
from multiprocessing.connection import Connection, Listener
from pathlib import Path
from typing import Any

import numpy as np

from robots.truth import serve_truth
from simulation.cells import world
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.devices.arm import ArmLoad, Command, JointPosition, JointVelocity, Torque
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import AT

CONDITIONS = ("ready", "in-control", "not-in-control", "wrong-mode", "protective-stop", "emergency-stop")
COMMAND, TAKE, GIVE, RECOVER, LOAD = range(5)
MADE: dict[float, type[Command]] = {1.0: Torque, 2.0: JointPosition, 3.0: JointVelocity}
PATIENCE_S, PATIENT_CYCLES, STOP_CYCLES = 1.0, 2, 8
HERE = Pose(np.zeros(3), np.eye(3))
LAB = "http://example.org/lab#"


class Judge:
    """Checks every command against the limits that the maker has published."""

    def __init__(self, limits: Any, torque_rate: float, period_s: float) -> None:
        self._limits, self._rate, self._period = limits, torque_rate, period_s
        self._last: Array | None = None
        self.violations: list[str] = []

    def begin(self) -> None:
        self._last = None

    def check(self, kind: float, values: Array) -> None:
        limits, last, period = self._limits, self._last, self._period
        if kind == 1.0:
            self._expect(np.abs(values) <= limits.effort + 1e-9, "torque")
            if last is not None:
                self._expect(np.abs(values - last) <= self._rate * period + 1e-6, "torque rate")
        elif kind == 2.0:
            self._expect((limits.range[:, 0] <= values) & (values <= limits.range[:, 1]), "range")
            if last is not None:
                self._expect(np.abs(values - last) <= limits.velocity * period + 1e-9, "speed")
        else:
            self._expect(np.abs(values) <= limits.velocity + 1e-9, "speed")
        self._last = values

    def _expect(self, within: Any, what: str) -> None:
        if not np.all(within):
            self.violations.append(f"{what} of joint {int(np.argmin(within)) + 1}")


class Robot:
    """The cell with its controller; `condition` is what it reports."""

    def __init__(self, scene: str, paced: bool) -> None:
        moved = [AddRelation(LAB + "Heron-1", AT, LAB + "Store")] if scene == "ur5e_whiteboard" else []
        self.cell = SimulatedCell(WorldModel(world(scene).with_changes(moved)))
        self.cell.steps = self.cell.steps_without_control
        self.facts = self.cell.scene.arms[0]
        self.arm = self.cell.arms[self.facts.individual]
        sheet = self.facts.sheet
        rate = sheet.number("torqueRate") if sheet.has("torqueRate") else np.inf
        self.judge = Judge(self.arm.limits, rate, self.cell.period_s)
        self.paced, self.condition, self.lose_every, self.cycle, self.silent = paced, 0, 0, 0, 0
        self.flip = 1.0
        self.commands, self.delay, self.is_commanded = 0, 0, False
        self.waiting: deque[Command] = deque()
        self.lock = threading.RLock()
        self._flange = self.cell.model.site(f"{self.cell.scene.names[self.facts.individual]}/flange").id
        gripper = None if self.facts.gripper is None else self.facts.gripper.individual
        self.hand = None if gripper is None else self.cell.gripper(gripper)
        self.hold()
        for _ in range(500):
            self.cell.advance_period()

    def state(self) -> Array:
        measured = self.arm.state()
        q, dq = measured.q, self.flip * measured.dq
        head = [self.cell.now, float(self.condition)]
        return np.concatenate([head, q, dq, q, measured.effort, self._wrench(measured)])

    def _wrench(self, measured: Any) -> Array:
        """Return the wrench (6,) of the sensor, moved from the tool centre point to the flange, along its axes."""
        data, base = self.cell.data, self.arm.base
        axes = data.site_xmat[self._flange].reshape(3, 3)
        force, moment = base.rotation @ measured.wrench[:3], base.rotation @ measured.wrench[3:]
        lever = base.apply(measured.tool.position) - data.site_xpos[self._flange]
        return np.concatenate([axes.T @ force, axes.T @ (moment + np.cross(lever, force))])

    def obey(self, frame: Array) -> None:
        operation = int(frame[0])
        if operation == COMMAND and self.condition == 1 and frame[1] in MADE:
            self.commands, self.silent, self.is_commanded = self.commands + 1, 0, True
            self.judge.check(float(frame[1]), frame[2:])
            self.waiting.append(MADE[float(frame[1])](frame[2:].copy()))
            while len(self.waiting) > self.delay:
                self.arm.command(self.waiting.popleft())
        elif operation == TAKE and self.condition == 0:
            self.condition, self.silent, self.is_commanded = 1, 0, False
            self.judge.begin()
            self.waiting.clear()
            self.arm.switch("torque" if frame[1] == 1.0 else "position" if frame[1] == 2.0 else "velocity")
        elif (operation == GIVE and self.condition == 1) or (operation == RECOVER and self.condition == 4):
            self.condition = 0
        elif operation == LOAD:
            mass, centre = float(frame[1]), (self.arm.fixed_tool.inverse() @ self.arm._flange).apply(frame[2:5])
            self.arm.set_load(None if mass == 0.0 else ArmLoad(mass, centre, HERE, HERE))

    @property
    def awaits_command(self) -> bool:
        """Whether it waits for a command beyond its period."""
        return not self.paced and self.condition == 1 and self.is_commanded and self.silent < PATIENT_CYCLES

    def put_wall(self, gap_m: float) -> None:
        """Put a soft wall before the tool."""
        from backends.backend import Wall

        assert self.facts.gripper is not None
        palm = part_name(self.cell.scene.names[self.facts.gripper.individual], "palm")
        self.cell.people = (Wall(self.cell, self.arm, palm, gap_m),)  # type: ignore[assignment]

    def remove_wall(self) -> None:
        """Take it away again."""
        self.cell.people = ()
        self.cell.data.xfrc_applied[:] = 0.0

    def hold(self) -> None:
        """Let the controller of the robot hold the joints from the next period on."""
        self.arm._motors.be_silent()

    def step(self) -> None:
        """Run a period; a controller that gets no commands for a while stops by itself."""
        self.silent += self.is_commanded
        self.cycle += 1
        if self.condition == 1 and self.silent > STOP_CYCLES:
            self.condition = 4
        if self.condition != 1 and not self.arm._motors.silent:
            self.hold()
        self.cell.advance_period()
        self._grip()

    def _grip(self) -> None:
        """Let what the fingers are blocked by move with the palm."""
        hand = self.hand
        if hand is None:
            return
        if hand.carries is None and hand.blocked:
            for thing in hand._things:
                if hand.touches(thing):
                    hand._carry(thing)
        elif hand.carries is not None and hand._goal > hand._true_opening_m + 2e-3:
            hand.drop()


class Panel:
    """What the operator, the fingers and the camera ask."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot

    def condition(self, kind: str) -> None:
        self._robot.condition = CONDITIONS.index(kind)

    def lose(self, every: int) -> None:
        self._robot.lose_every = every

    def delay(self, cycles: int) -> None:
        self._robot.delay = cycles

    def flip_speeds(self, on: int) -> None:
        self._robot.flip = -1.0 if on else 1.0

    def report(self) -> dict[str, Any]:
        robot = self._robot
        return {
            "violations": robot.judge.violations,
            "commands": robot.commands,
            "q": robot.arm.state().q.copy(),
            "dq": robot.arm.state().dq.copy(),
            "carries": None if robot.hand is None else robot.hand.carries,
            "condition": CONDITIONS[robot.condition],
            "coverage": {each: robot.cell.camera().inspect(each) for each in robot.cell.coverage},
            "time_s": robot.cell.now,
        }

    def move_fingers(self, opening_m: float, force_n: float) -> None:
        assert self._robot.hand is not None
        self._robot.hand.move(opening_m, force_n)

    def stop_fingers(self) -> None:
        assert self._robot.hand is not None
        self._robot.hand.stop()

    def fingers(self) -> tuple[float, bool, bool]:
        hand = self._robot.hand
        assert hand is not None
        return hand.opening_m, hand.moving, hand.blocked

    def home(self) -> Array:
        return self._robot.facts.home

    def put_wall(self, gap_m: float) -> Array:
        self._robot.put_wall(gap_m)
        return self._robot.cell.people[-1].normal

    def remove_wall(self) -> None:
        self._robot.remove_wall()

    def wall_force_n(self) -> float:
        people = self._robot.cell.people
        return float(people[-1].force_n) if people else 0.0

    def switched(self, button: str) -> bool:
        return self._robot.cell.button(button).switched

    def rubbed_share(self, surface: str, seconds: float) -> float:
        return self._robot.cell.camera().rubbed_share(surface, seconds)


def serve_panel(robot: Robot, listener: Listener) -> None:
    panel = Panel(robot)
    while True:
        threading.Thread(target=_serve_caller, args=(robot, panel, listener.accept()), daemon=True).start()


def _serve_caller(robot: Robot, panel: Panel, caller: Connection) -> None:
    try:
        while True:
            name, arguments = caller.recv()
            with robot.lock:
                answer = getattr(panel, name)(*arguments)
            caller.send(answer)
    except (EOFError, OSError):
        caller.close()


def receive(stream: socket.socket, size: int, until: float) -> Array | None:
    """Return a frame; None if there is none in time, and an empty one if nobody is there any more."""
    data = b""
    while len(data) < size:
        stream.settimeout(max(until - time.monotonic(), 1e-5) if not data else 1.0)
        try:
            more = stream.recv(size - len(data))
        except TimeoutError:
            return None
        except OSError:
            return np.empty(0)
        if not more:
            return np.empty(0)
        data += more
    return np.frombuffer(data)


def serve_stream(robot: Robot, stream: socket.socket) -> None:
    """Run the cycles of the robot for one client, until it has gone."""
    stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    size, due = 8 * (2 + robot.facts.home.size), time.monotonic()
    while True:
        due = max(due + robot.cell.period_s, time.monotonic())
        is_lost = robot.lose_every > 0 and robot.cycle % robot.lose_every == 0
        with robot.lock:
            state = robot.state()
        try:
            if not is_lost:
                stream.sendall(state.tobytes())
        except OSError:
            break
        longest = due if is_lost else time.monotonic() + PATIENCE_S
        while (frame := receive(stream, size, longest if robot.awaits_command else due)) is not None and frame.size:
            with robot.lock:
                robot.obey(frame)
            if frame[0] == COMMAND:
                break
        if frame is not None and not frame.size:
            break
        with robot.lock:
            robot.step()
        if (left := due - time.monotonic()) > 0.0:
            time.sleep(left)
    with robot.lock:
        robot.condition = 0 if robot.condition == 1 else robot.condition
        for _ in range(500):
            robot.step()


def main(arguments: Sequence[str]) -> None:
    scene, paced = arguments[0], arguments[1] == "paced"
    robot = Robot(scene, paced)
    if len(arguments) > 2:
        serve_truth(Path(arguments[2]), robot.cell.capabilities.truth, lambda: robot.cell.now)
    panel = Listener(("127.0.0.1", 0))
    threading.Thread(target=serve_panel, args=(robot, panel), daemon=True).start()
    with socket.create_server(("127.0.0.1", 0)) as server:
        print(server.getsockname()[1], panel.address[1], flush=True)
        while True:
            stream, _ = server.accept()
            serve_stream(robot, stream)
            stream.close()


if __name__ == "__main__":
    main(sys.argv[1:])
