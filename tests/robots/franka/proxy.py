"""Stands between a client and a robot on loopback: checks every command, loses and delays packets, and stops the robot.

    python -m robots.franka.proxy ADDRESS ROBOT

"ready" is printed when it listens on ADDRESS. Lines on standard input: `drop SHARE` and `delay MS` of packets of both
directions; `strict`: stop as a robot does that has had no command for `LOST_IN_ROW` states; `reflex ERROR` and
`user-stop`, as a robot does it, which the simulated one does not; `mode NUMBER`: say to be in that mode of libfranka;
`release` ends all modes; `swap I J`: exchange two joints in all states, none if I is J; `report` is answered with one
line of JSON. The layouts of packets are those of libfranka's message types.
"""

from __future__ import annotations

import heapq
import json
import os
import random
import select
import socket
import struct
import sys
from time import monotonic
from typing import Any

import numpy as np

from robots.franka.checker import DQ, EFFORT, Checker, Q, Report
from robots.priority import run_promptly

ROBOT, HAND = 1337, 1338
HEADERS = {ROBOT: struct.Struct("<III"), HAND: struct.Struct("<HII")}
CONNECT, MOVE, STOP, RECOVER = 0, 1, 2, 10
OWN_ID = 0x7FFFFFF0
REFLEX, USER_STOPPED = 4, 5
MODES = {"reflex": REFLEX, "user-stop": USER_STOPPED}
ABORTED = {REFLEX: 8, USER_STOPPED: 3}
NOT_POSSIBLE = 5
ERRORS = {"joint_reflex": 6, "cartesian_reflex": 7, "communication_constraints_violation": 25}
MODE = -5
ERROR_FLAGS, REASON_FLAGS = -87, -46


class Framed:
    """Splits a stream of TCP into messages of a header and a payload."""

    def __init__(self, header: struct.Struct) -> None:
        self._header, self._waiting = header, b""

    def feed(self, data: bytes) -> list[tuple[int, int, bytes]]:
        self._waiting += data
        found = []
        while len(self._waiting) >= self._header.size:
            command, number, size = self._header.unpack_from(self._waiting)
            if len(self._waiting) < size:
                break
            found.append((command, number, self._waiting[:size]))
            self._waiting = self._waiting[size:]
        return found


class Relay:
    """One client at one port of the robot: its TCP connection and the UDP packets that belong to it."""

    def __init__(self, proxy: Proxy, port: int, client: socket.socket) -> None:
        self.port, self._proxy, self.client, self._header = port, proxy, client, HEADERS[port]
        self.server = socket.socket()
        self.server.bind((proxy.address, 0))
        self.server.connect((proxy.robot, port))
        for each in (client, self.server):
            each.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.up, self.down = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
        for each in (self.up, self.down):
            each.bind((proxy.address, 0))
            each.setblocking(False)
        self._from_client, self._from_server = Framed(self._header), Framed(self._header)
        self._client_at: tuple[str, int] | None = None
        self._server_at: tuple[str, int] | None = None
        self.motion: int | None = None

    @property
    def sockets(self) -> tuple[socket.socket, ...]:
        return self.client, self.server, self.up, self.down

    def close(self) -> None:
        for each in self.sockets:
            each.close()

    def serve(self, ready: socket.socket) -> bool:
        """Pass on what has arrived; return whether the connection goes on."""
        if ready is self.up:
            self._pass_states()
        elif ready is self.down:
            self._pass_commands()
        else:
            try:
                data = ready.recv(1 << 16)
            except OSError:
                return False
            if not data:
                return False
            if ready is self.client:
                self._pass_requests(data)
            else:
                self._pass_answers(data)
        return True

    def abort_motion(self, status: int) -> None:
        """Tell the client that its motion has ended, and stop it at the robot."""
        if self.motion is not None:
            self.client.sendall(self._answer(MOVE, self.motion, status))
            self.server.sendall(self._header.pack(STOP, OWN_ID, self._header.size))
            self.motion = None

    def _answer(self, command: int, number: int, status: int) -> bytes:
        return self._header.pack(command, number, self._header.size + 1) + bytes([status])

    def _pass_requests(self, data: bytes) -> None:
        for command, number, message in self._from_client.feed(data):
            if command == CONNECT:
                version, port = struct.unpack_from("<HH", message, self._header.size)
                self._client_at = self.client.getpeername()[0], port
                ours = struct.pack("<HH", version, self.up.getsockname()[1])
                message = message[: self._header.size] + ours + message[self._header.size + 4 :]
            elif self.port == ROBOT and command == MOVE:
                if self._proxy.mode is not None:
                    self.client.sendall(self._answer(MOVE, number, NOT_POSSIBLE))
                    continue
                self.motion = number
                self._proxy.checker.begin()
            elif self.port == ROBOT and command == RECOVER and self._proxy.mode == REFLEX:
                self._proxy.mode = None
            self.server.sendall(message)

    def _pass_answers(self, data: bytes) -> None:
        for command, number, message in self._from_server.feed(data):
            if self.port == ROBOT and command == MOVE and message[self._header.size] != 1:
                if number != self.motion:
                    continue  # The client was told already.
                self.motion = None
            if number != OWN_ID:
                self.client.sendall(message)

    def _pass_states(self) -> None:
        for packet, sender in _received(self.up):
            self._server_at = sender
            if self.port == ROBOT:
                packet = self._proxy.patch(packet)
                if self.motion is not None and self._proxy.checker.see_state(packet) and self._proxy.strict:
                    self._proxy.stop(REFLEX, "communication_constraints_violation")
            if self._client_at is not None:
                self._proxy.send(self.down, packet, self._client_at)

    def _pass_commands(self) -> None:
        for packet, _ in _received(self.down):
            if self.motion is not None:
                self._proxy.checker.see_command(packet)
            if self._server_at is not None:
                self._proxy.send(self.up, packet, self._server_at)


