"""An operation that goes on in a cell, and how it is reported."""

from __future__ import annotations

from skillc.contract.operation import OperationRequest, OperationStatus
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.history.account import RunAccount, to_instant
from skillc_runtime.recording.publisher import Publisher


class SubmittedOperation:
    """A run that was submitted, at a wall time in ns since 1970; `reported` is what was reported of it last."""

    def __init__(
        self,
        request: OperationRequest,
        submitted_ns: int,
        run: TaskRun,
        publisher: Publisher,
        account: RunAccount,
        library_hash: str,
    ) -> None:
        self.request, self.run, self.publisher, self.library_hash = request, run, publisher, library_hash
        self._submitted_at, self._account = to_instant(submitted_ns), account
        self.reported: OperationStatus | None = None

    def describe(self, cell: str, place: int) -> OperationStatus:
        """Return how it is in the cell of this name; `place` is its place in the queue, 0 if it does not wait."""
        run, account = self.run, self._account
        return OperationStatus(
            id=run.id,
            cell=cell,
            request=self.request,
            state=run.state,
            reason=run.waits_for or run.reason,
            contact=run.contact,
            allowed=run.allowed,
            events=self.publisher.sequence,
            verified=run.verified,
            false_claims=run.false_claims,
            submitted_at=self._submitted_at,
            started_at=account.started_at,
            ended_at=account.ended_at,
            failure=account.failure,
            outputs=account.outputs,
            measures=account.measures,
            library_hash=self.library_hash,
            devices=None if (held := run.devices) is None else tuple(sorted(held)),
            prompts=run.prompts,
            planning=run.planning,
            breakpoints=run.breakpoints,
            place=place,
        )
