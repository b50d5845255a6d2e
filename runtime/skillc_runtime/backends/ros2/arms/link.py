"""The connection to an arm that ROS 2 drives, for its control process: joint states and wrench in, commands out."""

from __future__ import annotations

from dataclasses import dataclass
from time import monotonic
from typing import Any

import numpy as np

from skillc_runtime.backends.control_process.link import (
    KINDS,
    CommandView,
    ControlRefused,
    DeviceCondition,
    LinkAbilities,
    LinkLost,
    LinkMode,
    PointMass,
    StateView,
    WrenchKind,
)
from skillc_runtime.backends.ros2.arms.flange import FlangeModel
from skillc_runtime.backends.ros2.arms.joint_states import JointOrder
from skillc_runtime.backends.ros2.arms.tool_commands import make_commands
from skillc_runtime.backends.ros2.description import Description
from skillc_runtime.backends.ros2.facts import ArmInterface
from skillc_runtime.backends.ros2.session import Session, Subscription, describe_topic, plain_name
from skillc_runtime.devices.backend import BackendUnavailable, StopPersists

LOOK_S = 0.1
"""How often it is looked who else subscribes to the commands or publishes them, in s."""
LATE = 1.5
"""How many periods a new state is waited for before a cycle goes on with the last one."""
RECOVER_S, FIND_S = 1.5, 1.0
"""How long a service of the driver may take, and how long those who take commands are looked for, in s."""
READY, IN_CONTROL = DeviceCondition("ready"), DeviceCondition("in-control")


@dataclass(frozen=True, slots=True)
class Ros2Description:
    """An arm that ROS 2 drives; implements `LinkDescription`. `model` is the file of its model."""

    interface: ArmInterface
    model: str

    @property
    def name(self) -> str:
        """The arm and where its states come from."""
        return f"{self.interface.name} at {self.interface.states}"

    def make_link(self) -> Ros2Link:
        """Return a link that is not connected."""
        return Ros2Link(self.interface, self.model)


