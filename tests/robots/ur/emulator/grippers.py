"""The text sockets of two kinds of grippers, whose fingers are those of the plant."""

from __future__ import annotations

import asyncio
import re

from robots.ur.emulator.plant import Plant

ROBOTIQ_PORT, WSG_PORT = 63352, 6310
STEPS = 255


class RobotiqPort:
    """The socket of Robotiq's URCap: `SET` and `GET` of variables, answers without line ends."""

    def __init__(self, plant: Plant) -> None:
        self._plant = plant
        self._values = {"ACT": 1, "GTO": 0, "POS": 0, "SPE": 0, "FOR": 0, "PRE": 0}

    async def serve(self, host: str) -> asyncio.Server:
        """Listen."""
        return await asyncio.start_server(self._attend, host, ROBOTIQ_PORT)

    async def _attend(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        while line := await reader.readline():
            writer.write(self._answer(line.decode().split()).encode())
        writer.close()

    def _answer(self, words: list[str]) -> str:
        match words:
            case ["SET", *pairs]:
                self._values |= dict(zip(pairs[::2], map(int, pairs[1::2]), strict=True))
                self._act()
                return "ack"
            case ["GET", name]:
                return f"{name} {self._tell(name)}"
        return "?"

    def _act(self) -> None:
        hand = self._plant.hand
        assert hand is not None
        self._values["PRE"] = self._values["POS"]
        if not self._values["GTO"]:
            hand.stop()
            return
        opening = hand.max_opening_m * (1.0 - self._values["POS"] / STEPS)
        hand.move(opening, hand.max_force_n * self._values["FOR"] / STEPS)

    def _tell(self, name: str) -> int:
        hand = self._plant.hand
        assert hand is not None
        match name:
            case "POS":
                return round(STEPS * (1.0 - hand.opening_m / hand.max_opening_m))
            case "STA":
                return 3 if self._values["ACT"] else 0
            case "OBJ":
                return 0 if hand.moving else 2 if hand.blocked else 3
            case "FLT":
                return 0
        return self._values[name]


class WsgPort:
    """The text interface of a WSG gripper; an order ends when the fingers are at rest."""

    def __init__(self, plant: Plant) -> None:
        self._plant, self._state = plant, "IDLE"

    async def serve(self, host: str) -> asyncio.Server:
        """Listen."""
        return await asyncio.start_server(self._attend, host, WSG_PORT)

    async def _attend(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        while line := await reader.readline():
            text = line.decode().strip()
            if text.endswith("?"):
                writer.write(f"{self._tell(text[:-1])}\n".encode())
            elif (found := re.fullmatch(r"([A-Z]+)\(([\d.]*)\)", text)) is None:
                writer.write(b"ERR CMD_UNKNOWN\n")
            else:
                await self._obey(found[1], float(found[2] or 0.0), writer)
        writer.close()

    async def _obey(self, name: str, value: float, writer: asyncio.StreamWriter) -> None:
        hand = self._plant.hand
        assert hand is not None
        if name == "MOVE" and self._state == "HOLDING":
            writer.write(b"ERR MOVE E_ACCESS_DENIED\n")
            return
        writer.write(f"ACK {name}\n".encode())
        match name:
            case "GRIP":
                hand.move(0.0, value or hand.max_force_n)
                self._state = "GRIPPING"
            case "MOVE":
                hand.move(value / 1e3, hand.max_force_n)
                self._state = "POSITIONING"
            case "RELEASE":
                hand.move(hand.opening_m + value / 1e3, hand.max_force_n)
                self._state = "RELEASING"
            case "STOP":
                hand.stop()
                self._state = "IDLE"
        asyncio.get_running_loop().create_task(self._end(name, writer))

    async def _end(self, name: str, writer: asyncio.StreamWriter) -> None:
        hand = self._plant.hand
        assert hand is not None
        while hand.moving:
            await asyncio.sleep(0.005)
        if name == "GRIP":
            self._state = "HOLDING" if hand.blocked else "NO PART"
            writer.write(b"FIN GRIP\n" if hand.blocked else b"ERR GRIP E_CMD_FAILED\n")
            return
        self._state = "IDLE" if name in ("MOVE", "RELEASE", "STOP") else self._state
        writer.write(f"FIN {name}\n".encode())

    def _tell(self, name: str) -> str:
        hand = self._plant.hand
        assert hand is not None
        states = ("IDLE", "GRIPPING", "NO PART", "PART LOST", "HOLDING", "RELEASING", "POSITIONING", "ERROR")
        if name == "POS":
            return f"POS={1e3 * hand.opening_m:.2f}"
        if self._state == "HOLDING" and not hand.moving and not hand.blocked:
            self._state = "PART LOST"
        return f"{name}={states.index(self._state)}"
