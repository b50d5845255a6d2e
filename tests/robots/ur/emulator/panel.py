"""Port 30999, which no controller has: tests act on the robot here, and ask what it has seen. JSON, one line each."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from typing import Any

import numpy as np

from robots.ur.emulator.controller import Controller
from robots.ur.emulator.states import RobotMode

PORT = 30999


class Panel:
    """Does what a person, an obstacle or a cable would do."""

    def __init__(self, controller: Controller) -> None:
        self._controller = controller

    async def serve(self, host: str) -> asyncio.Server:
        """Listen."""
        return await asyncio.start_server(self._attend, host, PORT)

    async def _attend(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        while line := await reader.readline():
            words = json.loads(line)
            answer = self._do(words.pop("do"), **words)
            writer.write(json.dumps(answer).encode() + b"\n")
        writer.close()

    def _do(self, what: str, **words: Any) -> Any:
        controller, plant = self._controller, self._controller.plant
        asked: dict[str, Callable[[], Any]] = {
            "wall": lambda: plant.put_wall(words["gap_m"]).tolist(),
            "wall force": lambda: 0.0 if plant.wall is None else plant.wall.force_n,
            "inspect": lambda: plant.camera().inspect(words["surface"]),
            "rubbed": lambda: plant.camera().rubbed_share(words["surface"], words["seconds"]),
        }
        acts: dict[str, Callable[[], None]] = {
            "protect": lambda: controller.protect("a person stands in the way"),
            "press": controller.emergency_stop,
            "release": controller.release_emergency_stop,
            "power": controller.become_ready,
            "lose": lambda: controller.lose(RobotMode[words["mode"]]),
            "program": lambda: controller.load("def polish():\nend"),
            "stop": controller.stop_program,
            "remote": lambda: setattr(controller, "remote", words["on"]),
            "slider": lambda: setattr(controller, "slider", words["share"]),
            "input": lambda: setattr(controller.io, "inputs", words["bits"]),
            "analog": lambda: setattr(controller.io, "analog_inputs", words["values"]),
            "block": lambda: plant.put_between_fingers(words["thing"]),
            "remove wall": plant.remove_wall,
            "push": lambda: plant.push_hand(plant.arm_iri, np.array(words["force_n"])),
            "tell": lambda: None,
        }
        if what in asked:
            return asked[what]()
        acts[what]()
        return self._tell()

    def _tell(self) -> dict[str, Any]:
        controller, plant = self._controller, self._controller.plant
        return {
            "now": controller.now,
            "q": plant.q.tolist(),
            "dq": plant.dq.tolist(),
            "wrench": controller.wrench.tolist(),
            "payload": controller.payload,
            "runtime": controller.runtime.name,
            "mode": controller.robot_mode.name,
            "safety": controller.safety_mode.name,
            "why": controller.why,
            "commands": controller.limits.commands,
            "violations": controller.limits.violations,
            "most": controller.limits.most,
            "outputs": controller.io.outputs,
            "analog_outputs": controller.io.analog_outputs,
            "slider": controller.slider,
            "job": type(controller.motion.job).__name__,
            "loaded": len(controller.loaded),
            "opening_m": None if plant.hand is None else plant.hand._true_opening_m,
            "things": {plant.scene.names[each]: plant.where(each) for each in plant.movable},
            "carries": None if plant.hand is None else plant.hand.carries,
        }
