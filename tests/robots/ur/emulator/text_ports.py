"""Ports 29999 and 30001 to 30003: the dashboard server, and the client interfaces that take programs."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from robots.ur.emulator.controller import Controller, Refused

SCRIPT_PORTS = (30001, 30002, 30003)


class Dashboard:
    """The dashboard server: one line asks, one line answers."""

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        version = ".".join(map(str, controller.settings.version))
        self._answers: dict[str, Callable[[], str]] = {
            "polyscopeversion": lambda: f"URSoftware {version} (Nov 01 2025)",
            "version": lambda: version,
            "get robot model": lambda: controller.model,
            "get serial number": lambda: "20205500001",
            "is in remote control": lambda: str(controller.remote).lower(),
            "get operational mode": lambda: "NONE",
            "robotmode": lambda: f"Robotmode: {controller.robot_mode.name}",
            "safetymode": lambda: f"Safetymode: {controller.safety_mode.name}",
            "safetystatus": lambda: f"Safetystatus: {controller.safety_mode.name}",
            "programstate": lambda: f"{controller.runtime.name} rtde_control",
            "running": lambda: f"Program running: {str(controller.runtime.name == 'PLAYING').lower()}",
            "stop": lambda: self._try(controller.stop_program, "Stopped"),
            "power on": lambda: self._try(controller.power_on, "Powering on"),
            "power off": lambda: self._try(controller.power_off, "Powering off"),
            "brake release": lambda: self._try(controller.release_brakes, "Brake releasing"),
            "unlock protective stop": lambda: self._try(controller.unlock, "Protective stop releasing"),
            "close safety popup": lambda: "closing safety popup",
            "restart safety": lambda: self._try(controller.restart_safety, "Restarting safety"),
            "quit": lambda: "Disconnected",
        }

    async def serve(self, host: str) -> asyncio.Server:
        """Listen."""
        return await asyncio.start_server(self._attend, host, 29999)

    async def _attend(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        writer.write(b"Connected: Universal Robots Dashboard Server\n")
        while line := await reader.readline():
            answer = self._answers.get(line.decode().strip().lower())
            writer.write((answer() if answer else f"could not understand: '{line.decode().strip()}'").encode() + b"\n")
        writer.close()

    def _try(self, act: Callable[[], None], done: str) -> str:
        try:
            act()
        except Refused as refused:
            return str(refused)
        return done


class ScriptPort:
    """Takes programs in URScript, from `def name():` to `end` at the first column."""

    def __init__(self, controller: Controller) -> None:
        self._controller = controller

    async def serve(self, host: str) -> list[asyncio.Server]:
        """Listen."""
        return [await asyncio.start_server(self._attend, host, port) for port in SCRIPT_PORTS]

    async def _attend(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        program: list[str] = []
        while line := await reader.readline():
            text = line.decode().rstrip("\r\n")
            if program or text.startswith(("def ", "sec ")):
                program.append(text)
            if text == "end" and program:
                self._controller.load("\n".join(program))
                program = []
        writer.close()
