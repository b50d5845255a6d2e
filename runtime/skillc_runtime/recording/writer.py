"""Writes the envelopes of a run to a file as JSON Lines; each is flushed when it happens."""

from __future__ import annotations

from pathlib import Path
from types import TracebackType

import msgspec

from skillc_runtime.recording.envelope import Envelope


class TraceWriter:
    """A recorder that appends every envelope to a file and flushes it; use it in a `with` statement.

    A write error never stops the robot: the writer stops writing and stores the reason in `problem`.
    """

    def __init__(self, path: Path) -> None:
        """Create the file or truncate it; OSError if that fails."""
        self.path = path
        self.problem: str | None = None
        self._encoder = msgspec.json.Encoder()
        self._file = path.open("wb")

    def __call__(self, envelope: Envelope) -> None:
        if self.problem is not None or self._file.closed:
            return
        try:
            self._file.write(self._encoder.encode(envelope) + b"\n")
            self._file.flush()
        except OSError as error:
            self._give_up(error)

    def close(self) -> None:
        """Close the file; idempotent."""
        try:
            self._file.close()
        except OSError as error:
            self._give_up(error)

    def __enter__(self) -> TraceWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _give_up(self, error: OSError) -> None:
        if self.problem is None:
            self.problem = f"{self.path} is incomplete: {error.strerror or error}"
