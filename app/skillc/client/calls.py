"""What clients do by a single request; made from the endpoints by `python tests/accept.py`, not edited."""

from __future__ import annotations

from skillc.client.connection import Connection
from skillc.contract.access import TokenInfo
from skillc.contract.api.endpoints import (
    ACKNOWLEDGE_FAULT,
    CANCEL_JOB,
    CHANGE_LIBRARY_SOURCE,
    COMPARE_RUNS,
    EXPLAIN_RUN,
    LIST_AUDIT_ENTRIES,
    LIST_CELLS,
    LIST_CHECKPOINTS,
    LIST_JOB_EVENTS,
    LIST_JOBS,
    LIST_LIBRARIES,
    LIST_LIBRARY_SOURCES,
    LIST_ORDERS,
    LIST_POSES,
    LIST_QUEUE,
    LIST_ROBOTS,
    LIST_THINGS,
    LIST_TOKENS,
    PLACE_THING,
    READ_LIBRARY_SOURCE,
    READ_SIGNALS,
    RELEASE_LEASE,
    REMOVE_CHECKPOINT,
    REMOVE_JOB,
    REORDER_QUEUE,
    RESET_CELL,
    RESTART_JOB,
    RESTORE_CELL,
    REVOKE_TOKEN,
    SAVE_CELL,
    SHOW_CELL,
    SHOW_COVERAGE,
    SHOW_JOB,
    SHOW_JOB_RESULT,
    SHOW_LEASE,
    SHOW_LIBRARY,
    SHOW_MODEL,
    SHOW_TREE,
    SHOW_VERSION,
    STOP_CELL,
    TAKE_LEASE,
)
from skillc.contract.api.version import VersionInfo
from skillc.contract.audit import AuditEntry, AuditPage
from skillc.contract.cell import CellCheckpoint, CellStatus, CheckpointName, Lease, LeaseRequest, ResetReason
from skillc.contract.device import DeviceStatus
from skillc.contract.geometry import CellModel, SurfaceCoverage
from skillc.contract.job import Job, JobEvent, JobEventPage, JobPage, JobResult
from skillc.contract.library import LibraryDescription, LibraryStatus
from skillc.contract.operation import OperationStatus, QueueOrder, StopReason
from skillc.contract.order import Order
from skillc.contract.runs.explanation import Question, RunExplanation
from skillc.contract.runs.run_diff import OtherRun, RunDiff
from skillc.contract.runs.run_tree import OperationTree
from skillc.contract.runs.signals import SignalPage, SignalRows
from skillc.contract.source import SourceChange, SourceInfo, SourcePath, SourceText
from skillc.contract.world import PlacedThing, WorldPlacement


