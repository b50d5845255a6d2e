"""The control process of one arm as the process of the tree sees it: started, called, watched, ended."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from contextlib import suppress
from itertools import count
from threading import Event, RLock, Thread
from time import monotonic
from typing import Any

import numpy as np

from skillc_runtime.backends.control_process.calls import Part, RemoteAnswer, RemoteCall
from skillc_runtime.backends.control_process.handshake import Connected, ControlTask
from skillc_runtime.backends.control_process.link import CALL_S
from skillc_runtime.backends.control_process.memory_plan import MemoryPlan
from skillc_runtime.backends.control_process.message_socket import MessageSocket
from skillc_runtime.backends.control_process.shared_memory import SharedRecord, SharedRing, make_memory, map_memory
from skillc_runtime.backends.control_process.snapshot import ControlSnapshot, FieldLayout
from skillc_runtime.devices.backend import BackendBroken, BackendUnavailable
from skillc_runtime.motion.arrays import OutVector
from skillc_runtime.platforms.processes import INHERITS_SOCKETS

START_S = 300.0
"""How long a control process may take to connect; its first one on a machine compiles the laws."""

BEAT_S = 0.02
"""How often this process reports to a control process that it is alive, in s."""

ANSWER_S = 1.0
"""How long to wait for the answer to a call that does not concern the device, in s."""

END_S = 5.0
"""How long a control process may take to stop its arm and to end."""


class ControlProcess:
    """A running control process; `name` is the short name of its arm."""

    def __init__(self, task: ControlTask) -> None:
        """Start it and wait until it is connected to its device; the arm is not under control yet.

        BackendUnavailable, SheetError and other errors that it raises, for which there can be no cell.
        """
        if not INHERITS_SOCKETS:
            raise BackendUnavailable("robots are controlled by processes that share memory, on Linux and macOS only")
        self.name, self._numbers, self._turn = task.names[task.facts.individual], count(1), RLock()
        self._task, self._plan = task, MemoryPlan(task.facts.home.size)
        self._broken: str | None = None
        self._closing = Event()
        self._thread = Thread(target=self._keep_beating, name=f"beat {self.name}", daemon=True)
        self._beat: OutVector = np.zeros(1)
        self._thread.start()
        try:
            self._begin()
        except BaseException:
            self.close()
            raise

    @property
    def row(self) -> FieldLayout:
        """The layout of the rows of the ring."""
        return self._plan.row

    @property
    def joints(self) -> int:
        """The number of joints."""
        return self._plan.layout.joints

    def read(self) -> ControlSnapshot:
        """Return a copy of what was published last; its arrays are read-only."""
        values = self._record.read()
        values.flags.writeable = False
        return ControlSnapshot(self._plan.layout, values)

    def call(self, part: Part, name: str, *arguments: Any, wait_s: float = ANSWER_S) -> Any:
        """Return what a call returns, or raise what it raises; BackendBroken if there is no answer."""
        with self._turn:
            if (reason := self.find_silence()) is not None:
                raise BackendBroken(reason)
            call = RemoteCall(next(self._numbers), part, name, arguments)
            try:
                self._socket.send(call)
                answer = self._receive(call, wait_s)
            except (EOFError, OSError) as error:
                raise BackendBroken(self.find_silence() or f"{self._who} does not answer: {error}") from error
        if answer.error is not None:
            raise answer.error
        return answer.value

    def call_device(self, name: str, *arguments: Any) -> Any:
        """Call the device: as `call`, but wait as long as a device may take."""
        return self.call("device", name, *arguments, wait_s=4 * CALL_S)

    def find_silence(self) -> str | None:
        """Return why it can be called no more, or that it does not run at present; None if it runs."""
        if self._broken is not None:
            return self._broken
        if (code := self.process.poll()) is not None:
            how = f"by signal {-code}" if code < 0 else f"with exit code {code}"
            self._broken = f"{self._who} has ended {how}"
            return self._broken
        snapshot = self.read()
        silent_s = monotonic() - max(snapshot.number("time_s"), snapshot.number("busy_until_s"))
        return f"{self._who} has not run for {silent_s:.2f} s" if silent_s > self._patience_s else None

    @property
    def needs_restart(self) -> bool:
        """Whether only another process can go on: this one has ended, or its link cannot connect to a lost device."""
        if self._closing.is_set():
            return False
        return self.process.poll() is not None or (
            self.read().phase == "lost" and not self.connected.abilities.reconnects
        )

    def restart(self) -> None:
        """Put another process in the place of this one, which knows no load; it has no control yet. As `__init__`."""
        with self._turn:
            self._broken = f"{self._who} is being started again"
            self._socket.close()
            self.process.kill()
            self.process.wait()  # wait ends: it is killed
            try:
                self._begin()
            except Exception as error:
                self._broken = str(error)
                raise
            self._broken = None

    def close(self) -> None:
        """Let it stop its arm, give the device back, and end; end it if it does not."""
        self._broken = self._broken or f"{self._who} is closed"
        with suppress(OSError):
            self._socket.close()
        try:
            self.process.wait(END_S)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()  # wait ends: it is killed
        self._closing.set()
        self._thread.join(END_S)

    @property
    def _who(self) -> str:
        return f"the control process of {self.name}"

    def _begin(self) -> None:
        """Start a process with a memory of its own, and wait until it is connected to its device."""
        plan, file = self._plan, make_memory(self._plan.size)
        ours, theirs = socket.socketpair()
        with theirs:
            os.set_inheritable(theirs.fileno(), True)
            self.process = _start(theirs.fileno(), file)
        memory = map_memory(file)
        self._socket, self._beat = MessageSocket(ours), plan.beat(memory)
        self._beat[0] = monotonic()
        self.connected = self._introduce()
        self._record, self.ring = SharedRecord(plan.record(memory)), SharedRing(plan.ring(memory), plan.row.size)
        self._patience_s = max(self._task.patience.process_s, self.connected.abilities.silence_s + BEAT_S)

    def _introduce(self) -> Connected:
        device = self._task.description.name
        try:
            self._socket.send(list(sys.path))
            self._socket.send(self._task)
            answer = self._socket.receive(START_S)
        except TimeoutError as error:
            self.process.kill()
            raise BackendUnavailable(f"{self._who} has not connected to {device} in {START_S:g} s") from error
        except (EOFError, OSError) as error:
            raise BackendUnavailable(f"{self._who} has ended while it connected to {device}") from error
        if isinstance(answer, Exception):
            raise answer
        connected: Connected = answer
        return connected

    def _receive(self, call: RemoteCall, wait_s: float) -> RemoteAnswer:
        """Return the answer to a call; those to earlier calls, which nobody waits for any more, are left out."""
        until = monotonic() + wait_s
        try:
            while True:
                answer: RemoteAnswer = self._socket.receive(until - monotonic())
                if answer.number == call.number:
                    return answer
        except TimeoutError as error:
            late = f"{self._who} has not answered {call.name} in {wait_s:g} s"
            raise BackendBroken(self.find_silence() or late) from error

    def _keep_beating(self) -> None:
        while not self._closing.wait(BEAT_S):
            self._beat[0] = monotonic()


def _start(socket_file: int, memory_file: int) -> subprocess.Popen[bytes]:
    """Start the program with two open files, in a session of its own, so that Ctrl-C does not reach it."""
    program = "skillc_runtime.backends.control_process.periods.process"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    return subprocess.Popen(
        [sys.executable, "-m", program, str(socket_file), str(memory_file)],
        pass_fds=(socket_file, memory_file),
        stdin=subprocess.DEVNULL,
        start_new_session=True,
        env=environment,
    )
