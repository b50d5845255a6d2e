"""What a cell and whoever operates it tell each other: frames of MessagePack on two sockets.

On the first socket go requests, each with a number, and come reports, among them an answer to each request. On the
second one go stops, which no number of requests can hold up.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc.contract.cell import CellStatus
from skillc.contract.diagnosis import NO_DIAGNOSIS, Diagnosis
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.contract.sample import PoseNumbers
from skillc_runtime.devices.control_report import ControlReport
from skillc_runtime.devices.disturbances import Disturbance
from skillc_runtime.recording.commands import Command


class _Message(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    pass


class Submit(_Message, tag="submit", frozen=True, kw_only=True):
    """Take an operation with an id that no other has."""

    operation: str
    request: OperationRequest


class Give(_Message, tag="give", frozen=True, kw_only=True):
    """Give a command to an operation."""

    operation: str
    command: Command


class Reorder(_Message, tag="reorder", frozen=True, kw_only=True):
    """Put operations before all others that wait, in this order."""

    first: tuple[str, ...]


class SetPace(_Message, tag="set-pace", frozen=True, kw_only=True):
    """Let the cell's time pass at most `factor` times as fast as real time; None for as fast as it computes."""

    factor: float | None


class Acknowledge(_Message, tag="acknowledge", frozen=True, kw_only=True):
    """The cause of a fault or a stop is removed: take operations again."""


class TakeSnapshot(_Message, tag="snapshot", frozen=True, kw_only=True):
    """Answer with what the cell knows now, and where its arms are, or what its devices report; see `snapshot.py`."""

    beside: Literal["nothing", "arms", "devices"] = "nothing"


class TakeSample(_Message, tag="sample", frozen=True, kw_only=True):
    """Answer with what moves in the cell now; see `samples.py`."""


class TakeGeometry(_Message, tag="geometry", frozen=True, kw_only=True):
    """Answer with the shapes of what is in the simulated cell; see `geometry.py`."""


class TakeCoverage(_Message, tag="coverage", frozen=True, kw_only=True):
    """Answer with where tools have really worked on surfaces; see `geometry.py`."""


class Edit(_Message, tag="edit", frozen=True, kw_only=True):
    """Change the world in one transaction; the edits are statements, `who` makes them, and `why`."""

    edits: tuple[str, ...]
    who: str
    why: str


class Place(_Message, tag="place", frozen=True, kw_only=True):
    """Say where a thing is in the world; its name is an IRI or `prefix:name`. `who` says it, and `why`."""

    thing: str
    pose: PoseNumbers
    who: str
    why: str


class Disturb(_Message, tag="disturb", frozen=True, kw_only=True):
    """Let something happen to the simulated cell; `who` wants it. Names are IRIs or `prefix:name`."""

    disturbance: Disturbance
    who: str


class Reset(_Message, tag="reset", frozen=True, kw_only=True):
    """Reset the simulated cell to its scene; `who` wants it, and `why`."""

    who: str
    why: str


class Save(_Message, tag="save", frozen=True, kw_only=True):
    """Save the simulated cell as a checkpoint with a new name; `who` wants it."""

    name: str
    who: str


class Restore(_Message, tag="restore", frozen=True, kw_only=True):
    """Restore the simulated cell from a checkpoint; `who` wants it, and `why`."""

    name: str
    who: str
    why: str


class Forget(_Message, tag="forget", frozen=True, kw_only=True):
    """Remove a checkpoint."""

    name: str


class TakeLibrary(_Message, tag="library", frozen=True, kw_only=True):
    """Run another library from the next operation on; it was checked."""

    content: bytes


class End(_Message, tag="end", frozen=True, kw_only=True):
    """Stop everything and end the process."""

    reason: str


CheckpointCommand: TypeAlias = Reset | Save | Restore | Forget
Change: TypeAlias = (
    Submit | Give | Reorder | SetPace | Acknowledge | Edit | Place | Disturb | CheckpointCommand | TakeLibrary | End
)
Look: TypeAlias = TakeSnapshot | TakeSample | TakeGeometry | TakeCoverage
Message: TypeAlias = Change | Look


class CellRequest(msgspec.Struct, frozen=True):
    """A message whose answer has the same number."""

    number: int
    message: Message


class StopRequest(msgspec.Struct, frozen=True):
    """Stop an operation, or all if None."""

    reason: str
    operation: str | None = None


class Refused(msgspec.Struct, frozen=True, kw_only=True):
    """Why nothing was done: the request is `invalid`, the `state` does not allow it, the cell is too `busy`, or `off`.

    `allowed` are the commands that the state allows. `reason` is empty if a `diagnosis` says more.
    """

    kind: Literal["invalid", "state", "busy", "off"]
    reason: str = ""
    allowed: tuple[str, ...] = ()
    diagnosis: Diagnosis = NO_DIAGNOSIS

    def describe(self) -> str:
        """Return the reason as text."""
        return self.reason or self.diagnosis.describe()


class CellAnswer(_Message, tag="answer", frozen=True, kw_only=True):
    """The answer to a request: done, and durable, unless it was refused; `result` is what it asked for."""

    number: int
    refused: Refused | None = None
    result: bytes = b""


class Happened(_Message, tag="happened", frozen=True, kw_only=True):
    """An operation has new events, up to `operation.events` in the journal, or another state."""

    operation: OperationStatus


class StatusChanged(_Message, tag="status", frozen=True, kw_only=True):
    """The cell as a whole, when it is ready and whenever something in this has changed."""

    status: CellStatus


class Alive(_Message, tag="alive", frozen=True, kw_only=True):
    """The loop of the cell has gone round `rounds` times; it stands still if that stays the same.

    `intervals` are the counts of `TickIntervals` since the process was started, `intervals_s` their sum in s. `arms`
    are the reports of the processes that control real arms, by IRI.
    """

    rounds: int
    intervals: tuple[int, ...] = ()
    intervals_s: float = 0.0
    arms: dict[str, ControlReport] = {}


class Preparing(_Message, tag="preparing", frozen=True, kw_only=True):
    """What the cell does before it is ready, if that takes long."""

    reason: str


class StartFailed(_Message, tag="not-started", frozen=True, kw_only=True):
    """The cell could not be started; the process ends."""

    reason: str


Report: TypeAlias = CellAnswer | Happened | StatusChanged | Alive | Preparing | StartFailed
