"""The dashboard server of a controller (port 29999): one line asks, one line answers."""

from __future__ import annotations

import re
from socket import create_connection, socket
from types import TracebackType

from skillc_runtime.devices.backend import BackendUnavailable

PORT, TIMEOUT_S = 29999, 1.0


class Dashboard:
    """A connection for a few questions; it needs no library and never waits for longer than `TIMEOUT_S`."""

    def __init__(self, name: str, address: str) -> None:
        """Connect to the controller of an arm called `name`; BackendUnavailable if it does not answer."""
        self._name = name
        try:
            self._socket: socket = create_connection((address, PORT), timeout=TIMEOUT_S)
            self._lines = self._socket.makefile("r", encoding="utf-8", newline="\n")
            self._lines.readline()
        except OSError as error:
            raise BackendUnavailable(
                f"the dashboard server of {name} (port {PORT}) does not answer ({error.strerror or error}): is the "
                "controller on, is the address right (skiros:DriverAddress), and is the service enabled in its "
                "security settings?"
            ) from error

    def __enter__(self) -> Dashboard:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._socket.close()

    @property
    def version(self) -> tuple[int, int]:
        """The version of PolyScope."""
        answer = self.ask("PolyscopeVersion")
        if (found := re.search(r"(\d+)\.(\d+)\.", answer)) is None:
            raise BackendUnavailable(f"{self._name} does not tell its version of PolyScope: {answer!r}")
        return int(found[1]), int(found[2])

    @property
    def is_remote(self) -> bool:
        """Whether the controller takes programs from outside; versions that do not know the question do."""
        return "false" not in self.ask("is in remote control").lower()

    def release_protective_stop(self) -> str | None:
        """Release a protective stop; return why that is refused, None if it is not."""
        answer = self.ask("unlock protective stop")
        return None if "releasing" in answer.lower() else answer

    def ask(self, line: str) -> str:
        """Send a line and return the answer; BackendUnavailable if there is none."""
        try:
            self._socket.sendall(f"{line}\n".encode())
            return self._lines.readline().strip()
        except OSError as error:
            why = error.strerror or error
            raise BackendUnavailable(f"the dashboard server of {self._name} has gone silent: {why}") from error