class ServerCalls:
    """Requests about a server, and about what belongs to none of its cells."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    async def cells(self) -> tuple[CellStatus, ...]:
        """List the cells."""
        return await self._connection.call(LIST_CELLS)

    async def version(self) -> VersionInfo:
        """Show the versions of skillc and of the API."""
        return await self._connection.call(SHOW_VERSION)

    async def libraries(self) -> tuple[LibraryStatus, ...]:
        """List the libraries, and why the one on disk is not used."""
        return await self._connection.call(LIST_LIBRARIES)

    async def jobs(self, cell: str | None = None) -> tuple[Job, ...]:
        """List the jobs of all cells, or of one.

        Which jobs: those of a cell, or of all.
        """
        return await self._connection.call(LIST_JOBS, query=JobPage(cell=cell))

    async def job(self, job: str) -> Job:
        """Show a job."""
        return await self._connection.call(SHOW_JOB, job)

    async def job_result(self, job: str) -> JobResult:
        """Show what came of a job; of trials also while they go on."""
        return await self._connection.call(SHOW_JOB_RESULT, job)

    async def job_events(self, job: str, after: int = 0, wait_s: float = 0.0) -> tuple[JobEvent, ...]:
        """Read the log of a job, or wait for its next line.

        Which lines of a log: those after a number. If there are none yet, they are waited for, `wait_s` s at most.
        """
        return await self._connection.call(LIST_JOB_EVENTS, job, query=JobEventPage(after=after, wait_s=wait_s))

    async def cancel_job(self, job: str) -> Job:
        """End a job that goes on; nothing happens to others."""
        return await self._connection.call(CANCEL_JOB, job)

    async def restart_job(self, job: str) -> Job:
        """Begin a job again that failed, was cancelled or interrupted; trials go on with those that are missing."""
        return await self._connection.call(RESTART_JOB, job)

    async def remove_job(self, job: str) -> None:
        """End and forget a job, with its log, its result and its files."""
        return await self._connection.call(REMOVE_JOB, job)

    async def list_library_sources(self, library: str) -> tuple[SourceInfo, ...]:
        """List the texts of a library, and those that it may import."""
        return await self._connection.call(LIST_LIBRARY_SOURCES, library)

    async def read_library_source(self, library: str, path: str) -> SourceText:
        """Read a text of a library.

        Which text, by its path in the library.
        """
        return await self._connection.call(READ_LIBRARY_SOURCE, library, query=SourcePath(path=path))

    async def change_library_source(self, library: str, path: str, text: str, base_hash: str) -> SourceText:
        """Change a text of a library, unless somebody else has meanwhile.

        Which text, by its path in the library.

        A new text, in the place of the one whose file has the hash `base_hash`.
        """
        return await self._connection.call(
            CHANGE_LIBRARY_SOURCE,
            library,
            query=SourcePath(path=path),
            body=SourceChange(text=text, base_hash=base_hash),
        )

    async def tokens(self) -> tuple[TokenInfo, ...]:
        """List the tokens."""
        return await self._connection.call(LIST_TOKENS)

    async def revoke_token(self, name: str) -> None:
        """Revoke a token."""
        return await self._connection.call(REVOKE_TOKEN, name)

    async def list_audit_entries(self, after: int = 0, limit: int = 1000) -> tuple[AuditEntry, ...]:
        """Read the audit log: what was changed, by whom, and what was refused.

        Which entries: those after a number, and how many at most.
        """
        return await self._connection.call(LIST_AUDIT_ENTRIES, query=AuditPage(after=after, limit=limit))


class CellCalls:
    """Requests about a cell."""

    def __init__(self, connection: Connection, name: str) -> None:
        self._connection = connection
        self.name = name

    async def status(self) -> CellStatus:
        """Show a cell."""
        return await self._connection.call(SHOW_CELL, self.name)

    async def acknowledge(self) -> CellStatus:
        """Let a cell take operations again after a fault or a stop whose cause is removed."""
        return await self._connection.call(ACKNOWLEDGE_FAULT, self.name)

    async def stop(self, reason: str = "stopped") -> CellStatus:
        """Stop all operations of a cell.

        Why an operation, or everything, is stopped. A long reason is cut, and what else a body has is ignored.
        """
        return await self._connection.call(STOP_CELL, self.name, body=StopReason(reason=reason))

    async def reset(self, why: str = "") -> CellStatus:
        """Reset a simulated cell to its scene: its world and its reality.

        The reason for a reset or a restore, for the history of the world.
        """
        return await self._connection.call(RESET_CELL, self.name, body=ResetReason(why=why))

    async def checkpoints(self) -> tuple[CellCheckpoint, ...]:
        """List the checkpoints of a simulated cell, by name."""
        return await self._connection.call(LIST_CHECKPOINTS, self.name)

    async def save(self, name: str) -> CellCheckpoint:
        """Save a simulated cell, its world and its reality, as a checkpoint.

        The name of a new checkpoint: letters, digits, `_`, `-` and `.`.
        """
        return await self._connection.call(SAVE_CELL, self.name, body=CheckpointName(name=name))

    async def restore(self, checkpoint: str, why: str = "") -> CellStatus:
        """Restore a simulated cell from a checkpoint.

        The reason for a reset or a restore, for the history of the world.
        """
        return await self._connection.call(RESTORE_CELL, self.name, checkpoint, body=ResetReason(why=why))

    async def remove_checkpoint(self, checkpoint: str) -> None:
        """Remove a checkpoint of a simulated cell."""
        return await self._connection.call(REMOVE_CHECKPOINT, self.name, checkpoint)

    async def model(self) -> CellModel:
        """Show the shapes and joints of a simulated cell, as they really are."""
        return await self._connection.call(SHOW_MODEL, self.name)

    async def poses(self) -> dict[str, tuple[float, float, float, float, float, float, float]]:
        """List where the world of a cell has individuals, by IRI."""
        return await self._connection.call(LIST_POSES, self.name)

    async def coverage(self) -> dict[str, SurfaceCoverage]:
        """Show where tools have really worked on surfaces."""
        return await self._connection.call(SHOW_COVERAGE, self.name)

    async def lease(self) -> Lease:
        """Show who has the lease of a cell."""
        return await self._connection.call(SHOW_LEASE, self.name)

    async def take_lease(self, duration_s: float = 60.0, takeover: bool = False) -> Lease:
        """Take the lease of a cell, or prolong it.

        For how long a client wants to command a cell alone, in s; `takeover` ends the lease of another client.
        """
        return await self._connection.call(
            TAKE_LEASE, self.name, body=LeaseRequest(duration_s=duration_s, takeover=takeover)
        )

    async def release_lease(self) -> None:
        """Give the lease of a cell back."""
        return await self._connection.call(RELEASE_LEASE, self.name)

    async def orders(self) -> tuple[Order, ...]:
        """List the orders for a cell."""
        return await self._connection.call(LIST_ORDERS, self.name)

    async def queue(self) -> tuple[OperationStatus, ...]:
        """List the operations that wait in a cell, in the order in which they get planners and devices."""
        return await self._connection.call(LIST_QUEUE, self.name)

    async def reorder(self, first: tuple[str, ...]) -> tuple[OperationStatus, ...]:
        """Put operations before all others that wait in a cell, whatever their priority.

        The ids of the operations that come first among those that wait in a cell, in this order.
        """
        return await self._connection.call(REORDER_QUEUE, self.name, body=QueueOrder(first=first))

    async def things(self) -> tuple[PlacedThing, ...]:
        """List what has a place or a size in a cell, as it is believed."""
        return await self._connection.call(LIST_THINGS, self.name)

    async def place_thing(
        self, thing: str, pose: tuple[float, float, float, float, float, float, float], why: str
    ) -> None:
        """Say where a thing is in the world of a cell; nothing moves.

        Where a thing is, and why this is said: its position in m and a quaternion (w, x, y, z), in the world.

        It stays with what carries it. `thing` is an IRI or `prefix:name`.
        """
        return await self._connection.call(PLACE_THING, self.name, body=WorldPlacement(thing=thing, pose=pose, why=why))

    async def library(self) -> LibraryDescription:
        """Describe the library of a cell."""
        return await self._connection.call(SHOW_LIBRARY, self.name)

    async def robots(self) -> tuple[DeviceStatus, ...]:
        """List the devices of a cell, and which operation holds each."""
        return await self._connection.call(LIST_ROBOTS, self.name)


class OperationCalls:
    """Requests about an operation."""

    def __init__(self, connection: Connection, status: OperationStatus) -> None:
        self._connection = connection
        self.status = status

    @property
    def id(self) -> str:
        """Its id, which no other has."""
        return self.status.id

    async def tree(self) -> OperationTree:
        """Show the tree of an operation, with the numbers that events have."""
        return await self._connection.call(SHOW_TREE, self.id)

    async def explain(self, question: str = "") -> RunExplanation:
        """Explain what an operation has chosen, how it ended, and why.

        What to explain besides: a step, a skill, an implementation or a parameter, as of `skillc why`.
        """
        return await self._connection.call(EXPLAIN_RUN, self.id, query=Question(question=question))

    async def signals(
        self, match: str = "", after_s: float = -1.0, until_s: float = 1000000000.0, every_s: float = 0.0
    ) -> SignalRows:
        """Read recorded signals of an operation, at most 5000 rows at once.

        Which signals: those whose columns contain one of the words in `match`, separated by commas; all without.

        Those after `after_s` until `until_s` of the cell's time, `every_s` apart at least.
        """
        return await self._connection.call(
            READ_SIGNALS, self.id, query=SignalPage(match=match, after_s=after_s, until_s=until_s, every_s=every_s)
        )

    async def compare(self, other: str) -> RunDiff:
        """Compare an operation with another one.

        The operation to compare with.
        """
        return await self._connection.call(COMPARE_RUNS, self.id, query=OtherRun(other=other))