class Proxy:
    """All connections, and what is done to them."""

    def __init__(self, address: str, robot: str) -> None:
        self.address, self.robot, self.report = address, robot, Report()
        self.checker, self.strict = Checker(self.report), False
        self.mode: int | None = None
        self._swapped, self._begun = (0, 0), b""
        self._error, self._drop, self._delay = 0, 0.0, 0.0
        self._waiting: list[tuple[float, int, socket.socket, bytes, Any]] = []
        self._sent, self._chance = 0, random.Random(1)
        self._relays: dict[socket.socket, Relay] = {}
        self._listening = {}
        for port in HEADERS:
            listener = socket.create_server((address, port), backlog=4)
            self._listening[listener] = port

    def patch(self, packet: bytes) -> bytes:
        """Return a state as a robot in this mode would send it."""
        one, other = self._swapped
        if self.mode is None and one == other:
            return packet
        changed = bytearray(packet)
        for joints in (Q, DQ, EFFORT):
            values = np.frombuffer(packet[joints], dtype="<f4").copy()
            values[[one, other]] = values[[other, one]]
            changed[joints] = values.tobytes()
        if self.mode is None:
            return bytes(changed)
        changed[MODE] = self.mode
        if self.mode == REFLEX:
            changed[len(packet) + ERROR_FLAGS + self._error] = changed[len(packet) + REASON_FLAGS + self._error] = 1
        return bytes(changed)

    def send(self, sender: socket.socket, packet: bytes, to: tuple[str, int]) -> None:
        """Send a packet, later or not at all if that is asked for."""
        if self._drop and self._chance.random() < self._drop:
            self.report.dropped += 1
        elif self._delay:
            self._sent += 1
            heapq.heappush(self._waiting, (monotonic() + self._delay, self._sent, sender, packet, to))
        else:
            sender.sendto(packet, to)

    def stop(self, mode: int, error: str = "") -> None:
        """Do as a robot that stops by itself."""
        self.mode, self._error = mode, ERRORS.get(error, 0)
        for relay in set(self._relays.values()):
            if relay.port == ROBOT:
                relay.abort_motion(ABORTED[mode])

    def run(self) -> None:
        while True:
            due = max(self._waiting[0][0] - monotonic(), 0.0) if self._waiting else None
            ready, _, _ = select.select([sys.stdin, *self._listening, *self._relays], [], [], due)
            while self._waiting and self._waiting[0][0] <= monotonic():
                _, _, sender, packet, to = heapq.heappop(self._waiting)
                sender.sendto(packet, to)
            for each in ready:
                if each is sys.stdin:
                    if not (orders := os.read(sys.stdin.fileno(), 1 << 16)):
                        return
                    self._take(orders)
                elif each in self._listening:
                    relay = Relay(self, self._listening[each], each.accept()[0])
                    self._relays.update(dict.fromkeys(relay.sockets, relay))
                elif (relay := self._relays.get(each)) is not None and not relay.serve(each):
                    for gone in relay.sockets:
                        del self._relays[gone]
                    self._waiting = [one for one in self._waiting if one[2] not in relay.sockets]
                    heapq.heapify(self._waiting)
                    relay.close()

    def _take(self, orders: bytes) -> None:
        """Obey all complete lines: `select` does not report lines that are already in a buffer of Python."""
        *lines, self._begun = (self._begun + orders).split(b"\n")
        for line in lines:
            self._obey(*line.decode().split())

    def _obey(self, order: str, value: str = "", other: str = "") -> None:
        match order:
            case "drop":
                self._drop = float(value)
            case "delay":
                self._delay = 1e-3 * float(value)
            case "mode":
                self.mode = int(value)
            case "swap":
                self._swapped = int(value), int(other)
            case "strict":
                self.strict = True
            case "reflex" | "user-stop":
                self.stop(MODES[order], value)
            case "release":
                self.mode = None
            case "report":
                print(json.dumps(vars(self.report)), flush=True)


def _received(source: socket.socket) -> list[tuple[bytes, Any]]:
    found = []
    while True:
        try:
            found.append(source.recvfrom(1 << 16))
        except BlockingIOError:
            return found


if __name__ == "__main__":
    run_promptly()
    proxy = Proxy(*sys.argv[1:])
    print("ready", flush=True)
    proxy.run()
