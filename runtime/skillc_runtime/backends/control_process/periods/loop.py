"""The loop of a control process: it reads the device, commands it, watches both sides, and answers calls."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic, sleep
from typing import Any

from skillc_runtime.backends.control_process.calls import CALLS_A_CYCLE_SHARE, Mailbox, RemoteAnswer, RemoteCall
from skillc_runtime.backends.control_process.handshake import Patience
from skillc_runtime.backends.control_process.link import (
    CALL_S,
    ControlRefused,
    DeviceCondition,
    LinkLost,
    RobotLink,
    make_state,
)
from skillc_runtime.backends.control_process.memory_plan import MemoryPlan
from skillc_runtime.backends.control_process.periods.call_desk import CallDesk
from skillc_runtime.backends.control_process.periods.controlled_arm import ControlledArm
from skillc_runtime.backends.control_process.periods.pacing import CycleClock
from skillc_runtime.backends.control_process.periods.publisher import StatePublisher
from skillc_runtime.backends.control_process.snapshot import Phase
from skillc_runtime.control.measured import is_still
from skillc_runtime.devices.arm import ArmLoad
from skillc_runtime.devices.backend import BackendUnavailable, DeviceStop, StopPersists
from skillc_runtime.motion.arrays import OutVector

BRAKING_S = 2.0
"""At the end an arm is controlled until it is at rest, or for this time."""

LOST_S = 0.005
"""How often a loop without a device looks for calls, in s."""


class ControlLoop:
    """Controls one arm through its link, which is connected, until nobody calls any more. Starts without control."""

    def __init__(
        self,
        link: RobotLink,
        arm: ControlledArm,
        mailbox: Mailbox,
        plan: MemoryPlan,
        memory: OutVector,
        patience: Patience,
    ) -> None:
        self._link, self._arm, self._mailbox, self._desk = link, arm, mailbox, CallDesk(arm)
        self._beat, self._patience = plan.beat(memory), patience
        self._measured, self._clock = make_state(plan.layout.joints), CycleClock(link.period_s)
        self._publisher = StatePublisher(plan, memory, arm, self._measured, self._clock)
        self._phase: Phase = "connected"
        self._condition: DeviceCondition | None = None
        self._seen = self._rested = monotonic()
        self._ending_since: float | None = None
        self._is_tree_silent = self._is_excused = False

    def begin(self) -> None:
        """Read and publish the first state."""
        self._run_cycle()

    def run(self) -> None:
        """Run until the other side has gone and the arm is at rest; then give the arm back."""
        try:
            while not self._is_over():
                self._run_cycle()
                self._answer_calls()
        finally:
            self._link.close()

    def _is_over(self) -> bool:
        """Tell whether nobody calls any more, and the arm, which is stopped then, is at rest."""
        if not self._mailbox.closed:
            return False
        if self._ending_since is None:
            self._ending_since = monotonic()
            self._arm.driver.abort("nobody is in charge of the arm any more")
        still = self._phase != "in-control" or self._arm.driver.at_rest
        return still or self._seen > self._ending_since + BRAKING_S

    def _run_cycle(self) -> None:
        if self._phase == "lost":
            sleep(LOST_S)
            self._seen = monotonic()
        else:
            try:
                self._serve_device()
            except LinkLost as lost:
                self._lose(str(lost))
        self._watch_tree()
        self._publisher.publish(self._phase, self._seen)

    def _serve_device(self) -> None:
        link, measured, asked = self._link, self._measured, monotonic()
        gap = asked - self._seen
        link.read(measured)
        self._seen = monotonic()
        self._clock.advance(float(measured.stamp_s[0]), self._seen)
        self._look_at_condition()
        if self._phase != "in-control":
            self._arm.look(measured, self._clock.now_s)
            return
        self._check_gap(gap, self._seen - asked)
        link.write(self._arm.step(measured, self._clock.now_s))
        if self._arm.stop is None or self._arm.driver.measured.still:
            self._rested = self._seen
        elif self._seen > self._rested + self._patience.brake_s:
            self._let_go(self._arm.stop)

    def _let_go(self, stop: DeviceStop) -> None:
        """Give back an arm that does not come to rest after a stop."""
        self._arm.stop = DeviceStop(stop.kind, f"{stop.reason}; it did not come to rest, so control was given back")
        self._give_back()

    def _check_gap(self, gap: float, waited: float) -> None:
        """Hold the arm if the loop has not run for too long, in s, before it asked the device or while it waited."""
        if self._is_excused:
            self._is_excused = False
        elif max(gap, waited - self._link.abilities.silence_s) > self._patience.gap_s:
            self._stop(f"the loop of the arm has not run for {max(gap, waited):.2f} s")

    def _look_at_condition(self) -> None:
        """Stop when the device has left control by itself, and keep why; an emergency stop is kept in any case."""
        condition = self._link.condition
        if condition is self._condition:
            return
        self._condition = condition
        kind: Any = condition.kind
        if kind in ("protective-stop", "emergency-stop"):
            self._arm.report(DeviceStop(kind, condition.sentence))
        if self._phase == "in-control" and kind != "in-control":
            self._phase = "connected"
            reason = condition.sentence or "the device has taken control back"
            self._arm.driver.hold_still(reason)
            self._arm.report(DeviceStop("protective-stop", reason))

    def _watch_tree(self) -> None:
        silent_s = self._seen - self._beat[0]
        if silent_s > self._patience.tree_s and not self._is_tree_silent and self._ending_since is None:
            reason = f"the process of the tree has been silent for {silent_s:.2f} s"
            self._arm.driver.abort(reason)
            self._arm.report(DeviceStop("protective-stop", reason))
        self._is_tree_silent = silent_s > self._patience.tree_s

    def _lose(self, reason: str) -> None:
        self._phase = "lost"
        self._stop(reason)

    def _stop(self, reason: str) -> None:
        self._arm.driver.hold_still(reason)
        self._arm.report(DeviceStop("protective-stop", reason))

    def _answer_calls(self) -> None:
        """Answer calls while the period is young; what waits longer is answered in the next one."""
        until = self._seen + CALLS_A_CYCLE_SHARE * self._link.period_s
        while (call := self._mailbox.take()) is not None:
            answer = self._answer(call)
            self._publisher.publish_at_once(self._phase, monotonic())
            self._mailbox.answer(answer)
            if monotonic() > until:
                break

    def _answer(self, call: RemoteCall) -> RemoteAnswer:
        try:
            if call.part == "device":
                return RemoteAnswer(call.number, self._call_device(call))
            return RemoteAnswer(call.number, self._desk.call(call))
        except LinkLost as lost:
            self._lose(str(lost))
            return RemoteAnswer(call.number, error=ControlRefused(str(lost)))
        except Exception as error:  # noqa: BLE001  the boundary to the other process, which raises it
            return RemoteAnswer(call.number, error=error)

    def _call_device(self, call: RemoteCall) -> Any:
        match call.name, call.arguments:
            case "explain", ():
                return self._arm.stop
            case "condition", ():
                return self._link.condition
        slow: dict[str, Callable[..., None]] = {
            "take_control": self._take_control,
            "give_back": self._give_back,
            "recover": self._recover,
            "set_load": self._set_load,
            "tare": self._tare,
        }
        self._publisher.publish_at_once(self._phase, monotonic(), busy_until_s=monotonic() + 3 * CALL_S)
        self._is_excused = True
        slow[call.name](*call.arguments)
        self._arm.look(self._measured, self._clock.now_s)
        return None

    def _take_control(self) -> None:
        """Take control; a device that refuses it counts as stopped, until somebody acknowledges that."""
        if self._arm.stop is not None:
            raise ControlRefused(self._arm.stop.reason)
        if self._phase == "in-control":
            return
        try:
            self._begin_control()
        except ControlRefused as refusal:
            self._arm.report(DeviceStop("protective-stop", str(refusal)))
            raise

    def _begin_control(self) -> None:
        self._await_rest()
        condition = self._link.condition
        if condition.kind not in ("ready", "in-control"):
            raise ControlRefused(condition.sentence)
        self._arm.begin(self._measured, self._clock.now_s)
        self._link.set_load(self._arm.arm.hand, self._arm.arm.held)
        self._link.take_control(self._arm.link_mode)
        self._condition, self._phase = self._link.condition, "in-control"

    def _await_rest(self) -> None:
        """Read the device until the arm stands still, or has not come to rest in time."""
        until = monotonic() + self._patience.settle_s
        while True:
            self._link.read(self._measured)
            self._look_at_condition()
            if is_still(self._measured.dq) or monotonic() > until:
                break

    def _give_back(self) -> None:
        if self._phase == "in-control":
            self._link.give_back()
            self._condition, self._phase = self._link.condition, "connected"

    def _recover(self) -> None:
        """Connect again if the device was lost, acknowledge a stop, and take control; StopPersists."""
        try:
            if self._phase == "lost":
                self._link.connect()
                self._phase = "connected"
                self._link.read(self._measured)  # Its condition may be another one than before.
            if self._phase == "connected":
                self._link.recover()
                self._link.read(self._measured)
            self._arm.recover()
            self._take_control()
        except (BackendUnavailable, ControlRefused, LinkLost) as error:
            self._arm.report(DeviceStop("protective-stop", str(error)))
            raise StopPersists(str(error)) from error

    def _set_load(self, load: ArmLoad | None, opening_m: float | None = None) -> None:
        if opening_m is not None:
            self._arm.arm.set_fingers(opening_m)
        self._arm.arm.set_load(load)
        self._link.set_load(self._arm.arm.hand, self._arm.arm.held)

    def _tare(self) -> None:
        if self._link.abilities.tares:
            self._link.tare()
            self._link.read(self._measured)  # What was measured before has the old zero.
        else:
            self._arm.arm.tare()