class Ros2Link:
    """One arm; implements `RobotLink`. The messages with joint states clock the loop."""

    def __init__(self, interface: ArmInterface, model: str) -> None:
        self._facts, self._model = interface, model
        self._order, self._flange = JointOrder(interface.joints), FlangeModel(model)
        self._session: Session | None = None
        self._condition, self._has_control, self._runs = READY, False, True
        self._mode: LinkMode = "tool" if interface.tool is not None else interface.mode
        self._wrench = np.zeros(6)
        self._stamp_s, self._next_look = np.nan, 0.0
        self._first_s: float | None = None

    @property
    def period_s(self) -> float:
        """The nominal time between two states in s."""
        return 1.0 / self._facts.rate_hz

    @property
    def abilities(self) -> LinkAbilities:
        """What the arm can do by its facts, and by its first state."""
        facts, effort = self._facts, self._order.values[2]
        return LinkAbilities(
            modes=("tool", "position") if self._mode == "tool" else (self._mode,),
            wrench=self._wrench_kind,
            measures_effort=facts.mode == "torque" and bool(np.isfinite(effort).all()),
            carries_weight=facts.carries_weight,
            tares=bool(facts.services.tare),
            silence_s=facts.timing.silence_s,
        )

    @property
    def _wrench_kind(self) -> WrenchKind:
        wrench = self._facts.wrench
        if wrench is None:
            return "none"
        return "with-weight" if wrench.has_weight else "with-held-weight"

    @property
    def condition(self) -> DeviceCondition:
        """The condition as of the last `read`."""
        return self._condition

    def connect(self) -> None:
        """Wait for the first state of each joint and the first wrench, with a new node if there is none.

        BackendUnavailable names what does not come. A node that is there goes on finding others by itself, and does not
        wait for them for long.
        """
        patience_s = RECOVER_S if self._session is not None else self._facts.timing.connect_s
        if self._session is None:
            self._open()
        self._order, self._force_seen, self._state_seen = JointOrder(self._facts.joints), -np.inf, -np.inf
        self._await_states(self._open_session(), patience_s)
        difference = self._description.find_difference(self._model, self._order.positions)
        if difference is not None:
            raise BackendUnavailable(f"{self._facts.name} is not the arm of its facts: {difference}")

    def read(self, state: StateView) -> None:
        """Wait for the next message with joint states, at most a little longer than their period; LinkLost."""
        session = self._open_session()
        end = monotonic() + LATE * self.period_s
        while not self._take() and (left := end - monotonic()) > 0:
            session.wait(left)
        now, silence = monotonic(), self._facts.timing.silence_s
        if now - self._state_seen > silence:
            self._lose(READY)
            raise LinkLost(f"{self._facts.states} has been silent for {now - self._state_seen:.2f} s")
        if self._forces is not None and now - self._force_seen > silence:
            self._lose(READY)
            raise LinkLost(f"{self._forces.topic} has been silent for {now - self._force_seen:.2f} s")
        if now >= self._next_look:
            self._next_look = now + LOOK_S
            self._look()
        self._fill(state)

    def write(self, command: CommandView) -> None:
        """Publish a command; nothing without control."""
        if self._has_control and self._condition is IN_CONTROL:
            problem = self._commands.send(KINDS[int(command.kind[0])], command)
            if problem is not None:
                self._lose(DeviceCondition("wrong-mode", problem))

    def take_control(self, mode: LinkMode) -> None:
        """Begin to publish commands; ControlRefused if nobody takes them, or somebody else publishes them."""
        if mode != self._mode:
            raise ControlRefused(f"{self._facts.name} takes {self._mode} commands by its facts, not {mode} commands")
        if not self._open_session().wait_until(self._is_free, FIND_S):
            raise ControlRefused(self._condition.sentence)
        if (problem := self._commands.fit()) is not None:
            raise ControlRefused(problem)
        self._commands.begin(self._order.positions)
        self._has_control, self._condition = True, IN_CONTROL

    def give_back(self) -> None:
        """Stop publishing commands, after one to stand still."""
        self._lose(READY if self._condition is IN_CONTROL else self._condition)

    def recover(self) -> None:
        """Ask the driver to let commands have effect again, if it offers that; StopPersists if it does not."""
        session, service = self._open_session(), self._facts.services.recover
        if self._runs:
            return
        if not service:
            raise StopPersists(f"{self._condition.sentence}; start its program, at its panel or by its driver")
        if (problem := session.call(service, RECOVER_S)) is not None:
            raise StopPersists(problem)
        if not session.wait_until(self._is_running, RECOVER_S):
            raise StopPersists(f"{self._facts.services.running} still says that commands have no effect")
        self._look()

    def set_load(self, hand: PointMass, held: PointMass) -> None:
        """Do nothing: what the arm carries is a setting of its driver."""

    def tare(self) -> None:
        """Let the wrench be 0 by the service of the driver; LinkLost if that does not succeed."""
        if (problem := self._open_session().call(self._facts.services.tare, RECOVER_S)) is not None:
            raise LinkLost(problem)

    def close(self) -> None:
        """Give control back and destroy the node."""
        if self._session is not None:
            self.give_back()
            self._session.close()
            self._session = None

    def _open(self) -> None:
        facts = self._facts
        self._session = session = Session(plain_name(f"skillc_{facts.name}"))
        reliable = facts.quality.reliable_states
        self._states = session.subscribe(facts.states, "sensor_msgs/msg/JointState", reliable)
        self._forces: Subscription | None = None
        if facts.wrench is not None:
            self._forces = session.subscribe(facts.wrench.topic, "geometry_msgs/msg/WrenchStamped", reliable)
        self._running: Subscription | None = None
        if facts.services.running:
            self._running = session.subscribe(facts.services.running, "std_msgs/msg/Bool", True, latched=True)
        self._description = Description(session, facts)
        self._commands = make_commands(facts, self._model, session)

    def _open_session(self) -> Session:
        if self._session is None:
            raise LinkLost(f"{self._facts.name} is not connected")
        return self._session

    def _await_states(self, session: Session, patience_s: float) -> None:
        """Wait for the first messages; BackendUnavailable names what is missing."""
        facts, node = self._facts, session.node

        def is_complete() -> bool:
            self._take()
            return not self._order.missing and (self._forces is None or self._force_seen > 0)

        if session.wait_until(is_complete, patience_s):
            return
        problems = []
        if self._order.seen is None:
            problems.append(describe_topic(node, facts.states, self._states.kind, offered=True))
        elif missing := self._order.describe_missing(facts.states):
            problems.append(missing)
        if self._forces is not None and self._force_seen < 0:
            problems.append(describe_topic(node, self._forces.topic, self._forces.kind, offered=True))
        raise BackendUnavailable(f"{facts.name} does not answer: {'; '.join(problems)}")

    def _take(self) -> bool:
        """Take all messages that have arrived; return whether there was a new state of the joints."""
        if self._forces is not None:
            while (force := self._forces.take()) is not None:
                self._take_wrench(force)
        if self._running is not None:
            while (flag := self._running.take()) is not None:
                self._runs = bool(flag.data)
        new = False
        while (message := self._states.take()) is not None:
            if self._order.read(message):
                new, self._state_seen = True, monotonic()
                self._stamp_s = self._date(message.header.stamp)
        return new and not self._order.missing

    def _date(self, stamp: Any) -> float:
        """Return when a message was measured, in s since the first one; now for one without a stamp."""
        measured = stamp.sec + 1e-9 * stamp.nanosec or self._state_seen
        if self._first_s is None:
            self._first_s = measured
        return measured - self._first_s

    def _take_wrench(self, message: Any) -> None:
        force, torque = message.wrench.force, message.wrench.torque
        self._wrench[:] = force.x, force.y, force.z, torque.x, torque.y, torque.z
        self._force_seen = monotonic()

    def _fill(self, state: StateView) -> None:
        q, dq, effort = self._order.values
        state.stamp_s[0], state.speed_share[0] = self._stamp_s, 1.0
        state.q[:], state.target[:] = q, q
        state.dq[:] = np.where(np.isfinite(dq), dq, 0.0)
        state.effort[:] = np.where(np.isfinite(effort), effort, 0.0)
        wrench = self._facts.wrench
        if wrench is None:
            state.wrench[:] = 0.0
            return
        state.wrench[:] = wrench.sign * self._wrench
        if wrench.in_base:
            self._flange.turn(state.wrench, q)

    def _is_free(self) -> bool:
        self._take()
        self._look()
        return self._condition is READY or self._condition is IN_CONTROL

    def _is_running(self) -> bool:
        self._take()
        return self._runs

    def _look(self) -> None:
        """See whether commands would have effect: who takes them, who else gives them, and what the driver says."""
        problem = self._commands.find_obstacle()
        if not self._runs:
            why = f"{self._facts.services.running} says that commands have no effect"
            self._lose(DeviceCondition("protective-stop", why))
        elif problem is not None:
            self._lose(problem)
        else:
            self._condition = IN_CONTROL if self._has_control else READY

    def _lose(self, condition: DeviceCondition) -> None:
        """Publish no more commands, after one to stand still: controllers of speeds and torques go on with the last."""
        if self._has_control:
            self._commands.rest(self._order.positions)
        self._has_control, self._condition = False, condition
