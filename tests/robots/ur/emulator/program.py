"""The program that the client library uploads: it obeys a command register, one command at a time.

The emulator does not interpret URScript. It knows what this program does with its registers: integer input 0 is the
command, the inputs that follow its arguments, and integer output 0 says 1 for ready and 2 for done.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from robots.ur.emulator.kinematics import write_pose
from robots.ur.emulator.motion import Force, Servo, Speed, Stop

if TYPE_CHECKING:
    from robots.ur.emulator.controller import Controller

READY, DONE = 1, 2
FORCE_MODE, SPEED_J, SERVO_J, TELL_FLANGE, KICK = 6, 9, 11, 58, 99
END = 255


class Program:
    """The uploaded program."""

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        self._busy, self._watchdog_hz, self._heard_at, self._is_of_client = False, 0.0, -1.0, False
        self._at_once: dict[int, Callable[[], None]] = {
            FORCE_MODE: self._force_mode, SPEED_J: self._speed, SERVO_J: self._servo,
            KICK: lambda: None, TELL_FLANGE: self._tell_flange,
        }  # fmt: skip
        self._others: dict[int, Callable[[], None]] = {
            7: lambda: self._stop(10.0), 8: controller.tare, 15: lambda: self._stop(self._float(0)),
            16: lambda: self._stop(self._float(0)), 17: self._set_payload, 65: self._set_payload, 29: self._set_tcp,
            31: lambda: controller.protect("the program has asked for it"), 33: lambda: self._stop(self._float(0)),
            34: lambda: self._stop(self._float(0)), 35: self._set_watchdog, 40: self._tell_tcp, 47: self._tell_steady,
        }  # fmt: skip

    def start(self, text: str) -> None:
        """Begin from the first line."""
        self._is_of_client, self._busy, self._watchdog_hz = "rtde_cmd" in text, False, 0.0
        if not self._is_of_client:
            return
        self._controller.inputs["input_int_register_0"] = 0
        self._say(READY)

    def cycle(self) -> None:
        """Obey the command register once; the program of somebody else does not."""
        if not self._is_of_client:
            return
        controller, command = self._controller, int(self._controller.inputs.get("input_int_register_0", 0))
        heard = controller.heard_at.get("input_int_register_0", controller.now)
        if self._watchdog_hz > 0.0 and controller.now - heard > 1.0 / self._watchdog_hz:
            controller.why = "the watchdog of the program has expired"
            controller.stop_program()
        elif command in self._at_once:
            self._at_once[command]()
            self._say(READY)
        elif command == END:
            controller.stop_program()
        elif command == 0:
            self._busy = False
            self._say(READY)
        elif not self._busy:
            self._busy = True
            self._others[command]()
            self._say(DONE)

    def _say(self, state: int) -> None:
        self._controller.registers["output_int_register_0"] = state

    def _float(self, index: int) -> float:
        return float(self._controller.inputs.get(f"input_double_register_{index}", 0.0))

    def _floats(self, first: int, count: int = 6) -> np.ndarray:
        return np.array([self._float(first + i) for i in range(count)])

    def _servo(self) -> None:
        controller, q = self._controller, self._floats(0)
        if not isinstance(controller.motion.job, Servo):
            controller.limits.start()
        problem = None
        if (heard := controller.heard_at["input_int_register_0"]) != self._heard_at:
            self._heard_at = heard
            problem = controller.limits.check_target(controller.cycles, q, controller.plant.q)
        controller.motion.job = Servo(q, self._float(9), self._float(10))
        if problem is not None:
            controller.protect(problem)

    def _speed(self) -> None:
        self._controller.motion.job = Speed(self._floats(0), self._float(6))

    def _force_mode(self) -> None:
        ints = np.array([float(self._controller.inputs.get(f"input_int_register_{i}", 0)) for i in range(2, 8)])
        self._controller.motion.job = Force(ints, self._floats(6), self._floats(12))

    def _stop(self, deceleration: float) -> None:
        self._controller.motion.job = Stop(deceleration)

    def _set_payload(self) -> None:
        self._controller.payload, self._controller.centre = self._float(0), self._floats(1, 3)

    def _set_tcp(self) -> None:
        self._controller.tcp = self._floats(0)

    def _set_watchdog(self) -> None:
        self._watchdog_hz = self._float(0)

    def _tell_tcp(self) -> None:
        for i, value in enumerate(self._controller.tcp):
            self._controller.registers[f"output_double_register_{i}"] = float(value)

    def _tell_flange(self) -> None:
        for i, value in enumerate(write_pose(self._controller.flange(), np.zeros(3))):
            self._controller.registers[f"output_double_register_{i}"] = value

    def _tell_steady(self) -> None:
        steady = np.abs(self._controller.plant.dq).max() < 1e-3
        self._controller.registers["output_int_register_1"] = int(steady)
