"""The program of a control process: it builds the arm, connects to its device, and runs the loop.

It is started with the numbers of a connected socket and of the memory that it shares. The first message is the path of
modules, the second a `ControlTask`; the answer is `Connected`, or the error for which there can be no cell.
"""

from __future__ import annotations

import signal
import socket
import sys

import numpy as np

from skillc_runtime.backends.control_process.calls import Mailbox
from skillc_runtime.backends.control_process.handshake import Connected, ControlTask
from skillc_runtime.backends.control_process.link import RobotLink, make_state
from skillc_runtime.backends.control_process.memory_plan import MemoryPlan
from skillc_runtime.backends.control_process.message_socket import MessageSocket
from skillc_runtime.backends.control_process.periods.controlled_arm import ControlledArm
from skillc_runtime.backends.control_process.periods.loop import ControlLoop
from skillc_runtime.backends.control_process.shared_memory import map_memory
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.guarded_push import GuardedPush, Travel
from skillc_runtime.motion.numerics.compiled import compile_imported
from skillc_runtime.platforms.real_time import run_in_real_time

PERIODS = 20

START_S = 60.0
"""How long the other process may take to say what is to be done, in s."""


def main(messages: MessageSocket, memory_file: int) -> int:
    """Run a control process; return its exit code."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.path[:] = messages.receive(START_S)
    memory = map_memory(memory_file)
    try:
        task: ControlTask = messages.receive(START_S)
        plan = MemoryPlan(task.facts.home.size)
        compile_imported()
        link = task.description.make_link()
        link.connect()
        try:
            arm = ControlledArm(task.facts, task.names, link.abilities, link.period_s)
            _rehearse(task.facts, task.names, link)
        except BaseException:
            link.close()
            raise
    except Exception as error:  # noqa: BLE001  the boundary to the other process, which raises it
        messages.send(error)
        return 1
    mailbox = Mailbox(messages)
    loop = ControlLoop(link, arm, mailbox, plan, memory, task.patience)
    signal.signal(signal.SIGTERM, lambda *_: mailbox.close())  # The loop stops the arm between two periods.
    real_time = run_in_real_time()
    loop.begin()
    messages.send(Connected(link.period_s, link.abilities, arm.mode, arm.arm.limits, real_time))
    loop.run()
    return 0


def _rehearse(facts: ArmSpec, names: dict[str, str], link: RobotLink) -> None:
    """Control a copy of the arm that stays at home, with its joints, its tool and a push, one after the other."""
    arm, measured = ControlledArm(facts, names, link.abilities, link.period_s), make_state(facts.home.size)
    measured.buffer[:], measured.speed_share[:] = 0.0, 1.0
    measured.q[:] = measured.target[:] = facts.home
    now = 0.0

    def run() -> None:
        nonlocal now
        for _ in range(PERIODS):
            now += link.period_s
            arm.step(measured, now)

    arm.begin(measured, now)
    run()
    arm.driver.motion.hold_position()
    run()
    along = arm.driver.measured.pose.rotation[:, 2].copy()
    arm.driver.compliance.release(along)
    push = arm.driver.compliance.start_push(GuardedPush(-along, 1.0, 0.01, Travel(0.1)))
    run()
    arm.driver.compliance.end_push(push)
    arm.driver.compliance.restore()
    run()
    assert np.isfinite(arm.driver.measured.q).all()


if __name__ == "__main__":
    sys.exit(main(MessageSocket(socket.socket(fileno=int(sys.argv[1]))), int(sys.argv[2])))
